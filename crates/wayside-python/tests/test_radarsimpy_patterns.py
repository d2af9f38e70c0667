"""Patterns of RadarSimPy's channels: levels by the radar equation, straight in dB over degrees."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from wayside.compat.radarsimpy import NotSupported, Radar, Receiver, Transmitter, sim_radar

C_MPS = 299_792_458.0
DEFAULT: dict[str, Any] = {"location": (0, 0, 0)}
DEGREES = np.arange(-90, 91)


def radar_of(transmit: dict[str, Any], receive: dict[str, Any], pulses: int = 1) -> Radar:
    """A radar of one channel at 77 GHz, 10 dBm; what is given is its elements' patterns."""
    sent = Transmitter(
        f=[76.5e9, 77.5e9], t=50e-6, tx_power=10, pulses=pulses, channels=[DEFAULT | transmit]
    )
    return Radar(sent, Receiver(fs=4e6, channels=[DEFAULT | receive]))


def point(az_deg: float, el_deg: float = 0.0) -> dict[str, Any]:
    """A point of 10 dBsm at 30 m."""
    az, el = np.radians(az_deg), np.radians(el_deg)
    place = 30 * np.array([np.cos(az) * np.cos(el), np.sin(az) * np.cos(el), np.sin(el)])
    return {"location": place.tolist(), "rcs": 10}


def volts(gain_db: float, range_m: float = 30.0) -> float:
    """√(2·P·R) of an echo of 10 dBsm, by the sum of both gains."""
    power_w = 0.01 * 10 ** (gain_db / 10) * 10 * (C_MPS / 77e9) ** 2 / ((4 * np.pi) ** 3 * range_m**4)
    return float(np.sqrt(2 * power_w * 500))


def level(radar: Radar, target: dict[str, Any]) -> float:
    return float(np.abs(sim_radar(radar, [target])["baseband"][0, 0, 0]))


def azimuth(angles: Any, gains: Any) -> dict[str, Any]:
    return {"azimuth_angle": angles, "azimuth_pattern": gains}


def elevation(angles: Any, gains: Any) -> dict[str, Any]:
    return {"elevation_angle": angles, "elevation_pattern": gains}


# Both ways on both axes err by 0.01 dB each: 0.04 dB, 0.5 % of the amplitude.
CLOSE = 0.005


@pytest.mark.parametrize("at_deg", [0, 3, 35, 45, 60, -88])
def test_a_pattern_is_straight_in_db_between_its_angles(at_deg: float) -> None:
    steep = azimuth([-90, 0, 90], [-40, 0, -40])
    expected = volts(-80 * abs(at_deg) / 90)
    # 80 dB below the peak ten times the error is allowed.
    assert level(radar_of(steep, steep), point(at_deg)) == pytest.approx(expected, rel=5 * CLOSE)


def test_many_directions_of_a_pattern_have_its_level() -> None:
    gains = 20 * np.log10(np.cos(np.radians(DEGREES)) + 0.01) + 6
    both = azimuth(DEGREES, gains) | elevation(DEGREES, gains)
    radar, draw = radar_of(both, both), np.random.default_rng(1)
    for az_deg, el_deg in draw.uniform(-60, 60, (12, 2)):
        gain = np.interp([az_deg, el_deg], DEGREES, gains).sum() - gains.max()
        assert level(radar, point(az_deg, el_deg)) == pytest.approx(volts(2 * gain), rel=2 * CLOSE)


NARROW = np.arange(-60, 61)


@pytest.mark.parametrize(
    ("transmit", "receive", "at_deg"),
    [
        (azimuth(NARROW, 10 - (NARROW / 20) ** 2), {}, 75),
        (azimuth([-60, 60], [0, 0]), azimuth([-60, 60], [0, 0]), 75),
        (azimuth([-60, 60], [3, 3]), {}, -61),
        (azimuth([10, 20, 30], [0, 0, 0]), {}, 0),
        (azimuth([-60, -10], [0, 0]), azimuth([10, 60], [0, 0]), 20),
        ({}, {}, 180),
    ],
)
def test_beyond_the_angles_of_either_row_nothing_is_heard(transmit: Any, receive: Any, at_deg: float) -> None:
    assert level(radar_of(transmit, receive), point(at_deg)) == 0


def test_within_a_sector_aside_the_level_is_the_sectors() -> None:
    sector = azimuth([10, 20, 30], [0, 0, 0])
    assert level(radar_of(sector, {}), point(25)) == pytest.approx(volts(0), rel=CLOSE)


def test_a_pattern_all_around_hears_behind() -> None:
    around = azimuth([-180, 180], [3, 3])
    assert level(radar_of(around, around), point(120)) == pytest.approx(volts(6), rel=CLOSE)


def test_a_body_behind_is_not_heard_and_one_ahead_is(tmp_path: Path) -> None:
    plate = tmp_path / "plate.obj"
    plate.write_text("v 0 -0.1 -0.15\nv 0 0.1 -0.15\nv 0 0.1 0.15\nv 0 -0.1 0.15\nf 1 2 3 4\n")
    radar = radar_of({}, {})
    assert level(radar, {"model": str(plate), "location": (-8, 0, 0)}) == 0
    assert level(radar, {"model": str(plate), "location": (8, 0, 0)}) > 0


def test_a_point_is_heard_from_when_on_it_is_ahead() -> None:
    radar = radar_of({}, {}, pulses=400)
    target = {"location": (-0.05, 3, 0), "speed": (30, 0, 0), "rcs": 10}
    heard = np.abs(sim_radar(radar, [target])["baseband"][0, :, 0])
    x = 30 * radar.timestamp[0, :, 0] - 0.05
    expected = np.where(x > 0, [volts(0, np.hypot(at, 3)) for at in x], 0)
    # The pulse within which it comes ahead may have either.
    apart = np.abs(heard - expected) > 0.02 * expected.max()
    assert np.all(np.abs(x[apart]) < 30 * 50e-6)


def test_the_level_of_an_elevation_cut_is_that_of_each_rows_own_peak() -> None:
    up, down = (elevation(DEGREES, np.maximum(-((DEGREES - at) ** 2) / 30, -80)) for at in (15, -15))
    assert level(radar_of(up, down), point(0)) == pytest.approx(volts(-15), rel=CLOSE)


def test_angles_may_come_in_any_order() -> None:
    falling = azimuth(DEGREES[::-1], np.maximum(-((DEGREES[::-1] - 20) ** 2) / 100, -40))
    assert level(radar_of(falling, falling), point(30)) == pytest.approx(volts(-2), rel=CLOSE)


def test_no_gain_at_all_is_none() -> None:
    with np.errstate(divide="ignore"):
        gains = 20 * np.log10(np.abs(np.sin(np.radians(DEGREES))))
    split = azimuth(DEGREES, gains) | elevation([-90, 0, 90], [-324, 0, -324])
    assert level(radar_of(split, split), point(30)) == pytest.approx(volts(2 * gains[120]), rel=CLOSE)
    # A table ends at −200 dB, each of both ways.
    assert level(radar_of(split, split), point(0)) < 1e-25


@pytest.mark.parametrize(
    ("pattern", "rule"),
    [
        (azimuth([0, 1, 2], [0, 0]), "different lengths"),
        (azimuth([0], [0]), "azimuth_angle has 1 values; two are needed"),
        (azimuth([0, 1, 1], [0, 0, 3]), "azimuth_angle has the same angle twice"),
        (elevation([0, 1], [0, float("nan")]), "elevation_angle and elevation_pattern have values"),
    ],
)
def test_a_pattern_that_is_none_is_refused_by_its_key(pattern: Any, rule: str) -> None:
    with pytest.raises(ValueError, match=rule):
        sim_radar(radar_of(pattern, {}), [])


def test_a_pattern_beyond_the_largest_table_is_refused_by_name() -> None:
    gains = np.random.default_rng(2).uniform(-40, 10, len(DEGREES))
    both = azimuth(DEGREES, gains) | elevation(DEGREES, gains)
    with pytest.raises(NotSupported, match="azimuth_pattern.*more than 65536 pairs"):
        sim_radar(radar_of(both, {}), [])
