"""Functions ``sim_radar`` and ``sim_rcs``."""

from __future__ import annotations

import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .pattern import pattern_of
from .radar import Radar, times
from .refusal import dictionaries, finite, number, refuse
from .scene import Look, channels_of, model_of, scale_of, scene_of, yaw_of

_UPRIGHT = (0, 0, 1)
# Of a sine's root mean square: the samples that RadarSimPy's own tests expect are peaks
# (tests/test_module_sim_radar_ideal.py, 15.3.0).
_PEAK = 2**0.5
_LEVELS = (None, "frame", "pulse", "sample")
# Seeds of scenes have 63 bits.
_SEED_BITS_LESS = 1


def sim_radar(
    radar: Radar,
    targets: list[dict[str, Any]],
    density: float = 1,
    level: str | None = None,
    interf: Any = None,
    interf_frame_time: Any = None,
    ray_filter: Any = None,
    back_propagating: bool = False,
    log_path: str | None = None,
    debug: bool = False,
    *,
    frame_time: Any = None,
) -> dict[str, Any]:
    """Baseband of point and mesh targets, as RadarSimPy gives it.

    Returns ``baseband``, ``noise``, ``timestamp`` of shape [frames·tx·rx, pulses, samples] (frame, then
    transmitter, then receiver) and ``interference``, None. Samples are in volts: an echo by its peak, the
    noise by its root mean square. ``density`` and ``level`` set rays there; here nothing is sampled, and they
    have no meaning. ``frame_time`` is where a frame begins, as before 15.1.0; the radar's own where it is
    left out.
    """
    del density, debug
    targets = dictionaries(targets, "targets")
    if level not in _LEVELS:
        raise ValueError(f"level: must be None, 'frame', 'pulse' or 'sample', is {level!r}")
    for name, value in (("interf", interf), ("ray_filter", ray_filter), ("log_path", log_path)):
        if value is not None:
            raise refuse(name, "[[interferer]] of a scene" if name == "interf" else "no rays are shot here")
    if back_propagating:
        raise refuse("back_propagating", "ways back are always among the paths")
    del interf_frame_time
    if frame_time is not None:
        starts = times(frame_time)
        timestamp = np.concatenate([radar.time_prop["origin_timestamp"] + start for start in starts])
    else:
        starts, timestamp = radar.time_prop["frame_start_time"], radar.time_prop["timestamp"]
    return {
        "baseband": _baseband(radar, targets, starts),
        "noise": _noise(radar, timestamp.shape),
        "timestamp": timestamp,
        "interference": None,
    }


def _baseband(radar: Radar, targets: list[dict[str, Any]], starts: NDArray[np.float64]) -> NDArray[Any]:
    """Baseband of all frames; each frame draws phase noise of its own."""
    seeds = np.random.SeedSequence(radar.seed)
    with tempfile.TemporaryDirectory(prefix="wayside-") as folder:
        pattern = pattern_of(radar, folder)
        frames = [_frame(radar, targets, float(start), pattern, seeds.spawn(1)[0]) for start in starts]
    baseband = np.concatenate(frames)
    return baseband if radar.radar_prop["receiver"].bb_prop["bb_type"] == "complex" else baseband.real


def _frame(
    radar: Radar,
    targets: list[dict[str, Any]],
    start_s: float,
    pattern: dict[str, Any] | None,
    seeds: np.random.SeedSequence,
) -> NDArray[Any]:
    """Baseband of one frame, [tx·rx, pulses, samples]: each look is one scene."""
    receiver = radar.radar_prop["receiver"]
    whole = np.zeros(radar.time_prop["origin_timestamp_shape"], dtype=np.complex128)
    seed = int(seeds.generate_state(1, np.uint64)[0]) >> _SEED_BITS_LESS
    for look in _looks(radar, start_s, seed):
        transmitters, count = look.transmitters, len(receiver.antennas)
        channels = [i * count + j for i in transmitters for j in range(count)]
        whole[channels] = _PEAK * receiver.volts() * _samples(radar, targets, look, pattern)
    return whole


def _looks(radar: Radar, start_s: float, seed: int) -> list[Look]:
    """Looks of a frame: a delay each, its transmitters together; with phase noise one transmitter of each
    delay, in turn: one oscillator drives them all, and a scene draws one."""
    transmitter, rate = radar.radar_prop["transmitter"], radar.radar_prop["receiver"].bb_prop["fs"]
    delays, of_transmitter = np.unique(transmitter.txchannel_prop["delay"], return_inverse=True)
    together = [np.flatnonzero(of_transmitter == i).tolist() for i in range(len(delays))]
    if transmitter.rf_prop["pn_f"] is None or len(delays) == 1:
        return [Look(own, start_s + float(delay), seed) for own, delay in zip(together, delays)]
    gaps = np.diff(np.append(delays, delays[0] + transmitter.waveform_prop["prp"][0]))
    if gaps.min() < radar.sample_prop["samples_per_pulse"] / rate * (1 - 1e-9):
        raise refuse("pn_f", "with a delay at which one pulse is sampled before another ends: one oscillator")
    turns = [[own[min(i, len(own) - 1)] for own in together] for i in range(max(map(len, together)))]
    return [Look(turn, start_s + float(delays[0]), seed, gaps.tolist()) for turn in turns]


def _samples(
    radar: Radar, targets: list[dict[str, Any]], look: Look, pattern: dict[str, Any] | None
) -> NDArray[np.complex64]:
    from wayside import Scene

    scene = Scene(scene_of(radar, targets, look, pattern or {"pattern": "isotropic"}))
    samples: NDArray[np.complex64] = scene.echo().samples[0][channels_of(radar, look.transmitters)]
    return np.zeros_like(samples) if pattern is None else samples


def _noise(radar: Radar, shape: tuple[int, ...]) -> NDArray[Any]:
    draw, level = np.random.default_rng(radar.seed), radar.sample_prop["noise"]
    if radar.radar_prop["receiver"].bb_prop["bb_type"] == "real":
        real: NDArray[Any] = level * draw.standard_normal(shape)
        return real
    parts = draw.standard_normal((2, *shape))
    noise: NDArray[Any] = level * np.sqrt(0.5) * (parts[0] + 1j * parts[1])
    return noise


def sim_rcs(
    targets: list[dict[str, Any]],
    f: float,
    inc_phi: Any,
    inc_theta: Any,
    inc_pol: Any = _UPRIGHT,
    obs_phi: Any = None,
    obs_theta: Any = None,
    obs_pol: Any = None,
    density: float = 1,
) -> Any:
    """Radar cross section of a body in m², a number or one for each aspect, as RadarSimPy gives it.

    ``phi`` is the azimuth from x towards y, ``theta`` the angle from z, degrees, both of the antenna as
    seen from the body. ``density`` sets rays there and has no meaning here.
    """
    del density
    frequency_hz, targets = number(f, "f"), dictionaries(targets, "targets")
    if len(targets) != 1:
        raise refuse("targets", "one body; several stand in a scene")
    polarization = _letter(inc_pol if obs_pol is None else obs_pol, "obs_pol") + _letter(inc_pol, "inc_pol")
    target, incident = targets[0], _aspects(inc_phi, inc_theta)
    yaw = yaw_of(target)
    is_monostatic = obs_phi is None and obs_theta is None
    observed = (
        incident
        if is_monostatic
        else _aspects(inc_phi if obs_phi is None else obs_phi, inc_theta if obs_theta is None else obs_theta)
    )
    if incident.shape != observed.shape:
        raise ValueError("incident and observed angles have different lengths")
    pairs = zip(incident.tolist(), observed.tolist())
    values = [
        _cross_section(target, frequency_hz, yaw, sent, None if is_monostatic else heard, polarization)
        for sent, heard in pairs
    ]
    return values[0] if len(values) == 1 else np.array(values)


def _cross_section(
    target: dict[str, Any], f: float, yaw: float, sent: list[float], heard: list[float] | None, pol: str
) -> float:
    from wayside import rcs

    table = rcs(
        model_of(target),
        f / 1e9,
        sent[0] - yaw,
        90.0 - sent[1],
        pol=pol,
        unit_scale=scale_of(target),
        rx_az_deg=None if heard is None else heard[0] - yaw,
        rx_el_deg=None if heard is None else 90.0 - heard[1],
    )
    return float(np.abs(table.s_m[0, 0, 0]) ** 2)


def _aspects(phi: Any, theta: Any) -> NDArray[np.float64]:
    azimuths, angles = np.atleast_1d(np.asarray(phi, float)), np.atleast_1d(np.asarray(theta, float))
    if azimuths.shape != angles.shape:
        raise ValueError("phi and theta have different lengths")
    return np.stack([finite(azimuths, "phi"), finite(angles, "theta")], axis=-1)


def _letter(polarization: Any, name: str) -> str:
    if np.array_equal(np.asarray(polarization, dtype=complex), _UPRIGHT):
        return "v"
    raise refuse(name, '[0, 0, 1], vertical; wayside.rcs has pol = "hh", "vh", "hv"')
