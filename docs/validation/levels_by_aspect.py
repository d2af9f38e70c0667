"""Levels of a dataset's vehicles by the aspect that they show: the table of docs/families.md.

python3 docs/validation/levels_by_aspect.py DIR...

Each DIR is a dataset folder in which `cargo xtask export DIR/shard-N.dataset --to csv --out DIR/shard-N.csv` has put the
features beside the lines of its scenes (shard-N.jsonl). Told are quartiles of the total cross section over the sightings.
"""

import csv
import json
import math
import statistics
import sys
from pathlib import Path

CLASSES = ["car", "bus", "truck", "motorcycle"]
ASPECTS = [("front, to 20°", 20), ("20 to 70°", 70), ("side, 70 to 110°", 110), ("110 to 160°", 160), ("rear", 181)]


def aspect_deg(vehicle):
    """0 shows the front, 180 the rear; the radar stands at (0, 0)."""
    heading = math.radians(vehicle["yaw_deg"]) - math.pi / 2
    x, y = vehicle["x_m"], vehicle["y_m"]
    cosine = -(x * math.cos(heading) + y * math.sin(heading)) / math.hypot(x, y)
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


def levels(folder):
    """Class, aspect and level of each sighting."""
    for table in sorted(Path(folder).glob("shard-*.csv")):
        lines = [json.loads(line) for line in table.with_suffix(".jsonl").open()]
        frames = [frame for scene in lines for frame in scene["frames"]]
        vehicles = {vehicle["id"]: vehicle for frame in frames for vehicle in frame["vehicles"]}
        for row in csv.DictReader(table.open()):
            yield row["class"], aspect_deg(vehicles[row["id"]]), float(row["total_dbsm"])


def main():
    found = [level for folder in sys.argv[1:] for level in levels(folder)]
    print("| aspect | " + " | ".join(CLASSES) + " |\n|---|" + "---|" * len(CLASSES))
    least = 0
    for name, most in ASPECTS:
        cells = []
        for kind in CLASSES:
            own = [db for label, aspect, db in found if label == kind and least <= aspect < most]
            low, middle, high = statistics.quantiles(own, n=4) if len(own) > 3 else [math.nan] * 3
            cells.append(f"{middle:.0f} ({low:.0f} … {high:.0f}), {len(own)}")
        print(f"| {name} | " + " | ".join(cells) + " |")
        least = most


if __name__ == "__main__":
    main()
