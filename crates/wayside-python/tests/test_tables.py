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


def test_points_objects_and_classes_are_tables_by_their_names(scene: wayside.Scene) -> None:
    pytest.importorskip("pandas")
    found = scene.detect()
    assert found.to_pandas().equals(found.to_pandas("points"))
    objects, classes = found.to_pandas("objects"), found.to_pandas("classes")
    assert objects.range_m.tolist() == found.objects.range_m.tolist()
    assert {"position_m_2", "range_extent_m_0", "ghost_share"} <= set(objects.columns)
    assert set(objects.height) == {"assumed"}
    assert classes.columns.tolist() == ["frame", "object", *wayside.CLASSES, "told"]
    words = [*wayside.CLASSES, "unknown"]
    assert classes.told.tolist() == [words[told] for told in found.classify().told]
    assert len(classes) == len(objects) > 0
    with pytest.raises(ValueError, match="of: `tracks`; it can be `points`, `objects`, `classes`"):
        found.to_pandas("tracks")


def test_classes_of_a_table_are_told_of_and_come_of_the_model_that_is_named(scene: wayside.Scene) -> None:
    pytest.importorskip("pandas")
    shares: list[float] = []
    scene.detect().to_pandas("classes", progress=lambda text, share: shares.append(share))
    assert shares[-1] == 1
    with pytest.raises(wayside.WaysideError, match="no-such.model"):
        scene.detect().to_pandas("classes", model="no-such.model")


def test_a_table_of_cross_sections_has_named_axes() -> None:
    pytest.importorskip("xarray")
    table = wayside.rcs("car-suv", [1.0, 2.0], az_deg=[0.0, 1.0, 2.0], el_deg=5.0)
    labelled = table.to_xarray()
    assert labelled["s_m"].dims == labelled["rcs_dbsm"].dims == ("freq_hz", "el_deg", "az_deg")
    assert labelled["s_m"].shape == (2, 1, 3)
    assert np.array_equal(labelled["s_m"].values, table.s_m)
    assert labelled["rcs_dbsm"].sel(freq_hz=2e9, az_deg=1.0).item() == table.rcs_dbsm[1, 0, 1]
    assert (labelled["s_m"].attrs["units"], labelled["rcs_dbsm"].attrs["units"]) == ("m", "dBsm")
    assert labelled.attrs["far_field_from_m"] == table.far_field_from_m


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
