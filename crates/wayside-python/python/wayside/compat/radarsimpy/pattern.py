"""Pattern of an element as a table of directions.

Cuts are straight in dB over degrees and end with their first and last angle. A table of wayside is cubic in
amplitude: it gets as many angles as keep the straight lines, some of them close beside sharp bends.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .radar import Radar
from .refusal import refuse

Cut = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Angles in degrees, growing, and gains in dB."""

# Bounds of a pattern file (docs/scenes.md).
_LARGEST_DB = 200.0
_VALUES = 65_536
# Errors in dB that a cut may have at its peak, one way, and ten times that 80 dB below; the first that the
# bounds allow is kept.
_ERRORS_DB = (0.01, 0.02, 0.04, 0.08, 0.16, 0.32)
_TENFOLD_DB = 80.0
# Places at which a cut is looked at, beside an angle and between.
_BESIDE_DEG = 1e-3 * 4.0 ** np.arange(6)[:, None]
_STEP_DB = 1.0
_DB_PER_NEPER = 20.0 / np.log(10.0)


def pattern_of(radar: Radar, folder: str) -> dict[str, Any] | None:
    """Keys of the array's pattern, whose file goes into ``folder``; None where no direction is heard.

    The pattern is the mean of both rows' in dB, by which an echo of one point is weighed. The level is that
    of the azimuth cut; of an elevation cut the shape alone counts.
    """
    rows = [radar.radar_prop[name].antennas.pattern() for name in ("transmitter", "receiver")]
    azimuth = _mean([row[0] for row in rows], 180.0)
    elevation = _mean([(angles, gains - gains.max()) for angles, gains in (row[1] for row in rows)], 90.0)
    if azimuth is None or elevation is None:
        return None
    if azimuth[1].max() + elevation[1].max() > _LARGEST_DB:
        raise refuse("azimuth_pattern", f"gains of more than {_LARGEST_DB:.0f} dB")
    place = os.path.join(folder, "pattern.csv")
    with open(place, "w", encoding="utf-8") as file:
        file.write("\n".join(_lines(*_table(azimuth, elevation))) + "\n")
    return {"pattern": "table", "pattern_file": place}


def _mean(cuts: Sequence[Cut], limit_deg: float) -> Cut | None:
    """Mean of cuts at the angles of either; where one of them has ended nothing is left."""
    low = max(-limit_deg, *(angles[0] for angles, _ in cuts))
    high = min(limit_deg, *(angles[-1] for angles, _ in cuts))
    if low >= high:
        return None
    angles = np.unique(np.concatenate([[low, high], *(angles for angles, _ in cuts)]))
    angles = angles[(low <= angles) & (angles <= high)]
    return _floored(angles, np.mean([np.interp(angles, *cut) for cut in cuts], axis=0))


def _floored(angles: NDArray[np.float64], gains: NDArray[np.float64]) -> Cut:
    """The cut with nothing below the least gain of a table, and bends where it gets there."""
    above = gains + _LARGEST_DB
    at = np.flatnonzero(above[:-1] * above[1:] < 0)
    share = above[at] / (above[at] - above[at + 1])
    crossings = angles[at] + share * (angles[at + 1] - angles[at])
    places = np.unique(np.concatenate([angles, crossings]))
    return places, np.maximum(np.interp(places, angles, gains), -_LARGEST_DB)


def _table(azimuth: Cut, elevation: Cut) -> tuple[Cut, Cut]:
    """Both cuts at the angles of a table that is no larger than allowed."""
    for error_db in _ERRORS_DB:
        cuts = _sampled(azimuth, error_db, 180.0), _sampled(elevation, error_db, 90.0)
        if len(cuts[0][0]) * len(cuts[1][0]) <= _VALUES:
            return cuts
    raise refuse("azimuth_pattern", f"more than {_VALUES} pairs of azimuth and elevation would be needed")


def _sampled(cut: Cut, error_db: float, limit_deg: float) -> Cut:
    """The cut at angles between which a cubic in amplitude errs by ``error_db`` at most."""
    if np.ptp(cut[1]) == 0 and np.ptp(cut[0]) == 2 * limit_deg:
        return np.zeros(1), cut[1][:1]
    places = _places(*cut)
    gains = np.interp(places, *cut)
    amplitude = 10 ** (gains / 20)
    below_db = gains.max() - gains
    allowed = error_db / _DB_PER_NEPER * 10 ** (below_db / _TENFOLD_DB) * amplitude
    kept = np.array([0, len(places) // 2, len(places) - 1])
    while True:
        excess = np.abs(_cubic(places, places[kept], amplitude[kept]) - amplitude) / allowed
        worst = [a + np.argmax(excess[a:b]) for a, b in zip(kept[:-1].tolist(), kept[1:].tolist())]
        more = [index for index in worst if excess[index] > 1]
        if not more:
            return places[kept], gains[kept]
        kept = np.union1d(kept, more)


def _places(angles: NDArray[np.float64], gains: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places at which a cut is looked at: its angles, others close beside them, and some between."""
    aside = np.minimum(_BESIDE_DEG, 0.25 * np.diff(angles))
    pieces = np.maximum(4, np.ceil(np.abs(np.diff(gains)) / _STEP_DB)).astype(int)
    between = [np.linspace(a, b, n + 1) for a, b, n in zip(angles[:-1], angles[1:], pieces.tolist())]
    return np.unique(np.concatenate([*(angles[:-1] + aside), *(angles[1:] - aside), *between]))


def _cubic(
    at: NDArray[np.float64], angles: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Hermite's cubic through values, its slopes those of the parabolas through neighbours, as a table of
    wayside is read."""
    slopes, below = np.gradient(values, angles, edge_order=2), np.searchsorted(angles, at, "right") - 1
    i = np.clip(below, 0, len(angles) - 2)
    step = angles[i + 1] - angles[i]
    t = (at - angles[i]) / step
    ends = (1 - t) ** 2 * (1 + 2 * t) * values[i] + t**2 * (3 - 2 * t) * values[i + 1]
    cubic: NDArray[np.float64] = ends + step * t * (1 - t) * ((1 - t) * slopes[i] - t * slopes[i + 1])
    return cubic


def _lines(azimuth: Cut, elevation: Cut) -> list[str]:
    """Lines of a pattern file; its azimuths grow to the right."""
    pairs = zip(*(cut.tolist() for cut in azimuth)), list(zip(*(cut.tolist() for cut in elevation)))
    directions = (
        f"{-az},{el},{max(along + up, -_LARGEST_DB)}" for az, along in pairs[0] for el, up in pairs[1]
    )
    return ["az_deg,el_deg,gain_db", *directions]
