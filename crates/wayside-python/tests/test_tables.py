"""Results as tables of pandas and arrays of xarray."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from conftest import call, small_scene

import wayside


def test_a_cube_and_maps_have_named_axes(scene: wayside.Scene) -> None:
    pytest.importorskip("xarray")
    cube = scene.echo()
    assert cube.to_xarray().dims == ("frame", "channel", "chirp", "sample")
    assert np.shares_memory(cube.to_xarray().values, cube.samples)
    maps = cube.range_doppler().to_xarray()
    assert maps["values"].dims == ("frame", "channel", "velocity_mps", "range_m")
    near = maps["mask"].sel(range_m=13.0, method="nearest")
    assert near.shape == (2, 32)


def test_paths_points_and_tracks_are_tables(scene: wayside.Scene) -> None:
    pytest.importorskip("pandas")
    paths = scene.trace().to_pandas()
    assert paths.target.tolist() == ["near", "far", "near", "far"]
    assert paths.x_a_y_m[1] == 40.0
    found = scene.detect()
    table = found.to_pandas()
    assert {"frame", "range_m", "position_m_0", "position_m_2"} <= set(table.columns)
    assert len(table) == len(found.points)
    assert set(table["height"]) == {"assumed"}
    assert "covariance_3_3" in found.track().to_pandas().columns


def test_maps_of_sub_frames_have_each_their_own_velocities() -> None:
    waveform = {"samples": 64, "chirps": 32, "sub_frame_idle_us": [10.0, 17.0]}
    radar = {"waveform": waveform, "array": {"preset": "1x4"}}
    maps = wayside.Scene(small_scene(radar=radar)).range_doppler()
    of_frames = maps.velocity_of_frames_mps
    assert of_frames.shape == (4, 32)
    assert np.array_equal(of_frames[0], maps.velocity_mps) and np.array_equal(of_frames[:2], of_frames[2:])
    # A cell is lambda/2MT: 64 samples at 5.12 MHz take 12.5 us.
    assert of_frames[1] == pytest.approx(of_frames[0] * (12.5 + 10.0) / (12.5 + 17.0))
    pytest.importorskip("xarray")
    labelled = maps.to_xarray()
    assert labelled["values"].dims == ("frame", "channel", "doppler", "range_m")
    assert np.array_equal(labelled["velocity_mps"].values, of_frames)
    assert labelled["velocity_mps"].dims == ("frame", "doppler")


def test_samples_that_are_steps_are_not_told_as_powers(program: list[str], tmp_path: Path) -> None:
    steps = np.arange(4 * 32 * 64).reshape(1, 4, 32, 64) % 100
    np.save(tmp_path / "steps.npy", (steps * (1 - 2j)).astype("<c8"))
    (tmp_path / "scene.toml").write_text(wayside.Scene(small_scene()).toml)
    call([*program, "import", "steps.npy", "--scene", "scene.toml", "--out", "steps.cube"], tmp_path)
    cube = wayside.Cube.read(tmp_path / "steps.cube")
    assert (cube.unit, cube.range_doppler().unit) == ("ADC steps", "ADC steps")
    assert wayside.Scene(small_scene()).echo().unit == "sqrt(W)"
    pytest.importorskip("xarray")
    assert cube.to_xarray().attrs["units"] == "ADC steps"
    assert cube.range_doppler().to_xarray()["values"].attrs["units"] == "ADC steps"
