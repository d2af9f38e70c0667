"""A radar by the JSON of an artifact: its axes, resolution, link and noise, by textbook formulas."""

import math

SPEED_OF_LIGHT_MPS = 299_792_458.0
BOLTZMANN_J_PER_K = 1.380649e-23


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def direction(azimuth, elevation):
    """A unit vector of the world from its azimuth, from +y towards +x, and its elevation."""
    return [math.sin(azimuth) * math.cos(elevation), math.cos(azimuth) * math.cos(elevation),
            math.sin(elevation)]


def ratio(db):
    return 10 ** (db / 10)


class Sensor:
    def __init__(self, radar):
        self.radar, self.place = radar, radar["position_m"]
        azimuth, elevation = radar["boresight_az_rad"], radar["boresight_el_rad"]
        self.ahead = direction(azimuth, elevation)
        self.left = [-math.cos(azimuth), math.sin(azimuth), 0.0]
        a, b = self.ahead, self.left
        self.up = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        wave, array = radar["waveform"], radar["array"]
        self.samples, self.chirps = wave["samples"], wave["chirps"]
        sweep_hz = wave["slope_hz_per_s"] * self.samples / wave["sample_rate_hz"]
        self.wavelength_m = SPEED_OF_LIGHT_MPS / (wave["start_frequency_hz"] + sweep_hz / 2)
        self.range_cell_m = SPEED_OF_LIGHT_MPS / (2 * sweep_hz)
        if array["multiplexing"] != "Simultaneous" or wave["sampling"] != "Complex":
            raise NotImplementedError("the check's scenes have ideal transmitters and complex samples")
        self.frame_s = self.chirps * wave["chirp_interval_s"]
        self.velocity_cell_mps = self.wavelength_m / (2 * self.frame_s)
        self.velocity_span_mps = self.wavelength_m / (2 * wave["chirp_interval_s"])
        # Phase centres of the virtual array: half of the way from a transmitter to a receiver.
        pairs = [(tx, rx) for tx in array["tx_m"] for rx in array["rx_m"]]
        self.elements_m = [[(t + r) / 2 for t, r in zip(tx, rx)] for tx, rx in pairs]

    def mounting(self):
        x, y, z = self.place
        turn = {"roll": 0.0, "pitch": -self.radar["boresight_el_rad"],
                "yaw": math.pi / 2 - self.radar["boresight_az_rad"]}
        return {"position": {"x": x, "y": y, "z": z}, "orientation": turn}

    def angles(self, way):
        """Azimuth, positive to the left, and elevation of a unit vector in the sensor's axes."""
        return math.atan2(dot(way, self.left), dot(way, self.ahead)), math.asin(dot(way, self.up))

    def angles_of_world(self, azimuth, elevation):
        return self.angles(direction(azimuth, elevation))

    def amplitude(self, way):
        """Amplitude of an element's pattern towards a unit vector."""
        pattern, ahead = self.radar["array"]["pattern"], dot(way, self.ahead)
        return 1.0 if pattern == "Isotropic" else max(ahead, 0.0) ** pattern["Cosine"]["exponent"]

    def gain(self, way):
        """Power gain of an antenna towards a unit vector."""
        return ratio(self.radar["link"]["antenna_gain_db"]) * self.amplitude(way) ** 2

    def cosine_error(self, axis, strength):
        """Cramér–Rao bound of the direction cosine along an axis of the array, from the Fisher information of
        the phases 4π·x·u/λ of its elements; None where they are all at one place."""
        along = [dot(element, axis) * 4 * math.pi / self.wavelength_m for element in self.elements_m]
        mean = sum(along) / len(along)
        information = 2 * strength / len(along) * sum((phase - mean) ** 2 for phase in along)
        return information ** -0.5 if information > 1e-6 * strength else None


def tone_error_cells(count, strength):
    """Cramér–Rao bound of the frequency of a tone of `count` samples with unknown phase, in cells; `strength`
    is the ratio of power to noise of all samples together."""
    middle = (count - 1) / 2
    information = 2 * strength / count * sum((2 * math.pi * (n - middle) / count) ** 2 for n in range(count))
    return information ** -0.5


def noise_bandwidth_cells(window):
    """Equivalent noise bandwidth of a window of cosines, from its coefficients (Harris 1978, eq. 11)."""
    windows = {"Rect": [1], "Hann": [0.5, 0.5], "Hamming": [0.54, 0.46], "Blackman": [0.42, 0.5, 0.08]}
    first, *others = windows[window]
    return 1 + sum(a * a for a in others) / (2 * first**2)
