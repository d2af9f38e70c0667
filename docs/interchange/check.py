"""Whether messages that the official packages of OSI, MCAP and ROS 2 write and read are those of the program,
field by field, and whether what SUMO, netconvert and OSI make runs through it (docs/interchange.md):

    check.py PROGRAM FOLDER

PROGRAM is wayside built with `--features interchange`, FOLDER is empty. The first difference ends it with
exit code 1.
"""

import json
import math
import os
import struct
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path
from xml.etree import ElementTree

import sumo
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from mcap_ros2.reader import read_ros2_messages
from osi3.osi_groundtruth_pb2 import GroundTruth
from osi3.osi_sensordata_pb2 import SensorData
from osi3.osi_sensorview_pb2 import SensorView
from osi_utilities.tracefile.readers.multi import MultiTraceReader
from osi_utilities.tracefile.writers.multi import MultiTraceWriter

import expected
from compared import alike, same
from sensor import Sensor

FRAMES = 8

HEAD = """
name = "interchange"
seed = 1
[radar]
boresight_az_deg = 10.0
boresight_el_deg = -8.0
[noise]
noise_figure_db = 12.0
[fidelity]
accuracy_db = -10.0
bounces = 1
between_bodies = "left-out"
measured_every = 1000
[traffic]
view_range_m = 60.0
view_nearest_m = 12.0
"""

# Elements in rows too, falling off the boresight, of the other polarization.
OTHER_ARRAY = """[radar.array]
preset = "6x8"
pattern = "cosine"
cosine_exponent = 1.5
polarization = "hh"
"""
# A stone in the tyre of a wheel that brakes.
STONE = """[[target]]
kind = "point"
id = "stone"
rcs_m2 = 0.001
position_m = [3.0, 25.0, 0.33]
velocity_mps = [1.0, -8.0, 0.0]
acceleration_mps2 = [0.0, 3.0, 0.0]
wheel_radius_m = 0.33
"""


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True)
    os.chdir(folder)
    checks = [ground_truth, detections, objects, reflections, clouds, foxglove, sumo_alone, open_drive,
              open_street_map]
    for check in checks:
        told = check(program)
        print(f"{check.__name__}: {told}", flush=True)
    print(f"test result: ok. {len(checks)} passed; 0 failed")


def wayside(program, *words):
    subprocess.run([program, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)


# Ground truth of osi-python, read as traffic.


def truth(number):
    """A car that approaches, a bus behind it and someone who walks."""
    message = GroundTruth()
    message.version.version_major, message.version.version_minor = 3, 8
    nanos = number * 100_000_000
    message.timestamp.seconds, message.timestamp.nanos = divmod(nanos, 1_000_000_000)
    message.host_vehicle_id.value = 4
    for identity, kind, of_vehicle, size, place, speed in [
        (4, "TYPE_VEHICLE", "TYPE_MEDIUM_CAR", (4.6, 1.8, 1.5), (5.75, 30.0, 0.75), 9.0),
        (7, "TYPE_VEHICLE", "TYPE_BUS", (12.0, 2.55, 3.1), (2.0, 42.0, 1.55), 6.0),
        (9, "TYPE_PEDESTRIAN", None, (0.5, 0.5, 1.8), (-4.0, 20.0, 0.9), 1.0),
    ]:
        thing = message.moving_object.add()
        thing.id.value = identity
        thing.type = thing.Type.Value(kind)
        if of_vehicle:
            thing.vehicle_classification.type = thing.VehicleClassification.Type.Value(of_vehicle)
        base = thing.base
        base.dimension.length, base.dimension.width, base.dimension.height = size
        base.position.x, base.position.y, base.position.z = place
        base.position.y -= speed * 0.1 * number
        base.velocity.y = -speed
        base.orientation.yaw = -math.pi / 2
    lane = message.lane.add()
    lane.id.value = 1
    return message


def ground_truth(program):
    messages = [truth(number) for number in range(FRAMES)]
    with open("truth.osi", "wb") as file:
        for message in messages:
            content = message.SerializeToString()
            file.write(struct.pack("<I", len(content)) + content)
    for packing in ["zstd", "lz4", "none"]:
        writer = MultiTraceWriter()
        metadata = {"version": "3.8.0", "min_osi_version": "3.8.0", "max_osi_version": "3.8.0",
                    "min_protobuf_version": "3.0.0", "max_protobuf_version": "3.0.0"}
        writer.open(Path(f"truth-{packing}.mcap"), metadata, compression=packing)
        of_channel = "net.asam.osi.trace.channel."
        versions = {of_channel + "osi_version": "3.8.0", of_channel + "protobuf_version": "3.0.0"}
        writer.add_channel("GroundTruth", GroundTruth, versions)
        for message in messages:
            writer.write_message(message, "GroundTruth")
        writer.close()
    scenes = {}
    for name in ["truth.osi", *(f"truth-{packing}.mcap" for packing in ["zstd", "lz4", "none"])]:
        Path(f"{name}.toml").write_text(HEAD + f'osi = "{name}"\n')
        wayside(program, "run", f"{name}.toml", "--out", name + "-run", "--no-cache")
        wayside(program, "export", f"{name}-run/scene.scene", "--to", "json", "--out", f"{name}.json")
        scenes[name] = json.loads(Path(f"{name}.json").read_text())
    traffic = scenes["truth.osi"]["header"]["traffic"]
    same([vehicle["id"] for vehicle in traffic["vehicles"]], ["4", "7"], "vehicles")
    same(len(traffic["frames"]), FRAMES, "frames")
    for number, frame in enumerate(traffic["frames"]):
        for placed, thing in zip(frame, messages[number].moving_object):
            pose, base = placed["pose"], thing.base
            middle = [base.position.x, base.position.y, base.position.z - 0.5 * base.dimension.height]
            for ours, theirs in zip(pose["position_m"], middle):
                same(ours, theirs, "position")
            same(pose["velocity_mps"][1], base.velocity.y, "velocity", 1e-6)
            same(pose["yaw_rad"], base.orientation.yaw, "yaw")
    for name, scene in scenes.items():
        same(scene["header"]["traffic"], traffic, f"traffic of {name}")
    kinds = [vehicle["kind"]["Mesh"]["model"] for vehicle in traffic["vehicles"]]
    by_earlier_names(program)
    by_views(program, messages, traffic)
    return f"{FRAMES} messages, .osi and MCAP by zstd, lz4 and plain, are one traffic: {', '.join(kinds)}"


def by_views(program, messages, traffic):
    """The same traffic out of views of a sensor, and messages of other kinds refused by their names."""
    views = [SensorView(global_ground_truth=message) for message in messages]
    for view, message in zip(views, messages):
        view.timestamp.CopyFrom(message.timestamp)
        view.sensor_id.value, view.host_vehicle_id.value = 3, 4
        view.radar_sensor_view.add().view_configuration.emitter_frequency = 77e9
    others = []
    for message in messages:
        others.append(SensorData(timestamp=message.timestamp))
        others[-1].sensor_view.add().global_ground_truth.CopyFrom(message)
    for name, written in [("view", views), ("data", others)]:
        contents = [message.SerializeToString() for message in written]
        Path(f"{name}.osi").write_bytes(b"".join(struct.pack("<I", len(c)) + c for c in contents))
        Path(f"{name}.toml").write_text(HEAD + f'osi = "{name}.osi"\n')
    wayside(program, "run", "view.toml", "--out", "view-run", "--no-cache")
    same(as_json(program, "view-run/scene.scene")["header"]["traffic"], traffic, "traffic of views")
    words = [program, "run", "data.toml", "--out", "data-run", "--no-cache"]
    ended = subprocess.run(words, capture_output=True, text=True)
    told = (ended.returncode, "it is a SensorData" in ended.stderr)
    same((1, True), told, "a message without ground truth")


def by_earlier_names(program):
    """Models by a name that osi-python has for the same value, and by one that it has not."""
    names = GroundTruth().moving_object.add().VehicleClassification.Type
    same(names.Value("TYPE_CAR"), names.Value("TYPE_MEDIUM_CAR"), "values of both names")
    Path("named.toml").write_text(HEAD.replace("seed = 1", "seed = 1\nframes = 1") + 'osi = "truth.osi"\n'
                                  'models = { TYPE_CAR = "car-hatchback" }\n')
    wayside(program, "run", "named.toml", "--out", "named-run", "--no-cache")
    vehicles = as_json(program, "named-run/scene.scene")["header"]["traffic"]["vehicles"]
    of_car = [vehicle["kind"]["Mesh"]["model"] for vehicle in vehicles if vehicle["id"] == "4"]
    same(["car-hatchback"], of_car, "model by TYPE_CAR")
    Path("named.toml").write_text(HEAD + 'osi = "truth.osi"\nmodels = { TYPE_LORRY = "truck-box" }\n')
    words = [program, "run", "named.toml", "--out", "named-run", "--no-cache"]
    ended = subprocess.run(words, capture_output=True, text=True)
    same((1, True), (ended.returncode, "TYPE_LORRY" in ended.stderr), "a type that OSI has not")


# What was detected, read by osi-python.


def messages_of(name, kind):
    """Messages of a `.osi` file."""
    content, found = Path(name).read_bytes(), []
    while content:
        length = struct.unpack_from("<I", content)[0]
        found.append(kind.FromString(content[4:4 + length]))
        content = content[4 + length:]
    return found


def messages_in_mcap(name, decoder):
    reader = MultiTraceReader(decoder_mode=decoder)
    if not reader.open(Path(name)):
        sys.exit(f"{name} is not read")
    found = []
    while reader.has_next():
        found.append(reader.read_message().message)
    reader.close()
    return found


def both_containers(program, artifact, kind):
    """Messages of an artifact, the same in both containers, also by what MCAP tells of them itself."""
    for ending in ["osi", "mcap"]:
        wayside(program, "export", artifact, "--to", "osi", "--out", f"{artifact}.{ending}")
    found = messages_of(f"{artifact}.osi", kind)
    for message in found:
        same(b"", b"".join(unknown(message)), "fields that the official messages do not have")
    in_mcap = messages_in_mcap(f"{artifact}.mcap", "precompiled")
    same([m.SerializeToString(deterministic=True) for m in found],
         [m.SerializeToString(deterministic=True) for m in in_mcap], "messages of MCAP")
    told = messages_in_mcap(f"{artifact}.mcap", "mcap-contained")
    same(len(found), len(told), "messages by their own description")
    for ours, theirs in zip(found, told):
        same(ours.SerializeToString(deterministic=True), theirs.SerializeToString(deterministic=True),
             "messages by their own description")
    return found


def unknown(message):
    """Bytes of a message that come back changed: fields of another number or type than the official ones."""
    clean = type(message)()
    clean.CopyFrom(message)
    clean.DiscardUnknownFields()
    whole, known = message.SerializeToString(), clean.SerializeToString()
    return [] if whole == known else [whole]


def as_json(program, artifact):
    wayside(program, "export", artifact, "--to", "json", "--out", f"{artifact}.json")
    return json.loads(Path(f"{artifact}.json").read_text())


# What was detected, field by field, beside what the artifacts give by the formulas of the pages.

RUNS = ["truth.osi-run", "rows-run"]


def rows_run(program):
    """The same traffic by a radar with rows of elements."""
    scene = HEAD.replace("seed = 1", "seed = 1\nframes = 2").replace("[noise]", OTHER_ARRAY + "[noise]")
    scene = scene.replace("[traffic]", 'wheels = "turning"\n[traffic]')
    Path("rows.toml").write_text(scene + 'osi = "truth.osi"\n' + STONE)
    wayside(program, "run", "rows.toml", "--out", "rows-run", "--no-cache")


def number_of(messages):
    """Number of the sensor, of 48 bits and the same in all messages."""
    numbers = {message.sensor_id.value for message in messages}
    same((1, True), (len(numbers), 0 < min(numbers) < 2**48), "number of the sensor")
    return numbers.pop()


def detections(program):
    rows_run(program)
    told = []
    for run in RUNS:
        whole = as_json(program, f"{run}/frames.points")
        found = both_containers(program, f"{run}/frames.points", SensorData)
        number = number_of(found)
        count = sum(alike(expected.detections(number, whole["header"]["cube"], frame), message, "detections")
                    for frame, message in zip(whole["frames"], found, strict=True))
        every = [seen for message in found for seen in message.feature_data.radar_sensor[0].detection]
        has_rows = {seen.position_rmse.HasField("elevation") for seen in every}
        same({run == "rows-run"}, has_rows, "elevations measured")
        told.append(f"{len(every)} detections of {len(found)} frames, {count} values")
    return "; ".join(told)


def objects(program):
    whole = as_json(program, "truth.osi-run/frames.tracks")
    summary = json.loads(Path("truth.osi-run/summary.json").read_text())
    found = both_containers(program, "truth.osi-run/frames.tracks", SensorData)
    number, born_s, values = number_of(found), {}, 0
    points = messages_of("truth.osi-run/frames.points.osi", SensorData)
    same(number_of(points), number, "number of the sensor in both traces")
    for frame, told, message in zip(whole["frames"], summary["frames"], found, strict=True):
        for track in frame["tracks"]:
            born_s.setdefault(track["id"], frame["time_s"])
        classes = {track["id"]: track["probabilities"] for track in told["tracks"]}
        should = expected.objects(number, whole["header"]["cube"], frame, classes, born_s)
        values += alike(should, message, "objects")
    every = [seen for message in found for seen in message.moving_object]
    candidates = sum(len(seen.candidate) for seen in every)
    if candidates == 0:
        sys.exit("no track is believed, or none has a class: nothing was compared")
    return f"{len(every)} objects with {candidates} candidates, {values} values"


def reflections(program):
    told = []
    for run in RUNS:
        whole = as_json(program, f"{run}/frames.paths")
        found = both_containers(program, f"{run}/frames.paths", SensorView)
        number = number_of(found)
        count = sum(alike(expected.reflections(number, whole["header"], frame), message, "reflections")
                    for frame, message in zip(whole["frames"], found, strict=True))
        paths = [path for frame in whole["frames"] for path in frame["paths"]]
        on_wheels = [path for path in paths if path["curve"]["rim"] is not None]
        same(2 if run == "rows-run" else 0, len(on_wheels), "reflections on a wheel")
        parts = sum(path["curve"]["array_span"] is not None for path in paths)
        told.append(f"{len(paths)} reflections of {len(found)} frames, {parts} of parts of the array, "
                    f"{count} values")
    return "; ".join(told)


# Points and tracks, read by mcap-ros2-support.


FIELDS = {"x": 7, "y": 7, "z": 7, "velocity": 7, "snr": 7, "object": 5, "height_measured": 6}
UNKNOWN = -1.0


def clouds(program):
    for kind in ["points", "tracks"]:
        wayside(program, "export", f"truth.osi-run/frames.{kind}", "--to", "mcap", "--out", f"{kind}.mcap")
    points, tracks = (as_json(program, f"truth.osi-run/frames.{kind}") for kind in ["points", "tracks"])
    seen = {topic: [] for topic in ["/radar/points", "/radar/scan", "/radar/tracks"]}
    for message in [*read_ros2_messages("points.mcap"), *read_ros2_messages("tracks.mcap")]:
        seen[message.channel.topic].append(message.ros_msg)
    sensor, count = Sensor(points["header"]["cube"]["radar"]), 0
    for frame, cloud, scan in zip(points["frames"], seen["/radar/points"], seen["/radar/scan"], strict=True):
        of_cloud(frame, cloud)
        count += of_scan(sensor, frame, scan)
    for frame, told in zip(tracks["frames"], seen["/radar/tracks"], strict=True):
        of_tracks(frame, told)
    return f"{count} points as clouds and scans, {len(tracks['frames'])} frames of tracks field by field"


def stamped(frame, header, name):
    same(frame["time_s"], header.stamp.sec + header.stamp.nanosec * 1e-9, "time")
    same(name, header.frame_id, "frame of coordinates")


def of_cloud(frame, cloud):
    stamped(frame, cloud.header, "map")
    fields = [(field.name, field.offset, field.datatype, field.count) for field in cloud.fields]
    same([(name, 4 * at, kind, 1) for at, (name, kind) in enumerate(FIELDS.items())], fields, "fields")
    count, size = len(frame["points"]), 4 * len(FIELDS)
    shape = [cloud.height, cloud.width, cloud.point_step, cloud.row_step, cloud.is_bigendian, cloud.is_dense]
    same([1, count, size, size * count, False, True], shape, "shape of the cloud")
    of_rows(frame, bytes(cloud.data))


def of_rows(frame, data):
    """Rows of seven little-endian numbers."""
    same(28 * len(frame["points"]), len(data), "bytes of the cloud")
    for point, (*numbers, thing, measured) in zip(frame["points"], struct.iter_unpack("<5fiI", data)):
        floats = [*point["position_m"], point["radial_velocity_mps"], point["snr_db"]]
        for ours, theirs in zip(floats, numbers, strict=True):
            same(ours, theirs, "a number of the cloud", 1e-6)
        same(-1 if point["object"] is None else point["object"], thing, "object")
        same(int(point["height"] == "Measured"), measured, "height_measured")


def of_scan(sensor, frame, scan):
    stamped(frame, scan.header, "radar")
    for point, echo in zip(frame["points"], scan.returns, strict=True):
        azimuth, elevation = sensor.angles_of_world(point["azimuth_rad"], point["elevation_rad"])
        for ours, theirs in [(point["range_m"], echo.range), (azimuth, echo.azimuth),
                             (elevation, echo.elevation), (point["snr_db"], echo.amplitude),
                             (point["radial_velocity_mps"], echo.doppler_velocity)]:
            same(ours, theirs, "a number of the scan", 1e-6)
    return len(frame["points"])


def of_tracks(frame, told):
    stamped(frame, told.header, "map")
    for track, seen in zip(expected.believed(frame), told.tracks, strict=True):
        box, covariance = track["footprint"], track["covariance"]
        same(track["id"], int.from_bytes(bytes(seen.uuid.uuid), "big"), "uuid")
        same(0, seen.classification, "classification")
        place, middle = box["centre_m"], expected.middle_covariance(track)
        velocity = [row[2:] for row in covariance[2:]]
        for name, ours, theirs in [("position", [*place, 0.0], seen.position),
                                   ("velocity", [*track["velocity_mps"], 0.0], seen.velocity),
                                   ("acceleration", [0.0] * 3, seen.acceleration),
                                   ("size", [box["length_m"], box["width_m"], 0.0], seen.size)]:
            for axis, number in zip("xyz", ours, strict=True):
                same(number, getattr(theirs, axis), f"{name} {axis}")
        for name, ours in [("position", triangle(middle)), ("velocity", triangle(velocity)),
                           ("acceleration", [UNKNOWN] * 6), ("size", [UNKNOWN] * 6)]:
            cells = getattr(seen, f"{name}_covariance")
            for at, (number, theirs) in enumerate(zip(ours, cells, strict=True)):
                same(number, theirs, f"{name} covariance {at}", 1e-6)


def triangle(covariance):
    """xx, xy, xz, yy, yz, zz of a covariance along x and y."""
    (xx, xy), (_, yy) = covariance
    return [xx, xy, UNKNOWN, yy, UNKNOWN, UNKNOWN]


# Points, read by the definitions in the file and by Foxglove's own package.


def foxglove(program):
    wayside(program, "export", "truth.osi-run/frames.points", "--to", "foxglove", "--out", "foxglove.mcap")
    frames = as_json(program, "truth.osi-run/frames.points")["frames"]
    with open("foxglove.mcap", "rb") as file:
        found = list(make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages())
    numbers = {"Float32": 7, "Int32": 6, "Uint32": 5}
    kinds = [numbers[kind] for kind in ["Float32"] * 5 + ["Int32", "Uint32"]]
    fields = [{"name": name} | ({"offset": 4 * at} if at else {}) | {"type": kind}
              for at, (name, kind) in enumerate(zip(FIELDS, kinds, strict=True))]
    for frame, (schema, channel, message, cloud) in zip(frames, found, strict=True):
        same(["foxglove.PointCloud", "protobuf", "protobuf", "/radar/points"],
             [schema.name, schema.encoding, channel.message_encoding, channel.topic], "channel")
        own = PointCloud.FromString(message.data)
        same(b"", b"".join(unknown(own)), "fields that Foxglove's messages do not have")
        stamp = {name: number for name, number in expected.stamp(frame["time_s"]).items() if number}
        should = {"timestamp": stamp, "frame_id": "map", "pose": {"position": {}, "orientation": {"w": 1.0}},
                  "point_stride": 28, "fields": fields}
        if frame["points"]:
            should["data"] = cloud.data
        for seen in [own, cloud]:
            alike(should, seen, "cloud")
            of_rows(frame, seen.data)
    return f"{len(found)} clouds by the file's own definitions and by Foxglove's"


# SUMO, headless, and networks from elsewhere.

BIN = Path(sumo.SUMO_HOME) / "bin"
AT_ORIGIN = ["--offset.disable-normalization", "true"]


def tool(name, *words):
    environment = {**os.environ, "SUMO_HOME": str(sumo.SUMO_HOME)}
    subprocess.run([BIN / name, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env=environment)


def driven(program, network, edges, name):
    """Vehicles along a way of a network, two frames of them through the program."""
    begun = time.monotonic()
    Path(f"{name}.rou.xml").write_text(f"""<routes>
  <vType id="car" length="4.6"/><vType id="bus" vClass="bus" length="12"/>
  <route id="way" edges="{edges}"/>
  <flow id="cars" type="car" route="way" begin="0" end="60" period="4"/>
  <flow id="buses" type="bus" route="way" begin="2" end="60" period="15"/>
</routes>""")
    tool("sumo", "-n", network, "-r", f"{name}.rou.xml", "--fcd-output", f"{name}.fcd.xml", "--end", "30",
         "--step-length", "0.1", "--seed", "1", "--no-step-log", "true", "--statistic-output", f"{name}.xml")
    inserted = int(ElementTree.parse(f"{name}.xml").find("vehicles").get("inserted"))
    scene = HEAD.replace('name = "interchange"', 'name = "sumo"\nframes = 2')
    Path(f"{name}.toml").write_text(
        scene + f'fcd = "{name}.fcd.xml"\nnet = "{network}"\nbegin_s = 20.0\n')
    wayside(program, "run", f"{name}.toml", "--out", f"{name}-run", "--no-cache")
    summary = json.loads(Path(f"{name}-run/summary.json").read_text())
    count = sum(len(frame["targets"]) for frame in summary["frames"])
    points = sum(frame["points"] for frame in summary["frames"])
    if count == 0 or points == 0:
        sys.exit(f"{name}: nothing is in view, or nothing was detected")
    seconds, frames = time.monotonic() - begun, len(summary["frames"])
    return (f"SUMO {version('eclipse-sumo')} drove {inserted} vehicles in 30 s; {count} in view of {frames} "
            f"frames, {points} points, {len(summary['lanes'])} lanes; {seconds:.1f} s")


def plain_network():
    """A road towards the radar, drawn by its ends."""
    Path("road.nod.xml").write_text(
        '<nodes><node id="far" x="2" y="120"/><node id="near" x="2" y="-20"/></nodes>')
    Path("road.edg.xml").write_text(
        '<edges><edge id="in" from="far" to="near" numLanes="2" speed="10"/></edges>')
    tool("netconvert", "-n", "road.nod.xml", "-e", "road.edg.xml", "-o", "road.net.xml", *AT_ORIGIN)


def sumo_alone(program):
    plain_network()
    return driven(program, "road.net.xml", "in", "road")


def first_edge(network):
    """The edge without a predecessor that has lanes, by its name in the file."""
    every = ElementTree.parse(network).getroot().iter("edge")
    edges = [edge for edge in every if edge.get("function") is None]
    return max(edges, key=lambda edge: float(edge.find("lane").get("length"))).get("id")


def open_drive(program):
    tool("netconvert", "-s", "road.net.xml", "--opendrive-output", "road.xodr")
    tool("netconvert", "--opendrive-files", "road.xodr", "-o", "drive.net.xml", *AT_ORIGIN)
    return driven(program, "drive.net.xml", first_edge("drive.net.xml"), "drive")


def open_street_map(program):
    # A way of 140 m, made by hand; a degree of latitude is 111 km.
    Path("street.osm").write_text("""<osm version="0.6">
  <node id="1" lat="52.00126" lon="13.0" version="1"/><node id="2" lat="52.0" lon="13.0" version="1"/>
  <way id="3" version="1"><nd ref="1"/><nd ref="2"/>
    <tag k="highway" v="secondary"/><tag k="oneway" v="yes"/><tag k="lanes" v="2"/>
    <tag k="maxspeed" v="40"/></way>
</osm>""")
    tool("netconvert", "--osm-files", "street.osm", "-o", "corner.net.xml")
    tool("netconvert", "-s", "corner.net.xml", "-o", "street.net.xml", "--offset.y", "-20")
    return driven(program, "street.net.xml", first_edge("street.net.xml"), "street")


if __name__ == "__main__":
    main()
