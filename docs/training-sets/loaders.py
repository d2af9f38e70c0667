"""Loaders for PyTorch of the training sets that the program writes, ten lines of code each."""

import json
import pickle
from pathlib import Path

import numpy
import pandas
from numpy.lib.recfunctions import structured_to_unstructured
from scipy.io import loadmat
from torch.utils.data import Dataset


class RadDet(Dataset):
    """log10 of power [range, azimuth, Doppler], boxes [n, 6] in its cells, classes."""

    def __init__(self, folder):
        self.files = sorted(Path(folder).glob("RAD/*/*.npy"))

    def __len__(self):
        return len(self.files)

    def __getitem__(self, at):
        file = self.files[at]
        place = file.parents[2] / "gt" / file.parent.name / f"{file.stem}.pickle"
        truth = pickle.loads(place.read_bytes())
        return numpy.log10(numpy.abs(numpy.load(file)) ** 2 + 1), truth["boxes"], truth["classes"]


class Carrada(Dataset):
    """Decibels [range, Doppler] and [range, angle], a box [2, 2] and a label of each instance in both."""

    def __init__(self, folder):
        self.folder, told = Path(folder), (Path(folder) / "annotations_frame_oriented.json").read_text()
        self.frames = [(s, f, t) for s, frames in json.loads(told).items() for f, t in sorted(frames.items())]

    def __len__(self):
        return len(self.frames)

    def __getitem__(self, at):
        sequence, frame, truth = self.frames[at]
        views = ["range_doppler", "range_angle"]
        maps = [numpy.load(self.folder / sequence / f"{view}_numpy" / f"{frame}.npy") for view in views]
        return *maps, [(*(t[view]["box"] for view in views), t[views[0]]["label"]) for t in truth.values()]


class Uwcr(Dataset):
    """Complex samples [sample, chirp, receiver, transmitter], rows uid, class, px, py, wid, len."""

    def __init__(self, folder):
        self.files = sorted(Path(folder).glob("radar_raw_frame/*.mat"))

    def __len__(self):
        return len(self.files)

    def __getitem__(self, at):
        text = (self.files[at].parents[1] / "text_labels" / f"{self.files[at].stem}.csv").read_text()
        rows = [line.split(",") for line in text.splitlines()]
        return loadmat(self.files[at])["adcData"], numpy.array(rows, float).reshape(-1, 6)


class Kitti(Dataset):
    """Points [n, 7], boxes [m, 7] height, width, length, x, y, z, rotation in the camera's axes, classes."""

    def __init__(self, folder):
        self.files = sorted(Path(folder).glob("training/velodyne/*.bin"))

    def __len__(self):
        return len(self.files)

    def __getitem__(self, at):
        text = (self.files[at].parents[1] / "label_2" / f"{self.files[at].stem}.txt").read_text()
        rows = [line.split() for line in text.splitlines()]
        boxes = numpy.array([row[8:15] for row in rows], float).reshape(-1, 7)
        points = numpy.fromfile(self.files[at], numpy.float32).reshape(-1, 7)
        return points, boxes, [row[0] for row in rows]


FIELDS = numpy.dtype("<f4,<f4,<f4,i1,<i2,<f4,<f4,<f4,<f4,<f4,i1,i1,i1,i1,i1,i1,i1,i1")


class NuScenes(Dataset):
    """Points [n, 18], boxes [m, 10] middle, width, length, height, rotation w, x, y, z in the world."""

    def __init__(self, folder):
        tables = (Path(folder) / "v1.0-wayside" / f"sample_{name}.json" for name in ("data", "annotation"))
        self.folder, (self.frames, self.truth) = Path(folder), (json.loads(t.read_text()) for t in tables)

    def __len__(self):
        return len(self.frames)

    def __getitem__(self, at):
        token, file = self.frames[at]["sample_token"], self.folder / self.frames[at]["filename"]
        rows = numpy.frombuffer(file.read_bytes().split(b"DATA binary\n", 1)[1][:-1], FIELDS)
        own = [t["translation"] + t["size"] + t["rotation"] for t in self.truth if t["sample_token"] == token]
        return structured_to_unstructured(rows), numpy.array(own).reshape(-1, 10)


class Table(Dataset):
    """Features [n] and a class of each row of a dataset's table, of one part of its split."""

    def __init__(self, file, split="train"):
        table = pandas.read_parquet(file)
        self.rows = table[table["split"] == split]

    def __len__(self):
        return len(self.rows)

    def __getitem__(self, at):
        row = self.rows.iloc[at]
        return row[self.rows.columns.get_loc("seed") + 1:].to_numpy(numpy.float32), row["class"]
