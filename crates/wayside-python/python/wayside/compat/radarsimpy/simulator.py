"""Functions ``sim_radar`` and ``sim_rcs``."""

from __future__ import annotations

import os
import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .radar import Radar
from .refusal import refuse
from .scene import channels_of, in_front, scale_of, scene_of, yaw_of

_UPRIGHT = (0, 0, 1)
# Of a sine's root mean square: the samples that RadarSimPy's own tests expect are peaks
# (tests/test_module_sim_radar_ideal.py, 15.3.0).
_PEAK = 2**0.5


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
    del density, level, debug
    for name, value in (("interf", interf), ("ray_filter", ray_filter), ("log_path", log_path)):
        if value is not None:
            raise refuse(name, "[[interferer]] of a scene" if name == "interf" else "no rays are shot here")
    if back_propagating:
        raise refuse("back_propagating", "ways back are always among the paths")
    del interf_frame_time
    if frame_time is not None:
        starts = np.atleast_1d(np.asarray(frame_time, dtype=float))
        timestamp = np.concatenate([radar.time_prop["origin_timestamp"] + start for start in starts])
    else:
        starts, timestamp = radar.time_prop["frame_start_time"], radar.time_prop["timestamp"]
    frames = [_frame(radar, targets, float(start)) for start in starts]
    baseband = np.concatenate(frames)
    return {
        "baseband": baseband,
        "noise": _noise(radar, timestamp.shape),
        "timestamp": timestamp,
        "interference": None,
    }


def _frame(radar: Radar, targets: list[dict[str, Any]], start_s: float) -> NDArray[Any]:
    """Baseband of one frame, [tx·rx, pulses, samples]: transmitters that begin together are one scene."""
    transmitter, receiver = radar.radar_prop["transmitter"], radar.radar_prop["receiver"]
    receivers, delays = len(receiver.antennas), transmitter.txchannel_prop["delay"]
    shape = radar.time_prop["origin_timestamp_shape"]
    whole = np.zeros(shape, dtype=np.complex128)
    for delay in np.unique(delays):
        together = [int(i) for i in np.flatnonzero(delays == delay)]
        samples = _samples(radar, targets, together, start_s + float(delay))
        for at, transmit in enumerate(together):
            part = samples[at * receivers : (at + 1) * receivers]
            whole[transmit * receivers : (transmit + 1) * receivers] = _PEAK * receiver.volts() * part
    return whole if receiver.bb_prop["bb_type"] == "complex" else whole.real


def _samples(
    radar: Radar, targets: list[dict[str, Any]], transmitters: list[int], time_s: float
) -> NDArray[np.complex64]:
    from wayside import Scene

    seen = [target for target in targets if in_front(radar, target, time_s)]
    with tempfile.TemporaryDirectory(prefix="wayside-") as folder:
        scene = Scene(scene_of(radar, seen, transmitters, time_s, folder))
        samples: NDArray[np.complex64] = scene.echo().samples[0]
    return samples[channels_of(radar, transmitters)]


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
        _cross_section(target, f, yaw, sent, None if is_monostatic else heard, polarization)
        for sent, heard in pairs
    ]
    return values[0] if len(values) == 1 else np.array(values)


def _cross_section(
    target: dict[str, Any], f: float, yaw: float, sent: list[float], heard: list[float] | None, pol: str
) -> float:
    from wayside import rcs

    table = rcs(
        os.fspath(target["model"]),
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
    return np.stack([azimuths, angles], axis=-1)


def _letter(polarization: Any, name: str) -> str:
    if np.array_equal(np.asarray(polarization, dtype=complex), _UPRIGHT):
        return "v"
    raise refuse(name, '[0, 0, 1], vertical; wayside.rcs has pol = "hh", "vh", "hv"')
