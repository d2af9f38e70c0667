"""Stage by stage: what comes out, and in which shapes."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import small_scene

import wayside

C_MPS = 299_792_458.0


def test_paths_are_a_structure_of_arrays(scene: wayside.Scene) -> None:
    paths = scene.trace()
    assert len(paths) == 2
    assert paths.targets == ["near", "far"]
    frame = paths[0]
    assert len(frame) == 2
    assert (frame.a_m.shape, frame.a_m.dtype) == ((2, 2, 2), np.complex128)
    assert (frame.x_a_m.shape, frame.order.tolist(), frame.target.tolist()) == ((2, 3), [0, 0], [0, 1])
    # A point target: a_vv = a_hh = √rcs, no cross polarization.
    assert np.allclose(frame.a_m[:, 0, 0], np.sqrt([10.0, 100.0]), rtol=1e-12)
    assert np.all(frame.a_m[:, 0, 1] == 0)
    assert np.array_equal(frame.v_a_mps[1], [0.0, -8.0, 0.0])
    # Each stands for the whole frame and the whole array.
    assert frame.spans.moment.tolist() == frame.spans.places.tolist() == [-1, -1]
    assert np.all(np.isnan(frame.spans.transmit)) and frame.spans.transmit.shape == (2, 3)
    assert paths[-1].index == 1
    with pytest.raises(IndexError):
        paths[2]


def test_the_delay_is_twice_the_range_at_the_frames_middle(scene: wayside.Scene) -> None:
    frame = scene.trace()[0]
    middle_s = 0.5 * 32 * scene.radar["chirp_interval_s"]
    place = frame.x_a_m + frame.v_a_mps * middle_s - np.array([0.0, 0.0, 6.0])
    # Half a chirp interval of either reading of the middle moves 8 m/s by 0.1 mm.
    assert np.allclose(frame.delay_s * C_MPS / 2, np.linalg.norm(place, axis=1), atol=8 * 30e-6)
    assert frame.delay_rate[1] < 0


def test_a_cube_is_handed_over_without_a_copy(scene: wayside.Scene) -> None:
    cube = scene.echo()
    samples = cube.samples
    assert (samples.shape, samples.dtype) == ((2, 4, 32, 64), np.complex64)
    assert samples.flags.c_contiguous
    assert np.shares_memory(samples, cube.samples)
    maps = cube.range_doppler()
    assert np.shares_memory(maps.values, maps.values)
    assert np.shares_memory(maps.mask, maps.mask)


def change_in_every_way(array: Any) -> None:
    """Gives an array and the one that its memory is of another type, another shape and other strides."""
    for own in (array, array.base):
        if isinstance(own, np.ndarray):
            own.dtype = np.dtype(f"V{own.dtype.itemsize // 4 or 1}")
            own.shape = (-1,)
            own.strides = (0,)


def test_arrays_that_were_handed_out_may_be_changed_in_type_and_shape(scene: wayside.Scene) -> None:
    cube, maps = scene.echo(), scene.range_doppler()
    cube.samples.dtype = np.complex128
    maps.values.dtype = np.float32
    maps.mask.shape = (-1,)
    assert (cube.samples.shape, cube.samples.dtype) == ((2, 4, 32, 64), np.complex64)
    assert len(cube.range_doppler()) == 2
    assert maps.detect().points.tobytes() == scene.points().tobytes()


# NumPy deprecates that strides are assigned; as long as it lets one do so it must not end in a crash.
@pytest.mark.filterwarnings("ignore:Setting the")
def test_what_is_no_longer_what_it_was_is_refused(scene: wayside.Scene, tmp_path: Path) -> None:
    cube, maps = scene.echo(), scene.range_doppler()
    change_in_every_way(cube.samples)
    for use in (cube.range_doppler, lambda: cube.samples, lambda: cube.write(tmp_path / "a.cube")):
        with pytest.raises(ValueError, match=r"samples: the array has no longer its type"):
            use()
    change_in_every_way(maps.mask)
    for of_mask in (maps.detect, lambda: maps.mask):
        with pytest.raises(ValueError, match=r"mask: the array has no longer its type"):
            of_mask()
    table = wayside.rcs("car-suv", 1.0, az_deg=[0, 1])
    change_in_every_way(table.s_m)
    for of_table in (lambda: table.rcs_dbsm, lambda: table.s_m):
        with pytest.raises(ValueError, match=r"s_m: the array has no longer its type"):
            of_table()


def test_an_array_of_others_may_change_under_a_cube(scene: wayside.Scene) -> None:
    samples = scene.echo().samples.copy()
    cube = wayside.Cube(samples, scene)
    samples.dtype = np.float32
    with pytest.raises(ValueError, match="samples: the array has no longer its type"):
        cube.range_doppler()
    samples.dtype = np.complex64
    samples.resize((1, 4, 32, 64), refcheck=False)
    with pytest.raises(ValueError, match=r"its shape \[2, 4, 32, 64\]"):
        cube.range_doppler()


def test_samples_out_of_their_place_in_memory_are_copied(scene: wayside.Scene) -> None:
    samples = scene.echo().samples
    memory = np.zeros(samples.nbytes + 1, np.uint8)
    aside = memory[1:].view(np.complex64).reshape(samples.shape)
    aside[:] = samples
    assert not aside.flags.aligned
    assert np.array_equal(wayside.Cube(aside, scene).samples, samples)
    swapped = samples.astype(samples.dtype.newbyteorder())
    assert np.array_equal(wayside.Cube(swapped, scene).samples, samples)


def test_the_echo_of_paths_is_the_echo_of_the_scene(scene: wayside.Scene) -> None:
    assert np.array_equal(scene.echo(scene.trace()).samples, scene.echo().samples)


def test_paths_of_another_sweep_are_refused(scene: wayside.Scene) -> None:
    other = small_scene()
    other["radar"]["waveform"]["start_frequency_ghz"] = 76.0
    with pytest.raises(wayside.WaysideError, match="amplitudes hold for the sweep"):
        wayside.Scene(other).echo(scene.trace())


def test_what_is_detected_is_where_it_stands(scene: wayside.Scene) -> None:
    found = scene.detect()
    objects, points = found.objects, found.points
    assert objects.frame.tolist() == [0, 0, 1, 1]
    cell_m = scene.radar["range_resolution_m"]
    for x, y, speed in ((2.0, 12.0, 0.0), (0.0, 40.0, -8.0)):
        range_m = np.sqrt(x**2 + y**2 + 25.0)
        nearest = objects[np.argmin(np.abs(objects.range_m - range_m))]
        assert abs(nearest.range_m - range_m) < cell_m
        assert abs(nearest.radial_velocity_mps - speed * y / range_m) < scene.radar["velocity_resolution_mps"]
    assert points.position_m.shape == (len(points), 3)
    assert set(points.object) <= {-1, 0, 1}


def changed_array(**array: Any) -> dict[str, Any]:
    waveform = small_scene()["radar"]["waveform"]
    return small_scene(radar={"waveform": waveform, "array": array})


def test_points_say_what_their_heights_stand_on(scene: wayside.Scene) -> None:
    found = scene.detect()
    assert set(found.points.height) == set(found.objects.height) == {wayside.HEIGHTS.index("assumed")}
    rows = {"tx_half_wavelengths": [[0, 0]], "rx_half_wavelengths": [[0, 0], [1, 0], [0, 1], [1, 1]]}
    points = wayside.Scene(changed_array(**rows)).points()
    assert set(points.height) == {wayside.HEIGHTS.index("measured")}


def near_scene() -> dict[str, Any]:
    """A reflector nearer than the assumed height is below the radar."""
    near = {"kind": "point", "id": "near", "rcs_m2": 10.0, "position_m": [0.0, 3.5, 5.0]}
    return small_scene(target=[near])


def test_points_without_a_height_are_told_as_the_command_line_tells_them(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with caplog.at_level(logging.INFO, logger="wayside"):
        points = wayside.Scene(near_scene()).detect().points
    without = points[points.height == wayside.HEIGHTS.index("none")]
    assert len(without) > 0
    assert np.allclose(without.position_m[:, 2], 6.0), "the radar's own"
    told = f"{len(without)} of {len(points)} points are nearer than assumed_height_m is below or above the radar"
    assert [record.message for record in caplog.records if told in record.message]


def test_an_array_that_tells_no_azimuth_is_told(caplog: pytest.LogCaptureFixture) -> None:
    column = {"tx_half_wavelengths": [[0, 0]], "rx_half_wavelengths": [[0, 0], [0, 1]]}
    with caplog.at_level(logging.INFO, logger="wayside"):
        wayside.Scene(changed_array(**column)).detect()
    assert any("tells no azimuth" in record.message for record in caplog.records)


def holders(scene: wayside.Scene) -> dict[str, tuple[Any, list[str]]]:
    """Objects of each class with the names of their arrays that the library has in another form."""
    cube = scene.echo()
    maps = cube.range_doppler()
    found = maps.detect()
    of_paths = ["a_m", "slope_m_per_hz", "x_a_m", "x_b_m", "v_a_mps", "v_b_mps"]
    of_paths += ["order", "target", "spans", "delay_s", "delay_rate"]
    return {
        "PathsFrame": (scene.trace()[0], of_paths),
        "Cube": (cube, ["time_s"]),
        "RangeDoppler": (maps, ["range_m", "velocity_mps", "velocity_of_frames_mps", "time_s"]),
        "Detections": (found, ["points", "objects"]),
        "Tracks": (found.track(), ["records"]),
        "Rcs": (wayside.rcs("car-suv", 1.0, az_deg=[0, 1]), ["freq_hz", "el_deg", "az_deg"]),
    }


def test_an_array_is_made_once_and_each_access_is_of_the_same_memory(scene: wayside.Scene) -> None:
    for kind, (holder, names) in holders(scene).items():
        for name in names:
            first, second = getattr(holder, name), getattr(holder, name)
            assert first.size > 0 and type(first) is type(second), (kind, name)
            assert np.shares_memory(first, second), (kind, name)
            shape, dtype = second.shape, second.dtype
            first.shape = (1, *shape)
            assert (getattr(holder, name).shape, getattr(holder, name).dtype) == (shape, dtype), (kind, name)
            with pytest.raises(ValueError):
                second.flags.writeable = True


def test_a_cross_section_follows_the_amplitudes_that_may_be_changed() -> None:
    table = wayside.rcs("car-suv", 1.0, az_deg=[0, 1])
    before = table.rcs_dbsm
    table.s_m[...] *= 10.0
    assert np.allclose(table.rcs_dbsm - before, 20.0, atol=1e-9)


def test_arrays_that_the_library_has_in_another_form_are_read_only(scene: wayside.Scene) -> None:
    frame, maps, found = scene.trace()[0], scene.range_doppler(), scene.detect()
    made = [frame.a_m, frame.x_a_m, frame.order, frame.target, frame.delay_s, frame.spans, maps.range_m]
    made += [maps.velocity_of_frames_mps, maps.time_s, found.points, found.objects, found.track().records]
    for array in made:
        assert not array.flags.writeable
        assert array.copy().flags.writeable
    assert maps.values.flags.writeable and maps.mask.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        frame.a_m[0] = 0


def test_tracks_and_classes_belong_to_objects(scene: wayside.Scene) -> None:
    found = scene.detect()
    tracks = found.track().records
    assert tracks.covariance.shape == (len(tracks), 4, 4)
    assert set(tracks.state) <= {0, 1, 2}
    classes = found.classify()
    assert len(classes) == len(found.objects)
    sums = sum(classes[name] for name in wayside.CLASSES)
    assert np.allclose(sums, 1.0, atol=1e-5)
    assert set(classes.told) <= {-1, 0, 1, 2, 3}


def test_anybodys_samples_become_a_cube(scene: wayside.Scene) -> None:
    samples = scene.echo().samples.copy()
    cube = wayside.Cube(samples, scene)
    assert np.shares_memory(cube.samples, samples)
    assert np.array_equal(cube.range_doppler().values, scene.range_doppler().values)
    one = wayside.Cube(samples[0].astype(np.complex128), small_scene())
    assert one.samples.shape == (1, 4, 32, 64)


def test_steps_of_a_converter_are_no_root_watts(scene: wayside.Scene) -> None:
    samples = scene.echo().samples
    assert wayside.Cube(samples, scene).unit == "sqrt(W)"
    steps = np.round(samples / np.abs(samples).max() * 2000)
    cube = wayside.Cube(steps, scene)
    assert (cube.unit, cube.range_doppler().unit) == ("ADC steps", "ADC steps")
    assert wayside.Cube(samples / np.abs(samples).max(), scene, full_scale=1.0).unit == "ADC steps"
    for none in (0.0, -1.0, np.inf, np.nan):
        with pytest.raises(wayside.WaysideError, match="full_scale must be a number of steps above 0"):
            wayside.Cube(samples, scene, full_scale=none)


def test_samples_that_are_not_the_radars_are_refused(scene: wayside.Scene) -> None:
    samples = scene.echo().samples.copy()
    with pytest.raises(wayside.WaysideError, match=r"is \[3, 32, 64\], the scene's radar has \[4, 32, 64\]"):
        wayside.Cube(samples[:, :3], scene)
    samples[1, 2, 3, 4] = np.nan
    with pytest.raises(wayside.WaysideError, match=r"\(1, 2, 3, 4\): samples must be finite"):
        wayside.Cube(samples, scene)
    with pytest.raises(ValueError, match="samples: 2 axes"):
        wayside.Cube(samples[0, 0], scene)


def test_a_sample_that_is_written_and_no_number_is_refused_with_its_place(
    scene: wayside.Scene, tmp_path: Path
) -> None:
    cube = scene.echo()
    cube.samples[1, 2, 3, 4] = np.nan
    told = r"\(1, 2, 3, 4\): samples must be finite"
    with pytest.raises(wayside.WaysideError, match=told):
        cube.range_doppler()
    with pytest.raises(wayside.WaysideError, match=told):
        cube.write(tmp_path / "a.cube")
    assert not (tmp_path / "a.cube").exists()


def test_a_value_of_a_map_that_is_no_number_is_refused_with_its_frame_and_cell(scene: wayside.Scene) -> None:
    maps = scene.range_doppler()
    maps.values[1, 2, 3, 4] = np.nan
    told = "frame 1: channel 2, Doppler cell 3, range cell 4 of the map is not finite"
    with pytest.raises(wayside.WaysideError, match=told):
        maps.detect()


def test_samples_that_no_such_radar_gives_are_refused(scene: wayside.Scene) -> None:
    samples = scene.echo().samples
    steps = np.round(samples / np.abs(samples).max() * 2000)
    with pytest.raises(wayside.WaysideError, match="a part is beyond the full scale of 100"):
        wayside.Cube(steps, scene, full_scale=100)
    words = [part.astype(np.int16).view(np.uint16) for part in (steps.real, steps.imag)]
    with pytest.raises(wayside.WaysideError, match="words without sign[?] cast them to int16"):
        wayside.Cube(words[0] + 1j * words[1], scene)
    with pytest.raises(wayside.WaysideError, match=r'sampling = "real" in \[radar.receiver\]'):
        wayside.Cube(samples.real, scene)
    with pytest.raises(wayside.WaysideError, match="there is no frame"):
        wayside.Cube(samples[:0], scene)


def test_samples_behind_a_mask_have_no_value(scene: wayside.Scene) -> None:
    samples = scene.echo().samples
    with pytest.raises(ValueError, match="samples: it is a masked array"):
        wayside.Cube(np.ma.masked_greater(samples.real, 0) + 1j * samples.imag, scene)
    assert np.array_equal(wayside.Cube(np.ma.masked_array(samples), scene).samples, samples)


def test_a_recording_by_a_scene_without_noise_has_the_noise_of_its_map(
    scene: wayside.Scene, caplog: pytest.LogCaptureFixture
) -> None:
    silent = small_scene()
    del silent["noise"]
    samples = scene.echo().samples
    steps = np.round(samples / np.abs(samples).max() * 32000)
    with caplog.at_level(logging.INFO, logger="wayside"):
        cubes = [wayside.Cube(steps, told) for told in (scene, silent)]
        expected, found = (cube.range_doppler().detect().points.snr_db for cube in cubes)
        assert np.array_equal(expected, found)
        assert not any("there is no noise" in record.message for record in caplog.records)
        wayside.Cube(samples, silent).range_doppler().detect()
    assert any("there is no noise: a floor 60 dB below" in record.message for record in caplog.records)


def test_a_tone_lands_in_its_cell_of_the_map(scene: wayside.Scene) -> None:
    chirp, sample = np.mgrid[0:32, 0:64]
    tone = np.exp(2j * np.pi * (20 * sample / 64 + 4 * chirp / 32))
    maps = wayside.Cube(np.broadcast_to(tone, (4, 32, 64)), scene).range_doppler()
    power = np.abs(maps.values[0, 0])
    doppler, cell = np.unravel_index(np.argmax(power), power.shape)
    assert (doppler, cell) == (16 + 4, 20)
    assert maps.velocity_mps[doppler] > 0
    assert maps.velocity_mps[16] == 0
    assert len(maps.range_m) == 64
