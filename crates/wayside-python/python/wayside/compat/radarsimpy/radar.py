"""Class ``Radar``: a transmitter and a receiver at a place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .receiver import Receiver
from .refusal import finite, nothing, refuse, vector
from .transmitter import Transmitter

_BOLTZMANN_J_PER_K = 1.380649e-23
_TEMPERATURE_K = 290.0


class Radar:
    """Radar by RadarSimPy's names and units.

    ``location`` in m, ``speed`` in m/s, ``rotation`` [yaw, pitch, roll] in degrees, of which wayside takes
    yaw; ``frame_time`` (earlier ``time``) when each frame begins, s, 0 where it is left out. ``seed`` draws
    noise; None draws anew each time.
    """

    def __init__(
        self,
        transmitter: Transmitter,
        receiver: Receiver,
        frame_time: Any = None,
        location: Sequence[float] = (0, 0, 0),
        speed: Sequence[float] = (0, 0, 0),
        rotation: Sequence[float] = (0, 0, 0),
        rotation_rate: Sequence[float] = (0, 0, 0),
        seed: int | None = None,
        *,
        time: Any = None,
    ) -> None:
        starts = _starts(frame_time, time)
        turned = vector(rotation, "rotation")
        nothing(turned[1:], "rotation", "pitch and roll; yaw is taken")
        nothing(vector(rotation_rate, "rotation_rate"), "rotation_rate", "the radar does not turn in a frame")
        samples = int(round(transmitter.waveform_prop["pulse_length"] * receiver.bb_prop["fs"], 6))
        if samples < 8:
            raise refuse("Receiver(fs)", f"{samples} samples a pulse; 8 are needed")
        size = len(transmitter.antennas) * len(receiver.antennas)
        self.seed = _seed(seed)
        self.radar_prop: dict[str, Any] = {
            "transmitter": transmitter,
            "receiver": receiver,
            "location": vector(location, "location"),
            "speed": vector(speed, "speed"),
            "rotation": np.radians(turned),
            "rotation_rate": np.zeros(3),
        }
        self.sample_prop: dict[str, Any] = {"samples_per_pulse": samples}
        self.array_prop: dict[str, Any] = {
            "size": size,
            "virtual_array": _virtual(transmitter.antennas.locations, receiver.antennas.locations),
        }
        one_frame = self._timestamp()
        timestamp = np.concatenate([one_frame + start for start in starts])
        self.time_prop: dict[str, Any] = {
            "frame_size": len(starts),
            "frame_start_time": starts,
            "timestamp": timestamp,
            "timestamp_shape": timestamp.shape,
            "origin_timestamp": one_frame,
            "origin_timestamp_shape": one_frame.shape,
        }
        self.sample_prop["noise"] = self._noise()
        self.sample_prop["phase_noise"] = None

    @property
    def timestamp(self) -> NDArray[np.float64]:
        """Time of every sample, s, [frames·tx·rx, pulses, samples]."""
        stamp: NDArray[np.float64] = self.time_prop["timestamp"]
        return stamp

    def _timestamp(self) -> NDArray[np.float64]:
        transmitter, receiver = self.radar_prop["transmitter"], self.radar_prop["receiver"]
        delays = np.repeat(transmitter.txchannel_prop["delay"], len(receiver.antennas))
        pulses = transmitter.waveform_prop["pulse_start_time"]
        samples = np.arange(self.sample_prop["samples_per_pulse"]) / receiver.bb_prop["fs"]
        stamp: NDArray[np.float64] = delays[:, None, None] + pulses[None, :, None] + samples
        return stamp

    def _noise(self) -> float:
        """Root mean square of the noise at the converter, V."""
        receiver = self.radar_prop["receiver"]
        power_w = _BOLTZMANN_J_PER_K * _TEMPERATURE_K * receiver.bb_prop["noise_bandwidth"]
        return float(receiver.volts() * (power_w * 10 ** (receiver.rf_prop["noise_figure"] / 10)) ** 0.5)


def times(told: Any) -> NDArray[np.float64]:
    """Times at which frames begin, s."""
    starts = np.atleast_1d(np.asarray(told, dtype=float))
    if starts.ndim != 1 or not len(starts):
        raise ValueError("frame_time: one number, or a list of them, is needed")
    return finite(starts, "frame_time")


def _starts(frame_time: Any, time: Any) -> NDArray[np.float64]:
    if frame_time is not None and time is not None:
        raise ValueError("frame_time and time are one argument by two names; one of them is needed")
    told = frame_time if time is None else time
    return times(0 if told is None else told)


def _seed(seed: int | None) -> int | None:
    if seed is not None and int(seed) < 0:
        raise ValueError(f"seed: must be 0 or more, is {seed}")
    return seed if seed is None else int(seed)


def _virtual(transmit: NDArray[np.float64], receive: NDArray[np.float64]) -> NDArray[np.float64]:
    places: NDArray[np.float64] = (transmit[:, None, :] + receive[None, :, :]).reshape(-1, 3)
    return places
