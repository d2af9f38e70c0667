"""NumPy's figures of the real capture, made anew, are those that are stored with it."""

from __future__ import annotations

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import PROJECT

STORED = PROJECT / "fixtures/captures"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("captures")
    script = PROJECT / "docs/validation/real_captures.py"
    subprocess.run([sys.executable, str(script), "--out", str(folder)], check=True, stdout=subprocess.DEVNULL)
    return folder


def rows(folder: Path) -> list[list[str]]:
    """Rows without the first line, which names the version of NumPy."""
    return list(csv.reader((folder / "room.numpy.csv").read_text(encoding="utf-8").splitlines()[1:]))


def test_the_map_of_the_capture_is_the_stored_one(made: Path) -> None:
    anew, stored = (np.load(folder / "room.numpy.npy") for folder in (made, STORED))
    assert (anew.shape, anew.dtype) == (stored.shape, stored.dtype) == ((128, 128), np.float32)
    # Both are rounded to float32, whose steps are largest for the weakest cell.
    assert np.abs(anew - stored).max() <= np.spacing(np.abs(stored).max())


def test_the_echoes_of_the_capture_are_the_stored_ones(made: Path) -> None:
    anew, stored = rows(made), rows(STORED)
    assert anew[0] == stored[0]
    assert [row[0] for row in anew[1:]] == [row[0] for row in stored[1:]]
    for row, other in zip(anew[1:], stored[1:], strict=True):
        for number, told in zip(row[1:], other[1:], strict=True):
            digits = len(told.partition(".")[2])
            # Rounded to the digits that are written: one of the last.
            assert number == told or abs(float(number) - float(told)) < 1.5 * 10.0**-digits
