"""Messages of OSI as an artifact's JSON has them by the formulas of docs/interchange.md and
docs/decisions/osi.md, as dictionaries of all their fields."""

import decimal
import math

from osi3.osi_detectedobject_pb2 import DetectedItemHeader, DetectedMovingObject
from osi3.osi_featuredata_pb2 import SensorDetectionHeader
from osi3.osi_object_pb2 import MovingObject
from osi3.osi_sensordata_pb2 import DetectedEntityHeader

from compared import About
from sensor import (BOLTZMANN_J_PER_K, SPEED_OF_LIGHT_MPS, Sensor, direction, dot, noise_bandwidth_cells,
                    ratio, tone_error_cells)

NO_OBJECT = 2**64 - 1
VERSION = {"version_major": 3, "version_minor": 8, "version_patch": 0}
VEHICLE = MovingObject.VehicleClassification
CLASSES = {"car": VEHICLE.TYPE_MEDIUM_CAR, "bus": VEHICLE.TYPE_BUS, "truck": VEHICLE.TYPE_HEAVY_TRUCK,
           "motorcycle": VEHICLE.TYPE_MOTORBIKE}
LONGEST_M = 12.0


def stamp(time_s):
    seconds, nanos = divmod(round(time_s * 1e9), 10**9)
    return {"seconds": seconds, "nanos": nanos}


def head(number, sensor, frame):
    return {"version": VERSION, "timestamp": stamp(frame["time_s"]), "sensor_id": {"value": number},
            "mounting_position": sensor.mounting()}


# Detections.


def detections(number, cube, frame):
    """`SensorData` of the points of a frame by the sensor with that number."""
    sensor, points = Sensor(cube["radar"]), frame["points"]
    measured = stamp(frame["time_s"] + sensor.frame_s / 2)
    header = {"measurement_time": measured, "cycle_counter": frame["index"],
              "mounting_position": sensor.mounting(),
              "data_qualifier": SensorDetectionHeader.DATA_QUALIFIER_AVAILABLE,
              "number_of_valid_detections": len(points), "sensor_id": {"value": number}}
    found = [detection(sensor, cube, frame, at) for at in range(len(points))]
    of_radar = {"header": header, "detection": found} if found else {"header": header}
    return head(number, sensor, frame) | {
        "last_measurement_time": measured, "feature_data": {"version": VERSION, "radar_sensor": [of_radar]}}


def detection(sensor, cube, frame, at):
    point = frame["points"][at]
    azimuth, elevation = sensor.angles_of_world(point["azimuth_rad"], point["elevation_rad"])
    errors, velocity_error = standard_errors(sensor, cube, frame["points"], point, azimuth, elevation)
    return {
        "existence_probability": existence(sensor, point["snr_db"]),
        "object_id": {"value": NO_OBJECT if point["object"] is None else point["object"]},
        "position": {"distance": point["range_m"], "azimuth": azimuth, "elevation": elevation},
        "position_rmse": errors,
        "radial_velocity": point["radial_velocity_mps"],
        "radial_velocity_rmse": velocity_error,
        "rcs": cross_section_dbsm(sensor, cube, point),
        "snr": point["snr_db"],
        "ambiguity_id": {"value": ambiguity(frame, at)},
    }


def standard_errors(sensor, cube, points, point, azimuth, elevation):
    """Errors in the sensor's coordinates, and of the velocity: Cramér–Rao bounds, a twelfth of the cell
    squared, and the distance from the strongest point under the same main lobe."""
    strength = max(ratio(point["snr_db"]), 1.0) * len(sensor.elements_m)
    slope = slope_of(sensor, cube, points, point)

    def axis(count, cell, distance):
        # The bound for many samples, as the program has it, lacks the factor N²/(N² − 1) of its square.
        bound = tone_error_cells(count, strength)
        return About(math.sqrt(cell**2 * (bound**2 + 1 / 12) + distance**2), 1 / count**2)

    errors = {"distance": axis(sensor.samples, sensor.range_cell_m, slope[0])}
    across, along = sensor.cosine_error(sensor.left, strength), sensor.cosine_error(sensor.up, strength)
    if across is not None:
        errors["azimuth"] = min(across / abs(math.cos(elevation) * math.cos(azimuth)), math.pi)
    if along is not None:
        errors["elevation"] = min(along / abs(math.cos(elevation)), math.pi)
    return errors, axis(sensor.chirps, sensor.velocity_cell_mps, slope[1])


def slope_of(sensor, cube, points, point):
    """Distance in range and velocity from the strongest point whose main lobe covers this one: to the first
    zero of the window, and half a cell for the offset of a peak from its cell."""
    zero_cells = {"Rect": 1, "Hann": 2, "Hamming": 2, "Blackman": 3}
    reach_m, reach_mps = ((zero_cells[cube["dsp"][name]] + 0.5) * cell for name, cell in [
        ("range_window", sensor.range_cell_m), ("doppler_window", sensor.velocity_cell_mps)])
    found, strongest = (0.0, 0.0), point["snr_db"]
    for other in points:
        away_m = point["range_m"] - other["range_m"]
        away_mps = point["radial_velocity_mps"] - other["radial_velocity_mps"]
        away_mps = math.remainder(away_mps, sensor.velocity_span_mps)
        if other["snr_db"] > strongest and abs(away_m) <= reach_m and abs(away_mps) <= reach_mps:
            found, strongest = (away_m, away_mps), other["snr_db"]
    return found


def existence(sensor, snr_db):
    """Probability that a map of noise alone has no cell as strong: the mean power of M channels of noise,
    each exponential, exceeds ρ, of the echo and its noise, where a Poisson variable of mean Mρ is below M."""
    decimal.getcontext().prec = 60
    channels, cells = len(sensor.elements_m), sensor.samples * sensor.chirps
    mean = decimal.Decimal(channels * (ratio(snr_db) + 1))
    term = total = (-mean).exp()
    for k in range(1, channels):
        term *= mean / k
        total += term
    return float((-cells * total).exp())


def cross_section_dbsm(sensor, cube, point):
    """σ of the radar equation: the echo in a cell is P·G²·λ²·σ/((4π)³·R⁴), gathered over all samples, beside
    the noise k·T·F·f_s that the windows let through."""
    radar, noise = cube["radar"], cube["noise"]["Figure"]
    noise_w = BOLTZMANN_J_PER_K * noise["temperature_k"] * ratio(noise["noise_figure_db"])
    noise_w *= radar["waveform"]["sample_rate_hz"] / (sensor.samples * sensor.chirps)
    for name in ["range_window", "doppler_window"]:
        noise_w *= noise_bandwidth_cells(cube["dsp"][name])
    gain = sensor.gain(direction(point["azimuth_rad"], point["elevation_rad"]))
    received_w = ratio(point["snr_db"]) * noise_w
    power_w = radar["link"]["transmit_power_w"]
    spread = (4 * math.pi) ** 3 * point["range_m"] ** 4 / (gain * sensor.wavelength_m) ** 2
    return 10 * math.log10(received_w * spread / power_w)


def ambiguity(frame, at):
    """0 where the velocity is resolved; otherwise a number of the object, or of the single point after all
    objects."""
    place = frame["points"][at]["object"]
    if place is None:
        return 1 + len(frame["objects"]) + at
    return 0 if frame["objects"][place]["velocity_resolved"] else 1 + place


# Objects.


def objects(number, cube, frame, classes, born_s):
    """`SensorData` of the believed tracks of a frame: probabilities of the classes by track, and the time at
    which each was first there."""
    sensor = Sensor(cube["radar"])
    measured = stamp(frame["time_s"] + sensor.frame_s / 2)
    header = {"measurement_time": measured, "cycle_counter": frame["index"],
              "data_qualifier": DetectedEntityHeader.DATA_QUALIFIER_AVAILABLE}
    found = [moving_object(number, track, frame["time_s"] - born_s[track["id"]], classes.get(track["id"]))
             for track in believed(frame)]
    told = {"last_measurement_time": measured, "moving_object_header": header}
    return head(number, sensor, frame) | told | ({"moving_object": found} if found else {})


def believed(frame):
    return [track for track in frame["tracks"] if track["state"] != "Tentative"]


def moving_object(number, track, age_s, probabilities):
    box, covariance = track["footprint"], track["covariance"]
    states = {"Confirmed": DetectedItemHeader.MEASUREMENT_STATE_MEASURED,
              "Coasting": DetectedItemHeader.MEASUREMENT_STATE_PREDICTED}
    middle = middle_covariance(track)
    found = {
        "header": {"tracking_id": {"value": track["id"]}, "age": age_s,
                   "measurement_state": states[track["state"]], "sensor_id": [{"value": number}]},
        "base": {"dimension": {"length": box["length_m"], "width": box["width_m"]},
                 "position": flat(box["centre_m"]), "orientation": {"yaw": box["heading_rad"]},
                 "velocity": flat(track["velocity_mps"])},
        "base_rmse": {"position": flat([math.sqrt(middle[i][i]) for i in range(2)]),
                      "velocity": flat([math.sqrt(covariance[i][i]) for i in [2, 3]])},
        "reference_point": DetectedMovingObject.REFERENCE_POINT_CENTER,
    }
    if probabilities and None not in probabilities.values():
        found["candidate"] = [
            {"probability": probabilities[name], "type": MovingObject.TYPE_VEHICLE,
             "vehicle_classification": {"type": kind}} for name, kind in CLASSES.items()]
    return found


def flat(pair):
    return dict(zip("xy", pair))


def middle_covariance(track):
    """Covariance of the middle of a box: half of what a vehicle of up to 12 m may have beyond it, evenly."""
    box = track["footprint"]
    along = (math.cos(box["heading_rad"]), math.sin(box["heading_rad"]))
    unseen_m = max(LONGEST_M - box["length_m"], 0.0)
    return [[track["covariance"][row][column] + along[row] * along[column] * unseen_m**2 / 12
             for column in range(2)] for row in range(2)]


# Reflections.

# Half a difference quotient's step: rounding of a length of 100 m costs 1e-9 m/s, curvature less than 1e-7.
STEP_S = 1e-5


def reflections(number, header, frame):
    """`SensorView` of the paths of a frame."""
    sensor = Sensor(header["radar"])
    found = [reflection(sensor, header["centre_frequency_hz"], path) for path in frame["paths"]]
    view = {"view_configuration": {"sensor_id": {"value": number}, "mounting_position": sensor.mounting(),
                                   "emitter_frequency": header["centre_frequency_hz"]}}
    view |= {"reflection": found} if found else {}
    return head(number, sensor, frame) | {"radar_sensor_view": [view]}


def reflection(sensor, frequency_hz, path):
    middle_s = sensor.frame_s / 2
    lengths = {time_s: [leg(sensor, path, end, time_s)[0] for end in ["tx", "rx"]]
               for time_s in [middle_s - STEP_S, middle_s, middle_s + STEP_S]}
    before_m, there_and_back_m, behind_m = (sum(pair) for pair in lengths.values())
    ways = [leg(sensor, path, end, middle_s)[1] for end in ["tx", "rx"]]
    azimuth, elevation = sensor.angles(ways[1])
    rate_mps = (behind_m - before_m) / (2 * STEP_S)
    return {
        "signal_strength": strength_db(sensor, path, lengths[middle_s], ways),
        "time_of_flight": there_and_back_m / SPEED_OF_LIGHT_MPS,
        "doppler_shift": About(-rate_mps * frequency_hz / SPEED_OF_LIGHT_MPS, 1e-6),
        "source_horizontal_angle": azimuth,
        "source_vertical_angle": elevation,
    }


def leg(sensor, path, end, time_s):
    """Length and direction of the way from the array's centre to where the node appears at a time."""
    curve, rim = path["curve"], path["curve"]["rim"]
    moved = [v * time_s + a * time_s**2 / 2
             for v, a in zip(path[f"apparent_{end}_mps"], curve[f"apparent_{end}_mps2"])]
    place = [x + way for x, way in zip(path[f"apparent_{end}_m"], moved)]
    if rim is not None:
        radius_m, forward = rim["radius_m"], rim["forward"]
        turn = rim["angle_rad"] - dot(moved, forward) / radius_m
        place = [x + radius_m * (math.cos(turn) * f + math.sin(turn) * up)
                 for x, f, up in zip(place, forward, [0.0, 0.0, 1.0])]
    away = [x - p for x, p in zip(place, sensor.place)]
    length_m = math.sqrt(dot(away, away))
    return length_m, [x / length_m for x in away]


def strength_db(sensor, path, lengths_m, ways):
    """Received over transmitted power by the radar equation, with |a|² in place of σ and both ways apart."""
    if path["curve"]["span"] is not None:
        raise NotImplementedError("the check's paths stand for the whole frame")
    receive, transmit = ("vh".index(letter) for letter in sensor.radar["array"]["polarization"].lower())
    mean, error = share(sensor, path)
    a = mean * math.hypot(*path["amplitude_m"][receive][transmit])
    there, back = (sensor.gain(way) / length_m**2 for way, length_m in zip(ways, lengths_m))
    told_db = 10 * math.log10(there * back * (sensor.wavelength_m * a) ** 2 / (4 * math.pi) ** 3)
    error_db = -20 * math.log10(1 - error / abs(mean))
    return About(told_db, 1e-9 + error_db / max(1.0, abs(told_db)))


def share(sensor, path):
    """Mean over all pairs of elements of the polynomial through up to four of the places from which a path
    was traced, 1 at its own place and 0 at the others, on the path's side of the row; and the error of the
    program's mean, of 128 samples at even distances: half of a distance for each step from one pair to the
    next."""
    span, side = path["curve"]["array_span"], path["curve"]["array_side"]
    if span is None and side is None:
        return 1.0, 0.0
    array = sensor.radar["array"]
    shares = [share_of_pair(span, tx_m, rx_m) * share_of_side(side, tx_m, rx_m)
              for tx_m in array["tx_m"] for rx_m in array["rx_m"]]
    steps = sum(abs(b - a) for a, b in zip(shares, shares[1:]))
    return sum(shares) / len(shares), steps / (2 * 128)


def along_m(of, tx_m, rx_m):
    return dot(tx_m, of["transmit"]) + dot(rx_m, of["receive"])


def share_of_side(side, tx_m, rx_m):
    if side is None:
        return 1.0
    beyond_m = along_m(side, tx_m, rx_m) - side["from_m"]
    return 0.5 if beyond_m == 0.0 else float(beyond_m > 0.0)


def share_of_pair(span, tx_m, rx_m):
    if span is None:
        return 1.0
    at, own = (along_m(span, tx_m, rx_m) - span["first_m"]) / span["step_m"], span["place"]
    first = min(max(math.floor(at) - 1, 0), max(span["places"] - 4, 0))
    near = range(first, min(first + 4, span["places"]))
    return math.prod((at - node) / (own - node) for node in near if node != own) if own in near else 0.0
