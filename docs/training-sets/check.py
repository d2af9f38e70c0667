"""Whether the training sets that the program writes hold what its artifacts hold, number by number, in the
layouts that others read, and whether sets of others come back as artifacts (docs/training-sets.md):

    check.py PROGRAM FOLDER

PROGRAM is wayside built with `--features interchange`, FOLDER is empty. The first difference ends it with
exit code 1. The loaders run on PyTorch where it is installed, else on a stand-in of its `Dataset`.
"""

import ast
import csv
import json
import math
import os
import subprocess
import sys
import types
from pathlib import Path

import numpy
import pandas
from scipy.io import loadmat, savemat

try:
    import torch
    import torch.utils.data
    FRAMEWORK = f"PyTorch {torch.__version__}"
except ImportError:
    stand_in = types.ModuleType("torch.utils.data")
    stand_in.Dataset = object
    sys.modules.update({name: stand_in for name in ["torch", "torch.utils", "torch.utils.data"]})
    FRAMEWORK = "a stand-in of PyTorch's Dataset"

sys.path.insert(0, str(Path(__file__).parent))
import loaders  # noqa: E402

if FRAMEWORK.startswith("a stand-in"):  # no other package is to believe in it
    for name in ["torch", "torch.utils", "torch.utils.data"]:
        del sys.modules[name]

SCENE = """
name = "sets"
seed = 3
frames = 3
frame_interval_s = 0.1
[radar]
position_m = [1.0, 0.0, 6.0]
boresight_az_deg = 5.0
boresight_el_deg = -6.0
[radar.waveform]
chirps = 64
[radar.array]
multiplexing = "MULTIPLEXING"
[noise]
noise_figure_db = 12.0
[fidelity]
accuracy_db = -10.0
bounces = 1
between_bodies = "left-out"
measured_every = 1000
[[target]]
kind = "mesh"
id = "car-1"
class = "car"
model = "car-suv"
position_m = [5.75, 25.0, 0.0]
velocity_mps = [0.0, -6.0, 0.0]
[[target]]
kind = "mesh"
id = "truck-1"
class = "truck"
model = "truck-box"
position_m = [-2.0, 35.0, 0.0]
velocity_mps = [0.0, -3.0, 0.0]
yaw_deg = -80.0
"""

RECIPE = """
scene = "sets.toml"
seed = 5
scenes_per_class = 4
range_m = [20.0, 30.0]
speed_mps = [5.0, 9.0]
lanes = [2]
crops = false
[models]
car = ["car-suv"]
bus = ["bus-city"]
truck = ["truck-box"]
motorcycle = ["motorcycle-street"]
"""

SPEED_OF_LIGHT_MPS = 299_792_458.0


def main():
    print(f"loaders run on {FRAMEWORK}", flush=True)
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True)
    os.chdir(folder)
    Path("sets.toml").write_text(SCENE.replace("MULTIPLEXING", "tdm"))
    Path("recipe.toml").write_text(RECIPE)
    wayside(program, "run", "sets.toml", "--out", "run", "--no-cache")
    wayside(program, "export", "run/scene.scene", "--to", "json", "--out", "scene.json")
    for kind, to in [("cube", "npy"), ("rdm", "npy"), ("points", "csv")]:
        wayside(program, "export", f"run/frames.{kind}", "--to", to, "--out", f"{kind}.{to}")
    for kind, to in [("rdm", "raddet"), ("rdm", "carrada"), ("cube", "uwcr"), ("points", "kitti"),
                     ("points", "nuscenes")]:
        truth = ["--scene", "run/scene.scene"]
        wayside(program, "export", f"run/frames.{kind}", *truth, "--to", to, "--out", to)
    checks = [ten_lines, raddet, carrada, uwcr, kitti, nuscenes, own_kit_of_nuscenes, points_as_table,
              samples_as_table, batches, foreign_samples, foreign_tensors, foreign_clouds]
    for check in checks:
        print(f"{check.__name__}: {check(program)}", flush=True)
    print(f"test result: ok. {len(checks)} passed; 0 failed")


def wayside(program, *words):
    subprocess.run([program, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)


def same(ours, theirs, what, within=1e-6):
    """Arrays of one shape whose largest difference is small beside their largest number."""
    ours, theirs = (numpy.asarray(x) * 1 for x in (ours, theirs))
    if ours.shape != theirs.shape:
        sys.exit(f"{what}: the set has {theirs.shape}, the artifact {ours.shape}")
    if ours.size and numpy.abs(ours - theirs).max() > within * max(1.0, numpy.abs(ours).max()):
        sys.exit(f"{what}: the set has {theirs}, the artifact {ours}")


def ten_lines(program):
    """Lines of code of each loader: neither blank nor a sentence."""
    counts = {}
    text = Path(loaders.__file__).read_text()
    for part in ast.parse(text).body:
        if isinstance(part, ast.ClassDef):
            lines = text.splitlines()[part.body[0].end_lineno:part.end_lineno]
            counts[part.name] = sum(bool(line.strip()) for line in lines)
    if max(counts.values()) > 10 or len(counts) != 6:
        sys.exit(f"lines of the loaders: {counts}")
    return f"{counts} lines, on {FRAMEWORK}"


# Truth, made anew of the scene as its JSON tells it.


def bodies(frame):
    """Foot, size, yaw, velocity of each body at the middle of a frame, world."""
    scene = json.loads(Path("scene.json").read_text())
    radar, found = scene["header"]["radar"], []
    waveform = radar["waveform"]
    turns = len(radar["array"]["tx_m"])
    middle_s = 0.5 * waveform["chirps"] * turns * waveform["chirp_interval_s"]
    for target, pose in zip(scene["header"]["targets"], scene["frames"][frame]["poses"]):
        vertices = numpy.array(scene["header"]["meshes"][target["kind"]["Mesh"]["mesh"]]["vertices_m"])
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        sine, cosine = math.sin(pose["yaw_rad"]), math.cos(pose["yaw_rad"])
        middle = 0.5 * (low + high)
        foot = numpy.array(pose["position_m"]) + middle_s * numpy.array(pose["velocity_mps"])
        foot += [cosine * middle[0] - sine * middle[1], sine * middle[0] + cosine * middle[1], low[2]]
        found.append((target["kind"]["Mesh"]["class"], foot, high - low, pose["yaw_rad"],
                      numpy.array(pose["velocity_mps"])))
    return radar, found


def seen_by(radar, place):
    """Ahead, left, up of a place in the levelled axes of the radar."""
    turn = radar["boresight_az_rad"]
    x, y, z = numpy.asarray(place) - radar["position_m"]
    return numpy.array([x * math.sin(turn) + y * math.cos(turn), y * math.sin(turn) - x * math.cos(turn), z])


def corners(foot, size, yaw):
    sine, cosine = math.sin(yaw), math.cos(yaw)
    sides = [(a * size[0], b * size[1]) for a in (-0.5, 0.5) for b in (-0.5, 0.5)]
    turned = [(cosine * a - sine * b, sine * a + cosine * b) for a, b in sides]
    return [foot + [x, y, up] for x, y in turned for up in (0.0, size[2])]


def spectra():
    """Tensors of range, azimuth and Doppler by NumPy: a Fourier transform over the row of twelve, padded to
    256, with time division turned back; and the axes of the map."""
    maps, told = numpy.load("rdm.npy"), json.loads(Path("rdm.npy.json").read_text())
    waveform = bodies(0)[0]["waveform"]
    swept_hz = waveform["slope_hz_per_s"] * waveform["samples"] / waveform["sample_rate_hz"]
    wavelength_m = SPEED_OF_LIGHT_MPS / (waveform["start_frequency_hz"] + 0.5 * swept_hz)
    velocity, channels = numpy.array(told["velocity_mps"]), numpy.arange(maps.shape[1])
    late_s = channels // 4 * waveform["chirp_interval_s"]
    turned = numpy.exp(-2j * numpy.pi * numpy.outer(late_s, 2.0 * velocity / wavelength_m))
    aligned = maps * turned[None, :, :, None]
    of_row = numpy.fft.ifft(aligned, n=256, axis=1) * 256
    # Of the tensor: range, azimuth, Doppler; the middle of the sines is cell 128.
    return numpy.fft.fftshift(of_row, axes=1).transpose(0, 3, 1, 2), told


def cells(radar, told, body):
    """Least and greatest cell of range, sine and velocity of a body's corners, folded as the map does it."""
    kind, foot, size, yaw, velocity = body
    away = numpy.array(corners(foot, size, yaw)) - radar["position_m"]
    length = numpy.linalg.norm(away, axis=1)
    right = numpy.array([math.cos(radar["boresight_az_rad"]), -math.sin(radar["boresight_az_rad"]), 0.0])
    range_cell = told["range_m"][1] - told["range_m"][0]
    speed_cell = told["velocity_mps"][1] - told["velocity_mps"][0]
    rows = len(told["velocity_mps"])
    speeds = away @ velocity / length / speed_cell + rows // 2
    return length / range_cell, 128.0 * (1.0 + away @ right / length), speeds - speeds.mean() // rows * rows


def raddet(program):
    tensors, told = spectra()
    scale = json.loads(Path("raddet/set.json").read_text())["scale"]
    found = loaders.RadDet("raddet")
    over = []
    for frame in range(len(found)):
        power, boxes, classes = found[frame]
        ours = tensors[frame][::-1] * scale
        same(ours, numpy.load(found.files[frame]), "a tensor", 1e-5)
        radar, truth = bodies(frame)
        same(["car", "truck"] == list(classes), True, "classes")
        for box, body in zip(boxes, truth):
            ranges, sines, speeds = cells(radar, told, body)
            same(sines.min(), box[1] - 0.5 * box[4], "least azimuth", 1e-6)
            same(sines.max(), box[1] + 0.5 * box[4], "greatest azimuth", 1e-6)
            # Range: shifted by the coupling with Doppler, less than half a cell here.
            far = len(told["range_m"]) - 1 - ranges.max()
            same(abs(far - (box[0] - 0.5 * box[3])) < 0.5, True, "the farthest range")
            same(box[2] - 0.5 * box[5] - 0.5 <= speeds.min() and speeds.max() <= box[2] + 0.5 * box[5] + 0.5,
                 True, "velocities")
            part = tuple(slice(max(0, math.floor(m - 0.5 * s) - 1), math.ceil(m + 0.5 * s) + 2)
                         for m, s in zip(box[:3], box[3:]))
            over.append(10.0 * (power[part].max() - numpy.median(power)))
    if min(over) < 12.0:
        sys.exit(f"a body's box holds no echo: {over} dB over the median")
    shape = tensors[0].shape
    return f"{len(found)} tensors {shape}, {len(over)} boxes, echoes {min(over):.0f} dB and more over noise"


def carrada(program):
    tensors, told = spectra()
    maps, found, count = numpy.load("rdm.npy"), loaders.Carrada("carrada"), 0
    for frame in range(len(found)):
        doppler, angle, instances = found[frame]
        power = (numpy.abs(maps[frame].astype(complex)) ** 2).sum(axis=0)
        same(10.0 * numpy.log10(power).T, doppler, "a range-Doppler map", 1e-5)
        strongest = (numpy.abs(tensors[frame]) ** 2).max(axis=2)[::-1]
        same(10.0 * numpy.log10(strongest), angle, "a range-angle map", 1e-4)
        radar, truth = bodies(frame)
        for (on_doppler, on_angle, label), body in zip(instances, truth, strict=True):
            same({"car": 3, "truck": 5}[body[0]], label, "label")
            ranges, sines, _ = cells(radar, told, body)
            same(on_angle[0][1] <= sines.min() and sines.max() <= on_angle[1][1], True, "azimuths of a box")
            meets = on_doppler[0][0] <= ranges.max() + 1 and ranges.min() <= on_doppler[1][0] + 1
            same(meets, True, "ranges")
            same(doppler.shape[0] - 1 - on_doppler[1][0] - on_angle[0][0], 0, "far and near", 1.0)
            count += 1
    return f"{len(found)} maps of both kinds, {count} instances"


def uwcr(program):
    cube, found, count = numpy.load("cube.npy"), loaders.Uwcr("uwcr"), 0
    for frame in range(len(found)):
        samples, labels = found[frame]
        # Transmitter and receiver apart, then all axes backwards.
        channels, chirps, length = cube[frame].shape
        apart = cube[frame].reshape(channels // 4, 4, chirps, length)
        same(apart.transpose(3, 2, 1, 0), samples, "samples", 0.0)
        radar, truth = bodies(frame)
        for label, (kind, foot, size, yaw, _) in zip(labels, truth, strict=True):
            places = numpy.array([seen_by(radar, corner) for corner in corners(foot, size, yaw)])
            extent, ahead = numpy.ptp(places, axis=0), seen_by(radar, foot)
            ours = [{"car": 2, "truck": 7}[kind], -ahead[1], ahead[0], extent[1], extent[0]]
            same(ours, label[1:], "a label", 1e-4)
            count += 1
    return f"{len(found)} cubes {samples.shape} to the bit, {count} labels"


def detected():
    """Rows of points by frame."""
    frames = {}
    for row in csv.DictReader(open("points.csv")):
        frames.setdefault(int(row["frame"]), []).append(row)
    return frames


def kitti(program):
    found, rows, count = loaders.Kitti("kitti"), detected(), 0
    inside = {}
    for frame in range(len(found)):
        points, boxes, classes = found[frame]
        radar, truth = bodies(frame)
        own = rows.get(frame, [])
        ours = [seen_by(radar, [float(row[axis]) for axis in ("x_m", "y_m", "z_m")]) for row in own]
        same(numpy.array(ours).reshape(-1, 3), points[:, :3], "places", 1e-6)
        same([float(row["radial_velocity_mps"]) for row in own], points[:, 4], "velocities", 1e-6)
        same(points[:, 4], points[:, 5], "velocities of a radar that stands", 0.0)
        same(bool((numpy.abs(points[:, 3]) < 60).all()), True, "cross sections")
        text = Path(f"kitti/training/calib/{frame:05}.txt").read_text().splitlines()
        turn = numpy.array(text[5].split()[1:], float).reshape(3, 4)
        for box, (kind, foot, size, yaw, _) in zip(boxes, truth, strict=True):
            same([size[2], size[1], size[0]], box[:3], "size of a box", 1e-4)
            same(turn[:, :3] @ seen_by(radar, foot), box[3:6], "place of a box", 1e-4)
            # As View-of-Delft's own kit undoes the rotation, about the vertical of the sensor.
            turned = -(box[6] + math.pi / 2)
            turned -= yaw - (math.pi / 2 - radar["boresight_az_rad"])
            same([0.0, 1.0], [math.sin(turned), math.cos(turned)], "rotation", 1e-5)
            count += 1
        for row, point in zip(own, points):
            if row["true_target"]:
                kind, foot, size, yaw, _ = truth[{"car-1": 0, "truck-1": 1}[row["true_target"]]]
                places = [seen_by(radar, corner) for corner in corners(foot, size, yaw)]
                low, high = numpy.min(places, axis=0), numpy.max(places, axis=0)
                near = numpy.all((point[:2] > low[:2] - 1.5) & (point[:2] < high[:2] + 1.5))
                inside.setdefault(row["true_target"], []).append(bool(near))
    shares = {target: sum(near) / len(near) for target, near in inside.items()}
    if not shares or max(shares.values()) < 0.8:
        sys.exit(f"points of a body do not lie in its box: {shares}")
    told = ", ".join(f"{share:.0%} of {target}'s {len(inside[target])}" for target, share in shares.items())
    return f"{count} boxes, {sum(map(len, rows.values()))} points; within 1.5 m of their box: {told}"


def nuscenes(program):
    found, rows = loaders.NuScenes("nuscenes"), detected()
    files = Path("nuscenes/v1.0-wayside").glob("*.json")
    tables = {file.stem: json.loads(file.read_text()) for file in files}
    same(13, len(tables), "tables")
    tokens = {name: {row["token"] for row in table} for name, table in tables.items()}
    links = 0
    for name, table in tables.items():
        same(len(tokens[name]), len(table), f"tokens of {name}")
        for key, value in ((key, value) for row in table for key, value in row.items()):
            kind = key.removesuffix("_token").removesuffix("_tokens")
            kind = name if kind in ("prev", "next") else kind.removeprefix("first_").removeprefix("last_")
            kind = "sample_annotation" if kind == "annotation" else kind
            if key != "token" and (key.endswith(("_token", "_tokens")) or key in ("prev", "next")):
                for link in value if isinstance(value, list) else [value]:
                    same(link == "" or link in tokens[kind], True, f"{key} of {name}")
                    links += link != ""
    count = 0
    for frame in range(len(found)):
        cloud, boxes = found[frame]
        radar, truth = bodies(frame)
        own = rows.get(frame, [])
        same(max(1, len(own)), len(cloud), "points")
        for row, point in zip(own, cloud):
            x, y, z = seen_by(radar, [float(row[axis]) for axis in ("x_m", "y_m", "z_m")])
            same([x, y, z], list(point)[:3], "place", 1e-6)
            speed = float(row["radial_velocity_mps"]) / math.hypot(x, y)
            same([speed * x, speed * y], list(point)[6:8], "velocity", 1e-5)
            count += 1
        for box, (kind, foot, size, yaw, _) in zip(boxes, truth, strict=True):
            same(foot + [0, 0, 0.5 * size[2]], box[:3], "middle of a box")
            same([size[1], size[0], size[2]], box[3:6], "size of a box")
            same([math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)], box[6:], "rotation")
    return f"{count} points, {len(tables['sample_annotation'])} boxes, 13 tables with {links} links"


def own_kit_of_nuscenes(program):
    """The set's own development kit, where it is installed (nuscenes-devkit 1.2.0 wants an older NumPy)."""
    try:
        from nuscenes.nuscenes import NuScenes
        from nuscenes.utils.data_classes import RadarPointCloud
        from nuscenes.utils.geometry_utils import points_in_box
    except ImportError:
        return "nuscenes-devkit is not installed: left out"
    kit, inside = NuScenes("v1.0-wayside", "nuscenes", verbose=False), 0
    for frame, sample in enumerate(kit.sample):
        place, boxes, _ = kit.get_sample_data(sample["data"]["RADAR_FRONT"])
        cloud = RadarPointCloud.from_file(place).points
        same(len(detected().get(frame, [])), cloud.shape[1], "points that the kit keeps")
        for box, (_, foot, size, _, velocity) in zip(boxes, bodies(frame)[1], strict=True):
            same(seen_by(bodies(frame)[0], foot + [0, 0, 0.5 * size[2]]), box.center, "middle of a box")
            inside += points_in_box(box, cloud[:3]).sum()
        same(velocity, kit.box_velocity(sample["anns"][-1]), "velocity by the places of boxes", 1e-4)
    return f"{len(kit.sample)} samples, {len(kit.sample_annotation)} boxes, {inside} points in them"


# One table.


def points_as_table(program):
    wayside(program, "export", "run/frames.points", "--to", "parquet", "--out", "points.parquet")
    ours, theirs = pandas.read_csv("points.csv"), pandas.read_parquet("points.parquet")
    compared = [name for name in ours.columns if name in theirs.columns]
    for name in compared:
        if ours[name].dtype.kind in "if":
            numbers = [table[name].to_numpy(float, na_value=-1.0) for table in (ours, theirs)]
            same(*numbers, name, 1e-4)
        else:
            empty = [value if isinstance(value, str) else "" for value in theirs[name]]
            if theirs[name].dtype.kind != "b" and name != "stationary":
                same(True, [str(v) if isinstance(v, str) else "" for v in ours[name]] == empty, name)
    return f"{len(theirs)} rows of {len(theirs.columns)} columns, {len(compared)} beside the csv's"


def samples_as_table(program):
    wayside(program, "dataset", "recipe.toml", "--out", "samples")
    wayside(program, "export", "samples", "--to", "parquet", "--out", "samples.parquet")
    shards = sorted(Path("samples").glob("*.dataset"))
    for shard in shards:
        wayside(program, "export", str(shard), "--to", "csv", "--out", f"{shard.stem}.csv")
    ours = pandas.concat(pandas.read_csv(f"{shard.stem}.csv") for shard in shards)
    theirs = pandas.read_parquet("samples.parquet")
    same(list(ours["id"]) == list(theirs["id"]), True, "ids")
    for name, ours_too in zip(ours.columns[8:], theirs.columns[12:], strict=True):
        same(ours[name].to_numpy(), theirs[ours_too].to_numpy(), name, 1e-5)
    parts = {split: len(loaders.Table("samples.parquet", split)) for split in ["train", "validation", "test"]}
    same(len(theirs), sum(parts.values()), "parts of the split")
    features, kind = loaders.Table("samples.parquet")[0]
    return f"{len(theirs)} samples, {len(features)} features, {parts}, the first is a {kind}"


def batches(program):
    """Every loader behind PyTorch's own, which makes tensors of what it hands out."""
    if "torch" not in sys.modules:
        return "left out: PyTorch is not installed (docs/training-sets.md, \"The check\")"
    sets = [loaders.RadDet("raddet"), loaders.Carrada("carrada"), loaders.Uwcr("uwcr"),
            loaders.Kitti("kitti"), loaders.NuScenes("nuscenes"), loaders.Table("samples.parquet")]
    told = {}
    for each in sets:
        drawn = list(torch.utils.data.DataLoader(each, batch_size=None, shuffle=True))
        same(len(each), len(drawn), "what is drawn")
        same(isinstance(drawn[0][0], torch.Tensor), True, "a tensor")
        told[type(each).__name__] = list(drawn[0][0].shape)
    return str(told)


# Sets of others, read.


def foreign_samples(program):
    """A cube by way of its own set, and one by SciPy's writer: doubles, packed."""
    cube = numpy.load("cube.npy")
    Path("packed").mkdir()
    for file in sorted(Path("uwcr/radar_raw_frame").glob("*.mat")):
        samples = {"adcData": loadmat(file)["adcData"].astype(complex)}
        savemat(f"packed/{file.name}", samples, do_compression=True)
    for folder in ["uwcr/radar_raw_frame", "packed"]:
        name = folder.replace("/", "-")
        wayside(program, "import", folder, "--scene", "sets.toml", "--out", f"{name}.cube")
        wayside(program, "export", f"{name}.cube", "--to", "npy", "--out", f"{name}.npy")
        same(cube, numpy.load(f"{name}.npy"), f"samples of {folder}", 0.0)
    return f"{len(cube)} frames of ours and packed doubles of SciPy's come back to the bit"


def foreign_tensors(program):
    """Samples by way of tensors that NumPy makes of them, of a row of eight."""
    random = numpy.random.default_rng(5)
    frames, channels, chirps, samples = 2, 8, 32, 64
    cube = random.normal(size=(frames, channels, chirps, samples, 2)) @ [1.0, 1j]
    scene = f"""name = "row"
[radar.waveform]
samples = {samples}
chirps = {chirps}
[radar.array]
tx_half_wavelengths = [[0, 0]]
rx_half_wavelengths = {[[i, 0] for i in range(channels)]}
"""
    Path("row.toml").write_text(scene)
    Path("tensors").mkdir()
    turns = numpy.exp(1j * math.pi * numpy.outer(2.0 * numpy.arange(256) / 256 - 1.0, numpy.arange(channels)))
    for frame in range(frames):
        maps = numpy.fft.fftshift(numpy.fft.fft2(cube[frame]), axes=1)
        tensor = numpy.einsum("ac,cdr->rad", turns, maps)[::-1]
        numpy.save(f"tensors/{frame:06}.npy", tensor.astype(numpy.complex64))
    wayside(program, "import", "tensors", "--scene", "row.toml", "--out", "tensors.cube")
    wayside(program, "export", "tensors.cube", "--to", "npy", "--out", "tensors.npy")
    same(cube, numpy.load("tensors.npy"), "samples of tensors", 1e-5)
    return f"{frames} frames of {channels} channels come back"


def foreign_clouds(program):
    told = []
    for folder, labels in [("kitti/training/velodyne", "kitti/training/label_2"),
                           ("nuscenes/samples/RADAR_FRONT", "nuscenes/v1.0-wayside")]:
        name = folder.split("/")[0]
        wayside(program, "import", folder, "--scene", "sets.toml", "--out", f"{name}.points")
        wayside(program, "export", f"{name}.points", "--to", "csv", "--out", f"{name}.csv")
        ours, theirs = (pandas.read_csv(f"{of}.csv") for of in ("points", name))
        columns = ["frame", "range_m", "radial_velocity_mps", "az_deg", "snr_db"]
        # Rows of a frame are put in order of strength, which rounding may change.
        order = ["frame", "range_m", "az_deg"]
        ours, theirs = ours.sort_values(order), theirs.sort_values(order)
        same(ours[columns].to_numpy(), theirs[columns].to_numpy(), f"points of {name}", 1e-4)
        score, labelled = [scored(program, f"{name}.points", *truth)
                           for truth in (["--scene", "run/scene.scene"], ["--labels", labels])]
        same(score["objects"]["found"] > 0, True, f"objects found of {name}")
        for count in ["found", "missed", "false"]:
            same(score["objects"][count], labelled["objects"][count], f"{count} by the labels of {name}", 0.0)
        told.append(f"{name}: {len(theirs)} points, {score['objects']['found']} bodies found of 6")
    return "; ".join(told)


def scored(program, *words):
    output = subprocess.run([program, "score", *words], check=True, capture_output=True).stdout
    return json.loads(output)


if __name__ == "__main__":
    main()
