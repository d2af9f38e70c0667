"""Python on the pages of the site: each block is run, in a folder with what it names."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import PROJECT, call, small_scene

import wayside

DOCS = PROJECT / "docs"
BLOCK = re.compile(r"^```python[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def a_scene(folder: Path) -> dict[str, Any]:
    """The scene that the page names, so small that a run of it takes seconds."""
    (folder / "scenes").mkdir()
    (folder / "scenes/intersection.toml").write_text(wayside.Scene(small_scene()).toml)
    return {}


def a_detector(folder: Path) -> dict[str, Any]:
    """A detector that finds one thing, 12 m ahead and 2 m to the right, at rest."""
    (folder / "cloud").mkdir()
    found = np.array([[12.0, -2.0, -5.0]])
    return {
        "np": np,
        "cube": wayside.Scene(small_scene()).echo(),
        "my_detector": lambda samples: found,
        "velocities_mps": np.zeros(1),
    }


def a_table(folder: Path) -> dict[str, Any]:
    wayside.rcs("car-suv", 1.0, az_deg=[0.0, 1.0]).write(folder / "car.npy")
    return {}


def nothing(folder: Path) -> dict[str, Any]:
    return {}


# What a block needs, by its page and how it begins. Each block is in one of these two.
NEEDS: dict[tuple[str, str], Callable[[Path], dict[str, Any]]] = {
    ("python.md", "import wayside"): a_scene,
    ("python.md", "points = my_detector(cube.samples)"): a_detector,
    ("rcs-tables.md", "import json"): a_table,
    ("coming-from.md", "from wayside.compat.radarsimpy import Radar"): nothing,
}
LEFT_OUT = {
    ("training-sets.md", "from loaders import RadDet"): "PyTorch and an exported set (`ci --only sets`)",
}
# Work of minutes, and what is done instead.
INSTEAD = {"az_deg=range(360)": "az_deg=range(2)"}


def blocks() -> list[tuple[str, str]]:
    """Name of the page and text of every block."""
    pages = sorted(DOCS.rglob("*.md"))
    return [(str(page.relative_to(DOCS)), text) for page in pages for text in BLOCK.findall(page.read_text())]


def row_of(page: str, text: str, rows: dict[tuple[str, str], Any]) -> Any:
    return next((row for (name, first), row in rows.items() if name == page and text.startswith(first)), None)


def run(page: str, text: str, names: dict[str, Any]) -> dict[str, Any]:
    for long, short in INSTEAD.items():
        text = text.replace(long, short)
    exec(compile(text, page, "exec"), names)
    return names


@pytest.mark.parametrize(("page", "text"), blocks(), ids=[page for page, _ in blocks()])
def test_the_python_of_a_page_runs(
    page: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if why := row_of(page, text, LEFT_OUT):
        pytest.skip(f"needs {why}")
    prepare = row_of(page, text, NEEDS)
    assert prepare, f"{page}: no row says what this needs: {text}"
    monkeypatch.chdir(tmp_path)
    run(page, text, prepare(tmp_path))


def test_every_row_is_of_a_block() -> None:
    for page, first in [*NEEDS, *LEFT_OUT]:
        assert any(page == name and text.startswith(first) for name, text in blocks()), (page, first)
    assert all(any(long in text for _, text in blocks()) for long in INSTEAD)


def test_points_of_a_detector_of_ones_own_are_imported_as_the_page_says(
    program: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    page, text = next((page, text) for page, text in blocks() if row_of(page, text, NEEDS) is a_detector)
    run(page, text, a_detector(tmp_path))
    (tmp_path / "SCENE.toml").write_text(wayside.Scene(small_scene()).toml)
    call([*program, "import", "cloud", "--scene", "SCENE.toml", "--out", "mine.points"], tmp_path)
    found = wayside.Detections.read("mine.points")
    # The radar is at (0, 0, 6) and looks along y; left of it is −x.
    assert np.allclose(found.points.position_m, [[2.0, 12.0, 1.0]], atol=1e-5)
    assert len(found.objects) == 1
