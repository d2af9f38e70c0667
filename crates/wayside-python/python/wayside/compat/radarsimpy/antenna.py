"""Channels: places, polarizations and patterns of antenna elements."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .refusal import dictionaries, needed, refuse, refuse_keys, vector

_KEYS = {
    "location",
    "polarization",
    "azimuth_angle",
    "azimuth_pattern",
    "elevation_angle",
    "elevation_pattern",
}
_FRONT = np.array([-90.0, 90.0])
_NOTHING_DB = -10_000.0


class Antennas:
    """Elements of the transmit or of the receive row."""

    def __init__(self, channels: Sequence[dict[str, Any]] | None, where: str, more: set[str]) -> None:
        alone: list[dict[str, Any]] = [{"location": (0, 0, 0)}]
        self.channels = alone if channels is None else dictionaries(channels, where)
        if not self.channels:
            raise ValueError(f"{where}: at least one is needed")
        for channel in self.channels:
            refuse_keys(channel, _KEYS | more, where)
        self.where = where
        places = [needed(channel, "location", where) for channel in self.channels]
        self.locations = np.array([vector(place, f"{where}['location']") for place in places])
        if np.any(self.locations[:, 0] != 0):
            raise refuse(f"{where}['location']", "elements stand in one plane, x = 0")

    def __len__(self) -> int:
        return len(self.channels)

    def polarization(self) -> str:
        """The letter of the row: v or h."""
        letters = {_letter(c.get("polarization", (0, 0, 1)), self.where) for c in self.channels}
        if len(letters) > 1:
            raise refuse(f"{self.where}['polarization']", "all elements of a row have one polarization")
        return letters.pop()

    def pattern(self) -> tuple[tuple[NDArray[Any], NDArray[Any]], tuple[NDArray[Any], NDArray[Any]]]:
        """Cuts of the row's pattern, (angle, dBi) along azimuth and along elevation."""
        first = self.channels[0]
        for channel in self.channels[1:]:
            for key in ("azimuth_angle", "azimuth_pattern", "elevation_angle", "elevation_pattern"):
                if not np.array_equal(channel.get(key, ()), first.get(key, ())):
                    raise refuse(f"{self.where}[{key!r}]", "all elements of a row have one pattern")
        return _cut(first, "azimuth", self.where), _cut(first, "elevation", self.where)


def _letter(polarization: Any, where: str) -> str:
    upright = np.asarray(polarization, dtype=complex)
    if np.array_equal(upright, (0, 0, 1)):
        return "v"
    if np.array_equal(upright, (0, 1, 0)):
        return "h"
    raise refuse(f"{where}['polarization']", "it is [0, 0, 1] (vertical) or [0, 1, 0] (horizontal)")


def _cut(channel: dict[str, Any], axis: str, where: str) -> tuple[NDArray[Any], NDArray[Any]]:
    """A cut by growing angles; of no gain at all, −∞ dB, it has RadarSimPy's −10000 dB."""
    angles = np.asarray(channel.get(f"{axis}_angle", _FRONT), dtype=float)
    gains = np.asarray(channel.get(f"{axis}_pattern", np.zeros(len(angles))), dtype=float)
    if angles.shape != gains.shape or angles.ndim != 1:
        raise ValueError(f"{where}: {axis}_angle and {axis}_pattern have different lengths")
    if len(angles) < 2:
        raise ValueError(f"{where}: {axis}_angle has {len(angles)} values; two are needed at least")
    if np.any(~np.isfinite(angles)) or np.any(np.isnan(gains) | np.isposinf(gains)):
        raise ValueError(f"{where}: {axis}_angle and {axis}_pattern have values that are no numbers")
    order = np.argsort(angles, kind="stable")
    angles, gains = angles[order], np.maximum(gains[order], _NOTHING_DB)
    if np.any(np.diff(angles) == 0):
        raise ValueError(f"{where}: {axis}_angle has the same angle twice")
    return angles, gains
