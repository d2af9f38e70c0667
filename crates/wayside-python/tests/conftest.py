"""Scenes that the tests share, and the program that the package is compared with."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Any

import pytest

import wayside

PROJECT = Path(__file__).resolve().parents[3]


def small_scene(**changes: Any) -> dict[str, Any]:
    """Two reflectors before a radar of four channels: a scene of a fraction of a second."""
    scene: dict[str, Any] = {
        "name": "reflectors",
        "frames": 2,
        "radar": {
            "waveform": {"samples": 64, "chirps": 32},
            "array": {"preset": "1x4"},
        },
        "noise": {"noise_figure_db": 12.0},
        "target": [
            {"kind": "point", "id": "near", "rcs_m2": 10.0, "position_m": [2.0, 12.0, 1.0]},
            {
                "kind": "point",
                "id": "far",
                "rcs_m2": 100.0,
                "position_m": [0.0, 40.0, 1.0],
                "velocity_mps": [0.0, -8.0, 0.0],
            },
        ],
    }
    return scene | changes


@pytest.fixture(scope="session")
def scene() -> wayside.Scene:
    return wayside.Scene(small_scene())


@pytest.fixture(scope="session")
def program() -> list[str]:
    """Words that call the program: `WAYSIDE_PROGRAM`, else what is built of the sources."""
    named = os.environ.get("WAYSIDE_PROGRAM")
    built = [PROJECT / "target/release" / name for name in ("wayside", "xtask")]
    places = [Path(named)] if named else [place for place in built if place.exists()]
    if not places:
        pytest.skip("no program is built: cargo build --release, or WAYSIDE_PROGRAM names it")
    return [str(places[0])]


def call(words: list[str], folder: Path) -> None:
    subprocess.run(words, cwd=folder, check=True, stdout=subprocess.DEVNULL, timeout=300)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """A line as cargo's tests end with: the checks of the project count it."""
    of = {word: len(terminalreporter.stats.get(word, [])) for word in ("passed", "failed", "error")}
    verdict = "FAILED" if of["failed"] + of["error"] else "ok"
    terminalreporter.write_line(
        f"test result: {verdict}. {of['passed']} passed; {of['failed'] + of['error']} failed"
    )
