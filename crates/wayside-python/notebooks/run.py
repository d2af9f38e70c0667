"""Runs every notebook beside this script from its first cell to its last.

What needs the recording of the sources, `WAYSIDE_CAPTURES`, is run a second time as if it were not there.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient


def run(place: Path) -> None:
    """Runs a notebook in a folder of its own; a cell that fails ends the script."""
    begin = time.monotonic()
    notebook = nbformat.read(place, as_version=4)
    with tempfile.TemporaryDirectory(prefix="wayside-") as folder:
        client = NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}})
        client.execute()
    print(f"{place.name}: {time.monotonic() - begin:.0f} s", flush=True)


def main() -> None:
    os.environ.setdefault("MPLBACKEND", "agg")
    folder = Path(__file__).resolve().parent
    captures = os.environ.get("WAYSIDE_CAPTURES", str(folder.parents[2] / "fixtures/captures"))
    asked = [Path(word) for word in sys.argv[1:]]
    for place in asked or sorted(folder.glob("*.ipynb")):
        needs_capture = "WAYSIDE_CAPTURES" in place.read_text(encoding="utf-8")
        for where in [captures, "not-there"] if needs_capture else [captures]:
            os.environ["WAYSIDE_CAPTURES"] = where
            run(place)


if __name__ == "__main__":
    main()
