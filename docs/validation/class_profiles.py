"""Range profiles of the classes, own vehicles beside real ones: docs/pictures/class-profiles.png.

python3 docs/validation/class_profiles.py OUT.png --own TABLE.csv... --real TABLE.csv...

Each TABLE is what `cargo xtask export DIR/shard-N.dataset --to csv` writes: features of signatures. Drawn are
medians and quartiles, over the sightings of a class, of the cross section in zones behind the leading edge
(crates/classifier/src/signatures/features.rs).
"""

import argparse
import csv
import statistics

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

CLASSES = ["car", "bus", "truck", "motorcycle"]
# Zones behind the leading edge, m, as ZONES_M of features.rs.
ZONES_M = [-1.0, 0.75, 1.5, 2.5, 4.0, 6.0, 9.0, 13.0, 21.0]
# What stands for nothing, dBsm.
FLOOR_DBSM = -30.0
SOURCES = [("own", "#0072b2"), ("real", "#d55e00")]


def rows(tables):
    for table in tables:
        with open(table) as file:
            yield from csv.DictReader(file)


def quartiles(values):
    return statistics.quantiles(values, n=4) if len(values) > 3 else [FLOOR_DBSM] * 3


def draw(axes, sightings, colour, label):
    """Steps of the median, the quartiles as a band."""
    of_zone = [quartiles([float(row[f"zone_{zone}_dbsm"]) for row in sightings]) for zone in range(len(ZONES_M) - 1)]
    low, middle, high = ([max(FLOOR_DBSM, of[n]) for of in of_zone] for n in range(3))
    step = lambda levels: levels + levels[-1:]
    axes.fill_between(ZONES_M, step(low), step(high), step="post", alpha=0.2, color=colour, linewidth=0)
    axes.step(ZONES_M, step(middle), where="post", color=colour, label=f"{label}, {len(sightings)} sightings")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("out")
    parser.add_argument("--own", nargs="+", required=True)
    parser.add_argument("--real", nargs="+", required=True)
    asked = parser.parse_args()
    found = {"own": list(rows(asked.own)), "real": list(rows(asked.real))}
    figure, panels = pyplot.subplots(1, 4, figsize=(13, 3.6), sharey=True, constrained_layout=True)
    for panel, kind in zip(panels, CLASSES):
        for source, colour in SOURCES:
            draw(panel, [row for row in found[source] if row["class"] == kind], colour, source)
        panel.set_title(kind)
        panel.set_xlabel("behind the leading edge, m")
        panel.set_ylim(FLOOR_DBSM, 30)
        panel.grid(alpha=0.3)
        panel.legend(fontsize=8, loc="upper right")
    panels[0].set_ylabel("cross section of the zone, dBsm")
    figure.savefig(asked.out, dpi=110)


if __name__ == "__main__":
    main()
