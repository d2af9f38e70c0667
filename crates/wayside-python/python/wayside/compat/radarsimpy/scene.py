"""A radar and its targets as a scene of wayside.

Their axes are x forward, y left, z up; a scene's are x right, y forward, z up. Everything is told as seen
from the radar, which stands still: its origin is that of the scene, and the middle of the transmitters of a
look the place of the scene's radar.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .radar import Radar
from .refusal import needed, nothing, number, refuse, refuse_keys, vector

_C_MPS = 299_792_458.0
_POINT = {"location", "speed", "rcs", "phase"}
_MESH = {
    "model",
    "origin",
    "location",
    "speed",
    "rotation",
    "rotation_rate",
    "permittivity",
    "unit",
    "skip_diffusion",
}
_UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}


@dataclass(frozen=True)
class Look:
    """A scene's part of a simulation: one frame, seen by transmitters that begin together or take turns."""

    transmitters: list[int]
    """Indices of the transmitters."""
    time_s: float
    """Time of their first sample."""
    seed: int
    """Seed of the phase noise."""
    gaps_s: list[float] = field(default_factory=list)
    """Time from each one's chirp to the next one's, where they take turns; empty where they do not."""


def scene_of(
    radar: Radar, targets: list[dict[str, Any]], look: Look, pattern: dict[str, Any]
) -> dict[str, Any]:
    """The scene of a look; ``pattern`` has the keys of the array's pattern."""
    return {
        "name": "radarsimpy",
        "seed": look.seed,
        "radar": _radar(radar, look, pattern),
        # Nothing is detected, and the defaults leave short chirps without cells for it.
        "dsp": {"guard_cells": [0, 0]},
        "fidelity": {"accuracy_db": -20.0},
        "target": [_target(radar, target, index, look.time_s) for index, target in enumerate(targets)],
    }


def channels_of(radar: Radar, transmitters: list[int]) -> NDArray[np.int64]:
    """Channels of the scene's cube that are those of these transmitters with every receiver."""
    receive = radar.radar_prop["receiver"].antennas
    row = len(_centred(receive.locations - _middle(radar, transmitters)))
    return np.array([i * row + j for i in range(len(transmitters)) for j in range(len(receive))])


def _middle(radar: Radar, transmitters: list[int]) -> NDArray[np.float64]:
    """Mean place of transmitters, which a scene puts at the place of its radar."""
    places: NDArray[np.float64] = radar.radar_prop["transmitter"].antennas.locations[transmitters]
    middle: NDArray[np.float64] = places.mean(axis=0)
    return middle


def _radar(radar: Radar, look: Look, pattern: dict[str, Any]) -> dict[str, Any]:
    transmitter, receiver = radar.radar_prop["transmitter"], radar.radar_prop["receiver"]
    waveform, rate = transmitter.waveform_prop, receiver.bb_prop["fs"]
    samples = radar.sample_prop["samples_per_pulse"]
    sweep, length = waveform["f"], waveform["pulse_length"]
    slope = (sweep[1] - sweep[0]) / length
    half_wave = 0.5 * _C_MPS / (sweep[0] + 0.5 * slope * samples / rate)
    middle = _middle(radar, look.transmitters)
    transmit = _half_waves(transmitter.antennas.locations[look.transmitters] - middle, half_wave)
    receive = _half_waves(_centred(receiver.antennas.locations - middle), half_wave)
    gaps = 1e6 * np.array(look.gaps_s or [waveform["prp"][0]])
    polarization = receiver.antennas.polarization() + transmitter.antennas.polarization()
    told: dict[str, Any] = {
        "position_m": _of_scene(middle),
        "waveform": {
            "start_frequency_ghz": sweep[0] / 1e9,
            "slope_mhz_per_us": slope / 1e12,
            "sample_rate_msps": rate / 1e6,
            "samples": samples,
            "idle_us": max(0.0, float(gaps.min()) - 1e6 * samples / rate),
            "chirps": waveform["pulses"],
        },
        "array": {
            "tx_half_wavelengths": transmit,
            "rx_half_wavelengths": receive,
            "polarization": polarization,
            **pattern,
        },
        "link": {"transmit_power_dbm": float(transmitter.rf_prop["tx_power"]), "antenna_gain_dbi": 0.0},
        "receiver": {"sampling": receiver.bb_prop["bb_type"]},
    }
    if look.gaps_s:
        told["array"]["multiplexing"] = "tdm"
        if not np.allclose(gaps, gaps[0], rtol=1e-9, atol=0.0):
            told["waveform"]["stagger_us"] = (gaps - gaps.min()).tolist()
    if transmitter.rf_prop["pn_f"] is not None:
        offsets, levels = transmitter.rf_prop["pn_f"], transmitter.rf_prop["pn_power"]
        told["receiver"]["phase_noise_dbc_hz"] = [[float(f), float(p)] for f, p in zip(offsets, levels)]
    return told


def _centred(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places about the radar's own: a scene puts the mean of a row there, so a row with another mean gets its
    mirror image, whose channels are left out afterwards."""
    extent = np.max(np.abs(places), initial=0.0)
    is_centred = np.all(np.abs(places.mean(axis=0)) <= 1e-9 * extent)
    return places if is_centred else np.concatenate([places, -places])


def _half_waves(places: NDArray[np.float64], half_wave: float) -> list[list[float]]:
    return [[-y / half_wave, z / half_wave] for _, y, z in places]


def _seen(
    radar: Radar, target: dict[str, Any], time_s: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Place and velocity of a target as the radar has them, in RadarSimPy's axes."""
    place = vector(target.get("location", (0, 0, 0)), "target['location']") - radar.radar_prop["location"]
    speed = vector(target.get("speed", (0, 0, 0)), "target['speed']") - radar.radar_prop["speed"]
    yaw = radar.radar_prop["rotation"][0]
    turn = np.array([[np.cos(yaw), np.sin(yaw), 0], [-np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    return turn @ (place + speed * time_s), turn @ speed


def _of_scene(place: NDArray[np.float64]) -> list[float]:
    x, y, z = place.tolist()
    return [-y, x, z]


def _target(radar: Radar, target: dict[str, Any], index: int, time_s: float) -> dict[str, Any]:
    place, speed = _seen(radar, target, time_s)
    moving = {"id": f"target-{index}", "velocity_mps": _of_scene(speed)}
    if "model" not in target:
        refuse_keys(target, _POINT, "target")
        needed(target, "location", "target")
        turn = np.mod(np.asarray(target.get("phase", 0), dtype=float), 360)
        nothing(turn, "target['phase']", "a point scatters +√rcs")
        return {
            **moving,
            "kind": "point",
            "rcs_m2": 10 ** (number(needed(target, "rcs", "target"), "target['rcs']") / 10),
            "position_m": _of_scene(place),
        }
    return {**moving, **_mesh(radar, target, place)}


def _mesh(radar: Radar, target: dict[str, Any], place: NDArray[np.float64]) -> dict[str, Any]:
    """A body: a scene places the middle of its foot, RadarSimPy the origin of its file."""
    from wayside import mesh_bounds_m

    yaw_deg = yaw_of(target) - np.degrees(radar.radar_prop["rotation"][0])
    scale = scale_of(target)
    low, high = mesh_bounds_m(model_of(target), scale)
    middle = np.array([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), low[2]])
    yaw = np.radians(yaw_deg)
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    # A body's yaw is from world +x towards +y; their x axis is a scene's y axis.
    told = {"kind": "mesh", "model": os.path.abspath(model_of(target)), "yaw_deg": float(yaw_deg + 90.0)}
    told["position_m"] = _of_scene(place + turn @ middle)
    return told if scale is None else {**told, "unit_scale": scale}


def model_of(target: dict[str, Any]) -> str:
    """Path of a body's file."""
    model = needed(target, "model", "target")
    if not isinstance(model, (str, os.PathLike)):
        raise refuse("target['model']", f"a path is needed, is {model!r}")
    return os.fspath(model)


def yaw_of(target: dict[str, Any]) -> float:
    """Yaw of a body, degrees; what else a target may say and a scene may not is refused."""
    refuse_keys(target, _MESH, "target")
    turned = vector(target.get("rotation", (0, 0, 0)), "target['rotation']")
    nothing(turned[1:], "target['rotation']", "pitch and roll; yaw is taken")
    nothing(target.get("rotation_rate"), "target['rotation_rate']", "a scene turns velocity with the body: yaw_rate_dps")
    nothing(target.get("origin"), "target['origin']", "move the mesh itself")
    if target.get("permittivity") is not None:
        raise refuse("target['permittivity']", "name a material in [[material]] of a scene")
    if target.get("skip_diffusion"):
        raise refuse("target['skip_diffusion']", "a road is [road] of a scene")
    return float(turned[0])


def scale_of(target: dict[str, Any]) -> float | None:
    """Metres in a unit of the model's file; None of metres."""
    unit = target.get("unit", "m")
    if unit not in _UNITS:
        raise refuse("target['unit']", f"{unit!r}; it is one of {', '.join(_UNITS)}")
    return None if unit == "m" else _UNITS[unit]
