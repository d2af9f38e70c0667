"""Class ``Transmitter``: waveform and transmit channels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .antenna import Antennas
from .refusal import above_zero, finite, nothing, number, refuse

_MODULATION = ("pulse_amp", "pulse_phs", "mod_t", "phs", "amp")


class Transmitter:
    """Linear chirps of one or several transmit channels, by RadarSimPy's names and units.

    ``f`` [start, stop] in Hz, ``t`` the chirp's length in s, ``tx_power`` in dBm, ``prp`` the time from
    chirp to chirp in s. A channel's ``delay`` (s) is when it begins to send, as in time division.
    """

    def __init__(
        self,
        f: Any,
        t: Any,
        tx_power: float = 0,
        pulses: int = 1,
        prp: Any = None,
        f_offset: Any = None,
        pn_f: Any = None,
        pn_power: Any = None,
        channels: Sequence[dict[str, Any]] | None = None,
    ) -> None:
        sweep, length = _sweep(f), _length(t)
        nothing(f_offset, "f_offset", "all chirps have one sweep")
        power, count = number(tx_power, "tx_power"), number(pulses, "pulses")
        if int(count) != count or count < 1:
            raise ValueError(f"pulses: must be a whole number of 1 or more, is {pulses}")
        self.antennas = Antennas(channels, "tx channel", {"delay", "grid", *_MODULATION})
        for channel in self.antennas.channels:
            for key in _MODULATION:
                if not _is_neutral(key, channel.get(key)):
                    raise refuse(f"tx channel[{key!r}]", 'use multiplexing = "ddm" or "bpm" of a scene')
        intervals = _intervals(prp, length, int(pulses))
        pn_f, pn_power = _phase_noise(pn_f, pn_power)
        self.rf_prop = {"tx_power": power, "pn_f": pn_f, "pn_power": pn_power}
        self.waveform_prop: dict[str, Any] = {
            "f": sweep,
            "t": np.array([0.0, length]),
            "bandwidth": float(np.ptp(sweep)),
            "pulse_length": length,
            "pulses": int(pulses),
            "f_offset": np.zeros(int(pulses)),
            "prp": np.array(intervals),
            "pulse_start_time": np.cumsum(intervals) - intervals[0],
        }
        self.txchannel_prop: dict[str, Any] = {
            "size": len(self.antennas),
            "locations": self.antennas.locations,
            "delay": np.array([_delay(channel) for channel in self.antennas.channels]),
        }


def _intervals(prp: Any, length: float, pulses: int) -> NDArray[np.float64]:
    """Time from each pulse to the next, s."""
    told = finite(np.asarray(length if prp is None else prp, dtype=float), "prp")
    if told.shape not in ((), (1,), (pulses,)):
        raise ValueError(f"prp: one number is needed, or {pulses}, has the shape {told.shape}")
    intervals = np.broadcast_to(told, (pulses,))
    if np.any(intervals < length):
        raise ValueError("prp must not be less than the length of a pulse")
    if not np.allclose(intervals, intervals[0], rtol=1e-12, atol=0):
        raise refuse("prp", "intervals that change: use stagger_us of a scene")
    return intervals


def _phase_noise(pn_f: Any, pn_power: Any) -> tuple[Any, Any]:
    """Offsets in Hz, growing, and their levels; None and None of no phase noise."""
    if (pn_f is None) != (pn_power is None):
        raise ValueError("pn_f and pn_power belong together")
    if pn_f is None:
        return None, None
    offsets, levels = (np.atleast_1d(np.asarray(told, dtype=float)) for told in (pn_f, pn_power))
    if offsets.shape != levels.shape:
        raise ValueError(f"pn_f and pn_power have different lengths, {len(offsets)} and {len(levels)}")
    order = np.argsort(finite(offsets, "pn_f"), kind="stable")
    return offsets[order], finite(levels, "pn_power")[order]


def _delay(channel: dict[str, Any]) -> float:
    return number(channel.get("delay", 0), "tx channel['delay']")


def _is_neutral(key: str, code: Any) -> bool:
    """Whether a code changes nothing: amplitudes of 1, phases of whole turns in degrees, and their times."""
    if code is None or key == "mod_t":
        return True
    try:
        values = np.asarray(code, dtype=complex)
    except (TypeError, ValueError):
        return False
    if key in ("pulse_amp", "amp"):
        return bool(np.all(values == 1))
    return bool(np.all(values.imag == 0) and np.all(np.mod(values.real, 360) == 0))


def _sweep(f: Any) -> Any:
    sweep = finite(np.atleast_1d(np.asarray(f, dtype=float)), "f")
    if len(sweep) != 2:
        raise refuse("f", "a linear chirp [start, stop] is needed, no single tone and no other waveform")
    if sweep[0] == sweep[1]:
        raise refuse("f", "start and stop are equal: a single tone tells no range")
    return sweep


def _length(t: Any) -> float:
    times = np.atleast_1d(np.asarray(t, dtype=float))
    if len(times) > 2:
        raise refuse("t", "a linear chirp has one length, or [begin, end]")
    return above_zero(times[-1] - times[0] if len(times) == 2 else times[0], "t")
