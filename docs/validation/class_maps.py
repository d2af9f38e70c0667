"""Crops of range-Doppler maps by class: docs/pictures/class-maps.png.

python3 docs/validation/class_maps.py OUT.png DATASET CROPS...

DATASET is a dataset folder with crops, each of CROPS a folder that `cargo xtask export DATASET/shard-N.dataset --to png` wrote.
Drawn are, of each class, the four vehicles of different models whose signal-to-noise ratio is nearest to 25 dB.
"""

import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

CLASSES = ["car", "bus", "truck", "motorcycle"]
SNR_DB = 25.0
# Of a crop (docs/datasets.md): metres of range, metres a second of velocity.
SPANS = (24.0, 8.0)


def chosen(lines, kind):
    """One of each model, the nearest to the level first."""
    of_class = [line for line in lines if line["class"] == kind]
    of_class.sort(key=lambda line: abs(line["estimate"]["snr_db"] - SNR_DB))
    first = {}
    for line in of_class:
        first.setdefault(line["model"], line)
    return list(first.values())[:4]


def main():
    out, dataset, *folders = sys.argv[1:]
    lines = [json.loads(line) for line in (Path(dataset) / "manifest.jsonl").open()]
    lines = [line for line in lines if line.get("estimate")]
    files = {file.stem: file for folder in folders for file in Path(folder).glob("*.png")}
    lines = [line for line in lines if line["id"] in files]
    figure, panels = pyplot.subplots(4, 4, figsize=(11, 10), sharex=True, sharey=True, constrained_layout=True)
    extent = [0.0, SPANS[0], -SPANS[1] / 2, SPANS[1] / 2]
    for row, kind in zip(panels, CLASSES):
        for panel, line in zip(row, chosen(lines, kind)):
            panel.imshow(pyplot.imread(files[line["id"]]), cmap="gray", extent=extent, aspect="auto")
            snr_db, range_m = line["estimate"]["snr_db"], line["range_m"]
            panel.set_title(f"{line['model']}, {range_m:.0f} m, {snr_db:.0f} dB", fontsize=9)
        row[0].set_ylabel(f"{kind}\nvelocity off its own, m/s")
    for panel in panels[-1]:
        panel.set_xlabel("range across the crop, m")
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    main()
