"""Whether messages that the official packages of OSI, MCAP and ROS 2 write and read are those of the program,
field by field, and whether what SUMO, netconvert and OSI make runs through it (docs/interchange.md):

    check.py PROGRAM FOLDER

PROGRAM is wayside built with `--features interchange`, FOLDER is empty. The first difference ends it with
exit code 1.
"""

import csv
import json
import math
import os
import struct
import subprocess
import sys
from pathlib import Path

import sumo
from mcap_ros2.reader import read_ros2_messages
from osi3.osi_groundtruth_pb2 import GroundTruth
from osi3.osi_sensordata_pb2 import SensorData
from osi3.osi_sensorview_pb2 import SensorView
from osi_utilities.tracefile.readers.multi import MultiTraceReader
from osi_utilities.tracefile.writers.multi import MultiTraceWriter

SPEED_OF_LIGHT_MPS = 299_792_458.0
NO_OBJECT = 2**64 - 1
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


def main():
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True)
    os.chdir(folder)
    checks = [ground_truth, detections, objects, reflections, clouds, sumo_alone, open_drive, open_street_map]
    for check in checks:
        told = check(program)
        print(f"{check.__name__}: {told}", flush=True)
    print(f"test result: ok. {len(checks)} passed; 0 failed")


def wayside(program, *words):
    subprocess.run([program, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)


def same(ours, theirs, what, within=1e-9):
    """Numbers to a relative difference, anything else to the letter."""
    is_number = isinstance(ours, float) and isinstance(theirs, (int, float))
    equal = abs(ours - theirs) <= within * max(1.0, abs(ours)) if is_number else ours == theirs
    if not equal:
        sys.exit(f"{what}: the file has {theirs}, the artifact {ours}")


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
    same((1, True), (ended.returncode, "it is a SensorData" in ended.stderr), "a message without ground truth")


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
    same([m.SerializeToString(deterministic=True) for m in found],
         [m.SerializeToString(deterministic=True) for m in messages_in_mcap(f"{artifact}.mcap", "precompiled")],
         "messages of MCAP")
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


def axes_of(radar):
    """Unit vectors ahead, left and up of the radar."""
    azimuth, elevation = radar["boresight_az_rad"], radar["boresight_el_rad"]
    ahead = [math.sin(azimuth) * math.cos(elevation), math.cos(azimuth) * math.cos(elevation),
             math.sin(elevation)]
    left = [-math.cos(azimuth), math.sin(azimuth), 0.0]
    up = [ahead[1] * left[2] - ahead[2] * left[1], ahead[2] * left[0] - ahead[0] * left[2],
          ahead[0] * left[1] - ahead[1] * left[0]]
    return ahead, left, up


def angles(axes, azimuth, elevation):
    """A direction of the world as the sensor sees it."""
    way = [math.sin(azimuth) * math.cos(elevation), math.cos(azimuth) * math.cos(elevation),
           math.sin(elevation)]
    x, y, z = (sum(a * b for a, b in zip(way, axis)) for axis in axes)
    return math.atan2(y, x), math.asin(max(-1.0, min(1.0, z)))


def detections(program):
    whole = as_json(program, "truth.osi-run/frames.points")
    radar, axes = whole["header"]["cube"]["radar"], axes_of(whole["header"]["cube"]["radar"])
    found = both_containers(program, "truth.osi-run/frames.points", SensorData)
    same(len(whole["frames"]), len(found), "frames")
    count = 0
    for frame, message in zip(whole["frames"], found):
        same(frame["time_s"], message.timestamp.seconds + message.timestamp.nanos * 1e-9, "time")
        mounted = message.mounting_position
        for ours, theirs in zip(radar["position_m"], (mounted.position.x, mounted.position.y, mounted.position.z)):
            same(ours, theirs, "mounting position")
        same(math.pi / 2 - radar["boresight_az_rad"], mounted.orientation.yaw, "yaw of the sensor")
        [sensor] = message.feature_data.radar_sensor
        same(sensor.header.number_of_valid_detections, len(frame["points"]), "detections")
        for point, seen in zip(frame["points"], sensor.detection):
            azimuth, elevation = angles(axes, point["azimuth_rad"], point["elevation_rad"])
            same(point["range_m"], seen.position.distance, "distance")
            same(azimuth, seen.position.azimuth, "azimuth")
            same(elevation, seen.position.elevation, "elevation")
            same(point["radial_velocity_mps"], seen.radial_velocity, "radial velocity")
            same(point["snr_db"], seen.snr, "signal-to-noise ratio")
            same(NO_OBJECT if point["object"] is None else point["object"], seen.object_id.value, "object")
            resolved = point["object"] is not None and frame["objects"][point["object"]]["velocity_resolved"]
            same(resolved, seen.ambiguity_id.value == 0, "ambiguity")
            errors = seen.position_rmse
            if not (0 < errors.distance < 1 and 0 < errors.azimuth < 0.2 and 0 <= seen.existence_probability <= 1
                    and -60 < seen.rcs < 50 and 0 < seen.radial_velocity_rmse < 1):
                sys.exit(f"errors that cannot be: {seen}")
            count += 1
    return f"{count} detections of {len(found)} frames field by field"


def of_middle(track, row, column):
    """Covariance of the middle of a box: half of what a vehicle of up to 12 m may have beyond it, evenly."""
    box = track["footprint"]
    along = (math.cos(box["heading_rad"]), math.sin(box["heading_rad"]))
    unseen = max(12.0 - box["length_m"], 0.0)
    return track["covariance"][row][column] + along[row] * along[column] * unseen**2 / 12


def objects(program):
    whole = as_json(program, "truth.osi-run/frames.tracks")
    summary = json.loads(Path("truth.osi-run/summary.json").read_text())
    found = both_containers(program, "truth.osi-run/frames.tracks", SensorData)
    count = candidates = 0
    for frame, told, message in zip(whole["frames"], summary["frames"], found):
        believed = [track for track in frame["tracks"] if track["state"] != "Tentative"]
        same(len(believed), len(message.moving_object), "objects")
        classes = {track["id"]: track["probabilities"] for track in told["tracks"]}
        for track, seen in zip(believed, message.moving_object):
            same(track["id"], seen.header.tracking_id.value, "tracking id")
            box, base = track["footprint"], seen.base
            same(box["centre_m"][0], base.position.x, "x")
            same(box["centre_m"][1], base.position.y, "y")
            same(box["length_m"], base.dimension.length, "length")
            same(box["heading_rad"], base.orientation.yaw, "heading")
            same(track["velocity_mps"][1], base.velocity.y, "velocity")
            same(math.sqrt(of_middle(track, 0, 0)), seen.base_rmse.position.x, "error of x")
            same(math.sqrt(track["covariance"][3][3]), seen.base_rmse.velocity.y, "error of the velocity")
            kinds = {4: "car", 12: "bus", 7: "truck", 10: "motorcycle"}
            for candidate in seen.candidate:
                name = kinds[candidate.vehicle_classification.type]
                same(classes[track["id"]][name], candidate.probability, f"probability of {name}")
                candidates += 1
            count += 1
    if count == 0 or candidates == 0:
        sys.exit("no track is believed, or none has a class: nothing was compared")
    return f"{count} objects with {candidates} candidates field by field"


def reflections(program):
    wayside(program, "export", "truth.osi-run/frames.paths", "--to", "csv", "--out", "paths.csv")
    rows = [row for row in csv.DictReader(open("paths.csv")) if row["pol"] == "vv"]
    frequency_hz = json.loads(Path("paths.csv.json").read_text())["f_c_hz"]
    found = both_containers(program, "truth.osi-run/frames.paths", SensorView)
    count = 0
    for number, message in enumerate(found):
        [view] = message.radar_sensor_view
        own = [row for row in rows if int(row["frame"]) == number]
        same(len(own), len(view.reflection), "reflections")
        same(frequency_hz, view.view_configuration.emitter_frequency, "frequency")
        for row, seen in zip(own, view.reflection):
            same(float(row["delay_s"]) * 1e6, seen.time_of_flight * 1e6, "time of flight")
            same(-float(row["delay_rate"]) * frequency_hz, seen.doppler_shift, "Doppler shift", 1e-6)
            if not -300 <= seen.signal_strength < 0:
                sys.exit(f"a strength that cannot be: {seen}")
            count += 1
    return f"{count} reflections of {len(found)} frames field by field"


# Points and tracks, read by mcap-ros2-support.


FIELDS = ["x", "y", "z", "velocity", "snr", "object", "height_measured"]


def clouds(program):
    for kind in ["points", "tracks"]:
        wayside(program, "export", f"truth.osi-run/frames.{kind}", "--to", "mcap", "--out", f"{kind}.mcap")
    points, tracks = (as_json(program, f"truth.osi-run/frames.{kind}") for kind in ["points", "tracks"])
    seen = {topic: [] for topic in ["/radar/points", "/radar/scan", "/radar/tracks"]}
    for message in [*read_ros2_messages("points.mcap"), *read_ros2_messages("tracks.mcap")]:
        seen[message.channel.topic].append(message.ros_msg)
    axes, count = axes_of(points["header"]["cube"]["radar"]), 0
    for frame, cloud, scan in zip(points["frames"], seen["/radar/points"], seen["/radar/scan"], strict=True):
        same(frame["time_s"], cloud.header.stamp.sec + cloud.header.stamp.nanosec * 1e-9, "time")
        same([field.name for field in cloud.fields], FIELDS, "fields")
        same(len(frame["points"]), cloud.width, "points")
        same(len(frame["points"]), len(scan.returns), "returns")
        for number, point in enumerate(frame["points"]):
            *numbers, thing, measured = struct.unpack_from("<5fiI", bytes(cloud.data), number * cloud.point_step)
            for ours, theirs in zip([*point["position_m"], point["radial_velocity_mps"], point["snr_db"]], numbers):
                same(ours, theirs, "a number of the cloud", 1e-6)
            same(-1 if point["object"] is None else point["object"], thing, "object")
            same(int(point["height"] == "Measured"), measured, "height_measured")
            echo = scan.returns[number]
            azimuth, elevation = angles(axes, point["azimuth_rad"], point["elevation_rad"])
            for ours, theirs in [(point["range_m"], echo.range), (azimuth, echo.azimuth),
                                 (elevation, echo.elevation), (point["snr_db"], echo.amplitude),
                                 (point["radial_velocity_mps"], echo.doppler_velocity)]:
                same(ours, theirs, "a number of the scan", 1e-6)
            count += 1
    for frame, told in zip(tracks["frames"], seen["/radar/tracks"], strict=True):
        believed = [track for track in frame["tracks"] if track["state"] != "Tentative"]
        same(len(believed), len(told.tracks), "tracks")
        for track, seen_as in zip(believed, told.tracks):
            same(track["id"], int.from_bytes(bytes(seen_as.uuid.uuid), "big"), "uuid")
            same(track["footprint"]["centre_m"][1], seen_as.position.y, "y")
            same(track["velocity_mps"][1], seen_as.velocity.y, "velocity")
            same(of_middle(track, 0, 1), seen_as.position_covariance[1], "covariance", 1e-6)
    return f"{count} points as clouds and scans, {len(tracks['frames'])} frames of tracks field by field"


# SUMO, headless, and networks from elsewhere.

BIN = Path(sumo.SUMO_HOME) / "bin"
AT_ORIGIN = ["--offset.disable-normalization", "true"]


def tool(name, *words):
    environment = {**os.environ, "SUMO_HOME": str(sumo.SUMO_HOME)}
    subprocess.run([BIN / name, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env=environment)


def driven(program, network, edges, name):
    """Vehicles along a way of a network, two frames of them through the program."""
    Path(f"{name}.rou.xml").write_text(f"""<routes>
  <vType id="car" length="4.6"/><vType id="bus" vClass="bus" length="12"/>
  <route id="way" edges="{edges}"/>
  <flow id="cars" type="car" route="way" begin="0" end="60" period="4"/>
  <flow id="buses" type="bus" route="way" begin="2" end="60" period="15"/>
</routes>""")
    tool("sumo", "-n", network, "-r", f"{name}.rou.xml", "--fcd-output", f"{name}.fcd.xml", "--end", "30",
         "--step-length", "0.1", "--seed", "1", "--no-step-log", "true")
    scene = HEAD.replace('name = "interchange"', 'name = "sumo"\nframes = 2')
    Path(f"{name}.toml").write_text(
        scene + f'fcd = "{name}.fcd.xml"\nnet = "{network}"\nbegin_s = 20.0\n')
    wayside(program, "run", f"{name}.toml", "--out", f"{name}-run", "--no-cache")
    summary = json.loads(Path(f"{name}-run/summary.json").read_text())
    count = sum(len(frame["targets"]) for frame in summary["frames"])
    points = sum(frame["points"] for frame in summary["frames"])
    if count == 0 or points == 0:
        sys.exit(f"{name}: nothing is in view, or nothing was detected")
    return f"{count} vehicles in view of 2 frames, {points} points, {len(summary['lanes'])} lanes"


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
    import xml.etree.ElementTree as tree
    edges = [edge for edge in tree.parse(network).getroot().iter("edge") if edge.get("function") is None]
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
