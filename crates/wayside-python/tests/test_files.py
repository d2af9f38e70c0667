"""Files: the command line's to the byte, and read back as they were written."""

from __future__ import annotations

import filecmp
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import call, small_scene

import wayside

PLATE = "v 0 -0.1 -0.15\nv 0 0.1 -0.15\nv 0 0.1 0.15\nv 0 -0.1 0.15\nf 1 2 3 4\n"


def test_an_ending_of_another_format_is_refused(scene: wayside.Scene, tmp_path: Path) -> None:
    paths, maps = scene.trace(), scene.range_doppler()
    found = maps.detect()
    table = wayside.rcs("car-suv", 1.0)
    for result in (paths, scene.echo(paths), maps, found, found.track(), table):
        for ending, writer in (("glb", "vehicles"), ("CSV", "export FILE --to csv")):
            with pytest.raises(wayside.WaysideError, match=f"is written by `wayside {writer}`"):
                result.write(tmp_path / f"x.{ending}")
    with pytest.raises(wayside.WaysideError, match="`run` writes a folder"):
        scene.run(tmp_path / "x.npy")
    assert not list(tmp_path.iterdir())
    paths.write(tmp_path / "x.y")
    assert len(wayside.Paths.read(tmp_path / "x.y")) == 2


def of_command(program: list[str], folder: Path) -> wayside.Scene:
    """The small scene from a file, and in `c` what the commands make of it."""
    file = folder / "scene.toml"
    file.write_text(wayside.Scene(small_scene()).toml)
    call([*program, "paths", str(file), "--out", "c/c.paths", "--quiet"], folder)
    call([*program, "echo", str(file), "--out", "c/c.cube", "--quiet"], folder)
    call([*program, "dsp", "c/c.cube", "--out", "c", "--quiet"], folder)
    return wayside.Scene(file)


def is_same(one: Path, other: Path) -> bool:
    return filecmp.cmp(one, other, shallow=False)


def test_files_are_those_of_the_command_line_to_the_byte(program: list[str], tmp_path: Path) -> None:
    scene = of_command(program, tmp_path)
    paths = scene.trace()
    cube = scene.echo(paths)
    maps = cube.range_doppler()
    found = maps.detect()
    for result, kind in (
        (paths, "paths"),
        (cube, "cube"),
        (maps, "rdm"),
        (found, "points"),
        (found.track(), "tracks"),
    ):
        own, commands = tmp_path / f"own.{kind}", tmp_path / f"c/c.{kind}"
        result.write(own)
        assert is_same(own, commands), kind
        read = type(result).read(commands)
        assert (len(read), repr(read)) == (len(result), repr(result))
        read.write(tmp_path / f"again.{kind}")
        assert is_same(tmp_path / f"again.{kind}", commands), kind


def test_what_was_read_goes_on_as_what_was_made(scene: wayside.Scene, tmp_path: Path) -> None:
    cube = scene.echo()
    maps = cube.range_doppler()
    found = maps.detect()
    files = [tmp_path / f"own.{kind}" for kind in ("cube", "rdm", "points", "tracks")]
    for result, file in zip((cube, maps, found, found.track()), files):
        result.write(file)
    assert np.array_equal(wayside.Cube.read(files[0]).samples, cube.samples)
    of_file = wayside.RangeDoppler.read(files[1])
    for name in ("values", "mask", "range_m", "velocity_of_frames_mps", "time_s"):
        assert np.array_equal(getattr(of_file, name), getattr(maps, name)), name
    assert (of_file.unit, of_file.detections) == (maps.unit, maps.detections)
    assert of_file.detect().points.tobytes() == found.points.tobytes()
    assert of_file.detect().classify().tobytes() == found.classify().tobytes()
    points = wayside.Detections.read(files[2])
    assert points.points.tobytes() == found.points.tobytes()
    assert points.objects.tobytes() == found.objects.tobytes()
    assert points.track().records.tobytes() == found.track().records.tobytes()
    assert wayside.Tracks.read(files[3]).records.tobytes() == found.track().records.tobytes()


def test_what_a_file_does_not_hold_is_refused(tmp_path: Path) -> None:
    maps = wayside.Scene(small_scene(dsp={"refine": "on"})).range_doppler()
    maps.write(tmp_path / "own.rdm")
    maps.detect().write(tmp_path / "own.points")
    with pytest.raises(wayside.WaysideError, match=r'refine = "on" in \[dsp\] refines points on'):
        wayside.RangeDoppler.read(tmp_path / "own.rdm").detect()
    with pytest.raises(wayside.WaysideError, match="classes are told from the maps"):
        wayside.Detections.read(tmp_path / "own.points").classify()


@pytest.mark.parametrize("kind", ["Paths", "Cube", "RangeDoppler", "Detections", "Tracks", "Rcs"])
def test_a_file_of_another_kind_is_refused_by_its_name(kind: str, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.write_bytes(b"no artifact at all")
    for place, kinds in ((other, ("refused", "system")), (tmp_path / "none", ("system",))):
        with pytest.raises(wayside.WaysideError, match=place.name) as refused:
            getattr(wayside, kind).read(place)
        assert refused.value.kind in kinds


def test_a_run_leaves_the_files_of_the_command_line(program: list[str], tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(wayside.Scene(small_scene()).toml)
    summary = wayside.Scene(file).run(tmp_path / "own")
    call([*program, "run", str(file), "--out", "c", "--no-cache", "--quiet"], tmp_path)
    files = sorted(p.relative_to(tmp_path / "c") for p in (tmp_path / "c").rglob("*") if p.is_file())
    own = sorted(p.relative_to(tmp_path / "own") for p in (tmp_path / "own").rglob("*") if p.is_file())
    assert own == files
    for name in files:
        if name.name not in ("summary.json", "report.html"):
            assert is_same(tmp_path / "own" / name, tmp_path / "c" / name), name
    commands = json.loads((tmp_path / "c/summary.json").read_text())
    assert _lasting(summary) == _lasting(commands)
    assert [target["id"] for target in summary["frames"][0]["targets"]] == ["near", "far"]


def _lasting(told: object) -> object:
    """A summary without what may differ between runs: times and memory."""
    if isinstance(told, list):
        return [_lasting(each) for each in told]
    if not isinstance(told, dict):
        return told
    passing = ("_seconds", "_mib")
    return {
        key: _lasting(value) for key, value in told.items() if not key.endswith(passing) and key != "cached"
    }


# Requests of a plate, with the words of the command line.
TABLES: list[tuple[dict[str, Any], list[str]]] = [
    ({"freq_ghz": 77.0, "az_deg": 0.0}, ["--az-deg", "0"]),
    (
        {"freq_ghz": 77, "az_deg": np.linspace(-10.0, 10.0, 5), "el_deg": 0.1, "range_m": 30, "edges": "on"},
        ["--az-deg", "-10:10:5", "--el-deg", "0.1", "--range-m", "30", "--edges", "on"],
    ),
    (
        {
            "freq_ghz": 77.0,
            "az_deg": [0.0, 7.0],
            "pol": "hh",
            "bounces": 1,
            "nodes": "exit",
            "sides": "one",
            "accuracy_db": -30.0,
            "rx_az_deg": 20.0,
            "rx_el_deg": 1.0,
            "unit_scale": 0.5,
        },
        "--az-deg 0:7:2 --pol hh --bounces 1 --nodes exit --sides one --accuracy-db -30 --rx-az-deg 20 "
        "--rx-el-deg 1 --unit-scale 0.5".split(),
    ),
]
# Lines of S.json that may differ between two runs.
OF_A_RUN = {"load", "build", "trace", "integrate", "check", "total", "processor_total", "peak_memory_mib"}


@pytest.mark.parametrize(("asked", "words"), TABLES)
def test_a_table_and_its_description_are_those_of_the_command_line(
    program: list[str], tmp_path: Path, asked: dict[str, Any], words: list[str]
) -> None:
    mesh, commands, own = (tmp_path / name for name in ("plate.obj", "c.npy", "own.npy"))
    mesh.write_text(PLATE)
    command = [*program, "rcs", str(mesh), "--freq-ghz", "77", *words, "--out", str(commands), "--quiet"]
    call(command, tmp_path)
    table = wayside.rcs(mesh, **asked)
    for _ in range(2):
        table.write(own)
        assert is_same(own, commands)
    lines = [place.with_suffix(".json").read_text().splitlines() for place in (own, commands)]
    differing = [pair for pair in zip(*lines, strict=True) if pair[0] != pair[1]]
    assert {line.split(":")[0].strip(' "') for line, _ in differing} <= OF_A_RUN


def test_a_table_is_read_back_as_it_was_written(tmp_path: Path) -> None:
    mesh, file, again = (tmp_path / name for name in ("plate.obj", "S.npy", "again.npy"))
    mesh.write_text(PLATE)
    for range_m in (30.0, np.inf):
        table = wayside.rcs(mesh, [76.0, 77.1], az_deg=[0.1, 0.2, 0.3], el_deg=1.7, range_m=range_m)
        # A file that was read is not replaced.
        file, again = (place.with_name(f"{range_m:.0f}-{place.name}") for place in (file, again))
        table.write(file)
        read = wayside.Rcs.read(file)
        for name in ("s_m", "rcs_dbsm", "freq_hz", "el_deg", "az_deg"):
            assert np.array_equal(getattr(read, name), getattr(table, name)), name
        for name in ("range_m", "far_field_from_m", "error_db", "model_error_db"):
            assert getattr(read, name) == getattr(table, name), name
        assert (table.az_deg.tolist(), table.el_deg.tolist()) == ([0.1, 0.2, 0.3], [1.7])
        read.write(again)
        assert is_same(again, file)
        assert is_same(again.with_suffix(".json"), file.with_suffix(".json"))


def test_a_table_and_a_description_of_another_one_are_refused(tmp_path: Path) -> None:
    file, told = tmp_path / "S.npy", tmp_path / "S.json"
    wayside.rcs("car-suv", 1.0, az_deg=[0.0, 1.0]).write(file)
    np.save(file, np.zeros((1, 1, 3), complex))
    with pytest.raises(wayside.WaysideError, match=r"S\.npy: S is complex128 \[1, 1, 2\]") as refused:
        wayside.Rcs.read(file)
    assert (refused.value.kind, refused.value.file) == ("refused", str(file))
    np.save(file, np.zeros((1, 1, 2)))
    with pytest.raises(wayside.WaysideError, match=r"S\.npy: S is complex128"):
        wayside.Rcs.read(file)
    file.unlink()
    with pytest.raises(wayside.WaysideError, match=r"S\.npy: cannot read") as missing:
        wayside.Rcs.read(file)
    assert missing.value.kind == "system"
    told.write_text('{"axes": {"freq_hz": [1e9]}}')
    with pytest.raises(wayside.WaysideError, match=r"S\.json: `mesh\.size_m` of a table"):
        wayside.Rcs.read(file)
