"""S of a mesh: a plate in closed form."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wayside

C_MPS = 299_792_458.0


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    """A plate of 0.2 m × 0.3 m about the origin, facing +x."""
    file = tmp_path / "plate.obj"
    file.write_text("v 0 -0.1 -0.15\nv 0 0.1 -0.15\nv 0 0.1 0.15\nv 0 -0.1 0.15\nf 1 2 3 4\n")
    return file


def test_a_plate_at_broadside_has_the_level_of_physical_optics(plate: Path) -> None:
    table = wayside.rcs(plate, [77.0, 78.0], az_deg=0.0)
    assert (table.s_m.shape, table.s_m.dtype) == ((2, 1, 1), np.complex128)
    # σ = 4π A²/λ²; asked for −40 dB, 1 % of the amplitude: 0.09 dB.
    wavelength_m = C_MPS / table.freq_hz
    level = 10 * np.log10(4 * np.pi * (0.06 / wavelength_m) ** 2)
    assert np.allclose(table.rcs_dbsm[:, 0, 0], level, atol=0.09)
    # 2D²/λ at the highest frequency, D the diagonal.
    assert table.far_field_from_m == pytest.approx(2 * 0.13 / wavelength_m[1], rel=1e-12)
    assert table.error_db["total"] is None or table.error_db["total"] < -40


def test_axes_are_those_asked_for(plate: Path) -> None:
    table = wayside.rcs(plate, 77.0, az_deg=np.linspace(-10, 10, 5), el_deg=[0.0, 5.0], bounces=1)
    assert table.s_m.shape == (1, 2, 5)
    assert np.allclose(table.az_deg, np.linspace(-10, 10, 5))
    # The plate is its own mirror image in the plane y = 0.
    assert np.allclose(np.abs(table.s_m[0, 0]), np.abs(table.s_m[0, 0, ::-1]), rtol=1e-6)


def test_a_word_that_is_none_is_refused_with_those_that_are(plate: Path) -> None:
    with pytest.raises(ValueError, match=r"pol: `xx`; it can be `vv`, `hh`, `vh`, `hv`"):
        wayside.rcs(plate, 77.0, pol="xx")


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"el_deg": 120}, "el_deg: it must be from -90 to 90, is 120"),
        ({"freq_ghz": []}, "freq_ghz: at least one value"),
        ({"freq_ghz": float("nan")}, "freq_ghz: it must be from 0.001 to 10000, is NaN"),
        ({"bounces": 0}, "bounces: it must be from 1 to 5, is 0"),
        ({"bounces": -1}, "bounces: it must be from 1 to 5, is -1"),
        ({"unit_scale": -1}, "unit_scale: it must be from 1e-9 to 1000000, is -1"),
        ({"range_m": 0}, "range_m: it must be from 0.001 to 1e9, is 0, or inf"),
        ({"rx_az_deg": 10}, "rx_el_deg: rx_az_deg needs it"),
        ({"rx_el_deg": 10}, "rx_az_deg: rx_el_deg needs it"),
        ({"rx_range_m": 10}, "rx_az_deg: rx_range_m needs it"),
        ({"rx_az_deg": 10, "rx_el_deg": 200}, "rx_el_deg: it must be from -90 to 90, is 200"),
        ({"rx_az_deg": 10, "rx_el_deg": 0, "rx_range_m": -5}, "rx_range_m: it must be from 0.001"),
        ({"memory_limit_mib": -1}, "memory_limit_mib: it must be from 1 to 16777216, is -1"),
        ({"accuracy_db": 0}, "accuracy_db"),
    ],
)
def test_numbers_are_bounded_as_on_the_command_line(plate: Path, changes: dict[str, Any], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        wayside.rcs(plate, **({"freq_ghz": 77.0} | changes))


def test_bounds_of_a_mesh_have_a_scale_above_0(plate: Path) -> None:
    with pytest.raises(ValueError, match="unit_scale: it must be from 1e-9"):
        wayside.mesh_bounds_m(plate, unit_scale=-1)


def test_the_words_of_a_refusal_are_the_command_lines(program: list[str], plate: Path) -> None:
    words = [*program, "rcs", str(plate), "--freq-ghz", "77", "--out", str(plate.with_suffix(".npy"))]
    for option, argument in (("--unit-scale=-1", {"unit_scale": -1}), ("--bounces=0", {"bounces": 0})):
        said = subprocess.run([*words, option], capture_output=True, text=True, timeout=60)
        with pytest.raises(ValueError) as refused:
            wayside.rcs(plate, 77.0, **argument)
        assert said.returncode == 2
        assert str(refused.value).split(": ", 1)[1] in said.stderr


def test_materials_and_transmission_are_those_of_the_command(program: list[str], tmp_path: Path) -> None:
    # A pane before a plate: the wave comes through it, is reflected and comes back.
    mesh, skins, out = (tmp_path / name for name in ("two.obj", "skins.toml", "s.npy"))
    square = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]
    corners = [f"v {x} {y} {z}\n" for x in (0.1, 0.0) for y, z in square]
    mesh.write_text("".join(corners) + "usemtl pane\nf 1 2 3 4\nusemtl back\nf 5 6 7 8\n")
    skins.write_text('[materials]\npane = { substance = "glass", thickness_mm = 4.0 }\nback = { substance = "metal" }\n')
    words = [*program, "rcs", str(mesh), "--freq-ghz", "77", "--az-deg", "0", "--out", str(out)]
    levels = []
    for told in ({}, {"materials": skins}, {"materials": skins, "transmission": "on"}):
        options = [word for name, value in told.items() for word in (f"--{name}", str(value))]
        subprocess.run([*words, *options], check=True, capture_output=True, timeout=120)
        table = wayside.rcs(mesh, 77.0, 0.0, **told)
        assert np.array_equal(table.s_m, np.load(out))
        levels.append(table.rcs_dbsm.item())
    assert len(set(levels)) == 3


def test_transmission_needs_materials(plate: Path) -> None:
    with pytest.raises(ValueError, match="materials: transmission needs it"):
        wayside.rcs(plate, 77.0, transmission="on")
    with pytest.raises(ValueError, match="transmission: `yes`; it can be `on`, `off`"):
        wayside.rcs(plate, 77.0, transmission="yes")
    with pytest.raises(wayside.WaysideError, match="no-such.toml") as refused:
        wayside.rcs(plate, 77.0, materials="no-such.toml")
    assert refused.value.kind == "system"


def test_broken_rules_of_materials_name_their_file_and_their_places(plate: Path) -> None:
    file = plate.with_name("m.toml")
    file.write_text('[materials]\npaint = { substance = "glas" }\nback = { substance = "metl" }\n')
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.rcs(plate, 77.0, materials=file)
    error = refused.value
    places = [(fault["file"], fault["line"], fault["column"], fault["place"]) for fault in error.faults]
    assert places == [(str(file), 2, 23, "material `paint`"), (str(file), 3, 22, "material `back`")]
    assert error.kind == "refused"
    assert error.rule.startswith("there is no substance `glas`; the nearest is `glass`;")
    assert str(error).splitlines()[0] == f"{file}:2:23: material `paint`: {error.rule}"


def test_materials_that_are_missing_are_the_file_of_their_failure(plate: Path) -> None:
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.rcs(plate, 77.0, materials="nope.toml")
    error = refused.value
    assert (error.kind, error.file, error.line, error.place) == ("system", "nope.toml", None, None)
    assert str(error) == f"nope.toml: {error.rule}"


def test_a_broken_mesh_is_refused_with_its_line(tmp_path: Path) -> None:
    file = tmp_path / "b.obj"
    file.write_text("v 0 0 0\nv 0 1 0\nf 1 2 5\n")
    for work in (lambda: wayside.rcs(file, 77.0), lambda: wayside.mesh_bounds_m(file)):
        with pytest.raises(wayside.WaysideError) as refused:
            work()
        error = refused.value
        assert (error.file, error.line, error.column, error.place) == (str(file), 3, None, None)
        assert error.rule is not None and error.rule.startswith("vertex index 5 is out of range")
        assert str(error) == f"{file}:3: {error.rule}"


def test_a_mesh_that_is_missing_is_named() -> None:
    with pytest.raises(wayside.WaysideError, match="no-such-mesh.stl") as refused:
        wayside.rcs("no-such-mesh.stl", 77.0)
    assert refused.value.kind == "system"


def test_the_bounds_of_an_own_vehicle_are_its_lengths() -> None:
    low, high = wayside.mesh_bounds_m("car-suv")
    assert np.allclose(high - low, [5.0, 2.0, 1.8], atol=0.1)
