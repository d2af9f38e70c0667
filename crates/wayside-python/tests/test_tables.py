"""Results as tables of pandas and arrays of xarray."""

from __future__ import annotations

import numpy as np
import pytest

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
    assert "covariance_3_3" in found.track().to_pandas().columns
