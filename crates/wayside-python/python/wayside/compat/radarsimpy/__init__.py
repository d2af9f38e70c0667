"""Scripts that were written for RadarSimPy, run by wayside.

Write ``from wayside.compat.radarsimpy import Radar, Transmitter, Receiver, sim_radar`` in place of
``from radarsimpy import …``; the rest of a script stays as it is. Arguments, attributes, axes and the order
of channels are RadarSimPy's: x along the boresight, y to the left, z up; frames·tx·rx, pulses, samples.
What is not supported raises :class:`NotSupported` with its name. The page ``docs/coming-from.md`` has the
tables.

The code is wayside's own, by the public description of the interface; nothing of RadarSimPy is in it.
"""

from typing import Any

from . import processing, simulator
from .radar import Radar
from .receiver import Receiver
from .refusal import NotSupported, refuse
from .simulator import sim_radar, sim_rcs
from .transmitter import Transmitter

__all__ = [
    "NotSupported",
    "Radar",
    "Receiver",
    "Transmitter",
    "processing",
    "sim_radar",
    "sim_rcs",
    "simulator",
]

_ELSEWHERE = {
    "sim_lidar": "no lidar is simulated",
    "tools": "false alarms and detections are those of a scene's detector, docs/validation/README.md",
    "rt": "sim_radar and sim_rcs are here by their own names",
}


def __getattr__(name: str) -> Any:
    if name in _ELSEWHERE:
        raise refuse(name, _ELSEWHERE[name])
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
