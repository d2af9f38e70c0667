"""Class ``Receiver``: baseband and receive channels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .antenna import Antennas
from .refusal import above_zero, number


class Receiver:
    """Receiver by RadarSimPy's names and units.

    ``fs`` in samples a second, ``noise_figure``, ``rf_gain`` and ``baseband_gain`` in dB, ``load_resistor``
    in ohms: noise has √(power · gains · load resistor) volts, an echo the peak of as much.
    """

    def __init__(
        self,
        fs: float,
        noise_figure: float = 10,
        rf_gain: float = 0,
        load_resistor: float = 500,
        baseband_gain: float = 0,
        bb_type: str = "complex",
        channels: Sequence[dict[str, Any]] | None = None,
    ) -> None:
        if bb_type not in ("complex", "real"):
            raise ValueError(f"bb_type must be complex or real, is {bb_type!r}")
        above_zero(fs, "fs")
        above_zero(load_resistor, "load_resistor")
        gains = {"noise_figure": noise_figure, "rf_gain": rf_gain, "baseband_gain": baseband_gain}
        for name, value in gains.items():
            number(value, name)
        self.antennas = Antennas(channels, "rx channel", set())
        self.rf_prop = {"rf_gain": rf_gain, "noise_figure": noise_figure}
        self.bb_prop: dict[str, Any] = {
            "fs": fs,
            "load_resistor": load_resistor,
            "baseband_gain": baseband_gain,
            "bb_type": bb_type,
            "noise_bandwidth": fs if bb_type == "complex" else fs / 2,
        }
        self.rxchannel_prop: dict[str, Any] = {
            "size": len(self.antennas),
            "locations": self.antennas.locations,
        }

    def volts(self) -> float:
        """Volts at the converter of √W at the antenna."""
        gain_db = self.rf_prop["rf_gain"] + self.bb_prop["baseband_gain"]
        return float((self.bb_prop["load_resistor"] * 10 ** (gain_db / 10)) ** 0.5)
