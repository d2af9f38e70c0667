"""Results as tables of pandas and as labelled arrays of xarray, where these are installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._core import Cube, Paths, RangeDoppler, Rcs

_AXES = "xyz"
_POLARIZATIONS = (("vv", 0, 0), ("hh", 1, 1), ("vh", 0, 1), ("hv", 1, 0))


def cube_to_xarray(cube: Cube) -> Any:
    """``xarray.DataArray`` of a cube's samples in its unit: frame, channel, chirp, sample."""
    import xarray

    dims = ("frame", "channel", "chirp", "sample")
    coords = {"time_s": ("frame", cube.time_s)}
    return xarray.DataArray(
        cube.samples, dims=dims, coords=coords, name="samples", attrs={"units": cube.unit}
    )


def maps_to_xarray(maps: RangeDoppler) -> Any:
    """``xarray.Dataset`` of maps: values [frame, channel, velocity_mps, range_m] in their unit, mask.

    Rows of sub-frames have other velocities in each: their axis is ``doppler``, and ``velocity_mps`` is a
    coordinate [frame, doppler].
    """
    import xarray

    of_frames, velocity = maps.velocity_of_frames_mps, "velocity_mps"
    coords: dict[str, Any] = {"time_s": ("frame", maps.time_s), "range_m": maps.range_m}
    if np.all(of_frames == of_frames[:1]):
        rows, coords[velocity] = velocity, maps.velocity_mps
    else:
        rows, coords[velocity] = "doppler", (("frame", "doppler"), of_frames)
    values = (("frame", "channel", rows, "range_m"), maps.values, {"units": maps.unit})
    mask = (("frame", rows, "range_m"), maps.mask, {"of": "0 untested, 1 tested, 2 detected"})
    return xarray.Dataset({"values": values, "mask": mask}, coords=coords)


def rcs_to_xarray(table: Rcs) -> Any:
    """``xarray.Dataset`` of a table: s_m and rcs_dbsm [freq_hz, el_deg, az_deg]."""
    import xarray

    dims = ("freq_hz", "el_deg", "az_deg")
    coords = {"freq_hz": table.freq_hz, "el_deg": table.el_deg, "az_deg": table.az_deg}
    data = {"s_m": (dims, table.s_m, {"units": "m"}), "rcs_dbsm": (dims, table.rcs_dbsm, {"units": "dBsm"})}
    return xarray.Dataset(data, coords=coords, attrs={"far_field_from_m": table.far_field_from_m})


def records_to_pandas(records: Any) -> Any:
    """``pandas.DataFrame`` of a record array; a field of several values has a column for each.

    ``height`` has the words of ``export --to csv``: "measured", "assumed" or "none"; ``told`` of classes has
    their names, or "unknown".
    """
    import pandas

    from . import CLASSES, HEIGHTS

    columns: dict[str, Any] = {}
    for name in records.dtype.names:
        values = records[name]
        for place in np.ndindex(values.shape[1:]):
            suffix = "".join(f"_{index}" for index in place)
            columns[name + suffix] = values[(slice(None), *place)]
    # The index −1 is that of the last word.
    for name, words in (("height", HEIGHTS), ("told", (*CLASSES, "unknown"))):
        if name in columns:
            columns[name] = np.array(words, dtype=object)[columns[name]]
    return pandas.DataFrame(columns)


def paths_to_pandas(paths: Paths) -> Any:
    """``pandas.DataFrame`` of all paths, a row each."""
    import pandas

    tables = [_paths_of(paths[index], paths.targets) for index in range(len(paths))]
    return pandas.concat(tables, ignore_index=True) if tables else pandas.DataFrame()


def _paths_of(frame: Any, targets: list[str]) -> Any:
    import pandas

    order, target, a_m = frame.order, frame.target, frame.a_m
    # The road's own backscatter is no target's.
    names = [targets[index] if index < len(targets) else "" for index in target]
    columns: dict[str, Any] = {"frame": frame.index, "target": names, "order": order}
    columns |= {f"a_{name}_m": a_m[:, receive, transmit] for name, receive, transmit in _POLARIZATIONS}
    for name in ("x_a_m", "x_b_m", "v_a_mps", "v_b_mps"):
        values, (stem, unit) = getattr(frame, name), name.rsplit("_", 1)
        columns |= {f"{stem}_{axis}_{unit}": values[:, i] for i, axis in enumerate(_AXES)}
    columns |= {"delay_s": frame.delay_s, "delay_rate": frame.delay_rate}
    spans = frame.spans
    columns |= {f"span_{name}": spans[name] for name in ("first_s", "step_s", "moments", "moment")}
    for name in ("transmit", "receive"):
        columns |= {f"array_span_{name[:1]}x_{axis}": spans[name][:, i] for i, axis in enumerate(_AXES)}
    columns |= {f"array_span_{name}": spans[name] for name in ("first_m", "step_m", "places", "place")}
    for name in ("transmit", "receive"):
        side = spans[f"side_{name}"]
        columns |= {f"array_side_{name[:1]}x_{axis}": side[:, i] for i, axis in enumerate(_AXES)}
    columns["array_side_from_m"] = spans["side_from_m"]
    return pandas.DataFrame(columns, index=range(len(order)))
