"""A script for RadarSimPy after one changed import: its public FMCW example with three point targets."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from wayside.compat import radarsimpy
from wayside.compat.radarsimpy import (
    NotSupported,
    Radar,
    Receiver,
    Transmitter,
    processing,
    sim_radar,
    sim_rcs,
)

C_MPS = 299_792_458.0

TARGETS = [
    {"location": (200, 0, 0), "speed": (-5, 0, 0), "rcs": 20, "phase": 0},
    {"location": (95, 20, 0), "speed": (-50, 0, 0), "rcs": 15, "phase": 0},
    {"location": (30, -5, 0), "speed": (-22, 0, 0), "rcs": 5, "phase": 0},
]


def fmcw_radar(**changes: Any) -> Radar:
    """The radar of the example: 24.125 GHz, 100 MHz in 80 µs, 256 pulses every 100 µs, 2 MHz."""
    angle = np.arange(-90, 91, 1)
    pattern = 20 * np.log10(np.cos(angle / 180 * np.pi) + 0.01) + 6
    channel = {
        "location": (0, 0, 0),
        "azimuth_angle": angle,
        "azimuth_pattern": pattern,
        "elevation_angle": angle,
        "elevation_pattern": pattern,
    }
    tx = Transmitter(
        f=[24.125e9 - 50e6, 24.125e9 + 50e6], t=80e-6, tx_power=10, prp=100e-6, pulses=256, channels=[channel]
    )
    rx = Receiver(
        fs=2e6, noise_figure=12, rf_gain=20, load_resistor=500, baseband_gain=30, channels=[channel]
    )
    return Radar(transmitter=tx, receiver=rx, **changes)


def windows(radar: Radar) -> tuple[Any, Any]:
    return np.hanning(radar.sample_prop["samples_per_pulse"]), np.hanning(256)


def test_the_fmcw_example_has_its_targets_in_the_cells_that_its_page_names() -> None:
    radar = fmcw_radar()
    data = sim_radar(radar, TARGETS)
    assert data["baseband"].shape == data["noise"].shape == data["timestamp"].shape == (1, 256, 160)
    rwin, dwin = windows(radar)
    power = np.abs(processing.range_doppler_fft(data["baseband"], rwin, dwin)[0])
    waveform = radar.radar_prop["transmitter"].waveform_prop
    range_cell_m = C_MPS / (2 * waveform["bandwidth"])
    span_mps = C_MPS / waveform["prp"][0] / 24.125e9 / 2
    for target in TARGETS:
        x, y, _ = target["location"]
        range_m, velocity_mps = np.hypot(x, y), target["speed"][0] * x / np.hypot(x, y)
        # The page's axes: range from 0, velocity from −span to 0. The middle of the frame, 12.8 ms on, and
        # the coupling of range and Doppler, v·f_c·T/B, belong to where an echo shows.
        shown_m = range_m + velocity_mps * (12.8e-3 + 24.125e9 * 80e-6 / 100e6)
        cell, row = shown_m / range_cell_m, (span_mps + velocity_mps) / span_mps * 256
        near = power[round(row) - 3 : round(row) + 4, round(cell) - 3 : round(cell) + 4]
        top = np.array(np.unravel_index(np.argmax(near), near.shape)) - 3
        assert np.all(np.abs(top - (row - round(row), cell - round(cell))) <= 1), (target, top)
        assert near.max() > 100 * np.median(power)


def test_echoes_are_peaks_of_the_radar_equations_volts() -> None:
    radar = fmcw_radar()
    baseband = sim_radar(radar, TARGETS[:1])["baseband"]
    wavelength_m = C_MPS / 24.125e9
    gain = 10 ** (2 * (6 + 20 * np.log10(1.01)) / 10)
    received_w = 0.01 * gain * 100 * wavelength_m**2 / ((4 * np.pi) ** 3 * 200.0**4)
    volts = np.sqrt(2 * received_w * 500 * 1e5)
    # 0.13 m nearer at the frame's end: 0.13 % of the amplitude; single precision behind it.
    assert np.allclose(np.abs(baseband), volts, rtol=2e-3)


def test_noise_is_that_of_the_receiver() -> None:
    radar = fmcw_radar(seed=3)
    noise = sim_radar(radar, [])["noise"]
    power_w = 1.380649e-23 * 290 * 2e6 * 10 ** (12 / 10) * 1e5 * 500
    # The mean of 40,960 exponential values: 4 σ are 2 %.
    assert np.mean(np.abs(noise) ** 2) == pytest.approx(power_w, rel=4 / np.sqrt(noise.size))
    assert np.array_equal(noise, sim_radar(radar, [])["noise"])


def test_channels_are_transmitter_by_transmitter_and_their_delays_are_kept() -> None:
    half = C_MPS / 77e9 / 2
    tx = Transmitter(
        f=[76.9e9, 77.1e9],
        t=20e-6,
        tx_power=10,
        prp=60e-6,
        pulses=16,
        channels=[{"location": (0, 0, 0)}, {"location": (0, 2 * half, 0), "delay": 30e-6}],
    )
    rx = Receiver(fs=4e6, channels=[{"location": (0, 0, 0)}, {"location": (0, half, 0)}])
    radar = Radar(transmitter=tx, receiver=rx, time=[0, 1.0])
    target = {"location": (40, 10, 0), "speed": (-6, 0, 0), "rcs": 10}
    data = sim_radar(radar, [target])
    assert data["baseband"].shape == (8, 16, 80)
    assert data["timestamp"][2, 0, 0] == 30e-6
    assert data["timestamp"][4, 0, 0] == 1.0
    for channel, stamp in enumerate(data["timestamp"]):
        exact = _if_of_point(radar, target, channel % 4, stamp)
        error = np.linalg.norm(data["baseband"][channel] - exact) / np.linalg.norm(exact)
        # An echo is summed to −20 dB and better.
        assert 20 * np.log10(error) < -20, (channel, 20 * np.log10(error))


def _if_of_point(radar: Radar, target: dict[str, Any], channel: int, stamp: Any) -> Any:
    """IF of a point by docs/interface.md, term by term, at the times of the samples."""
    transmitter, receiver = radar.radar_prop["transmitter"], radar.radar_prop["receiver"]
    sent = transmitter.txchannel_prop["locations"][channel // 2]
    heard = receiver.rxchannel_prop["locations"][channel % 2]
    place = np.array(target["location"]) + stamp[..., None] * np.array(target["speed"])
    there, back = (np.linalg.norm(place - p, axis=-1) for p in (sent, heard))
    tau, waveform = (there + back) / C_MPS, transmitter.waveform_prop
    slope = waveform["bandwidth"] / waveform["pulse_length"]
    t = np.arange(stamp.shape[1]) / receiver.bb_prop["fs"]
    wavelength = C_MPS / np.mean(waveform["f"])
    # An echo's power is that of its effective value, its baseband sample a peak: twice the power.
    power = 2 * 0.01 * 10 * wavelength**2 / ((4 * np.pi) ** 3 * there**2 * back**2)
    level = np.sqrt(power) * receiver.volts()
    return level * np.exp(2j * np.pi * (waveform["f"][0] * tau + slope * t * tau - 0.5 * slope * tau**2))


def test_a_plate_has_the_cross_section_of_its_area(tmp_path: Path) -> None:
    plate = tmp_path / "plate.obj"
    plate.write_text("v 0 -100 -150\nv 0 100 -150\nv 0 100 150\nv 0 -100 150\nf 1 2 3 4\n")
    target = {"model": str(plate), "unit": "mm"}
    level = 4 * np.pi * (0.06 * 77e9 / C_MPS) ** 2
    # Asked for −40 dB: 1 % of the amplitude, 2 % of the power.
    assert sim_rcs([target], 77e9, 0, 90) == pytest.approx(level, rel=0.02)
    turned = sim_rcs([{**target, "rotation": (30, 0, 0)}], 77e9, [30, 40], [90, 90])
    assert turned[0] == pytest.approx(level, rel=0.02)
    assert turned[1] < 0.01 * level


def test_a_mesh_stands_where_its_file_says(tmp_path: Path) -> None:
    plate = tmp_path / "plate.obj"
    plate.write_text("v 0 -0.1 -0.15\nv 0 0.1 -0.15\nv 0 0.1 0.15\nv 0 -0.1 0.15\nf 1 2 3 4\n")
    tx = Transmitter(f=[76.5e9, 77.5e9], t=50e-6, tx_power=10, pulses=2)
    radar = Radar(transmitter=tx, receiver=Receiver(fs=4e6))
    data = sim_radar(radar, [{"model": str(plate), "location": (24, 0, 0)}], density=0.5, level="pulse")
    spectrum = np.abs(processing.range_fft(data["baseband"])[0, 0])
    # c/2B of the sweep is 0.15 m.
    assert np.argmax(spectrum) == pytest.approx(24 / (C_MPS / 2e9), abs=1)


def noisy_radar(**changes: Any) -> Radar:
    """A radar with strong phase noise, whose two transmitters send 60 µs apart."""
    place = (0, 0, 0)
    tx = Transmitter(
        f=[76.5e9, 77.5e9],
        t=50e-6,
        tx_power=10,
        prp=120e-6,
        pulses=4,
        pn_f=[1e6, 1e3, 1e4, 1e5],
        pn_power=[-90, -65, -70, -75],
        channels=[{"location": place}, {"location": place, "delay": 60e-6}],
    )
    return Radar(transmitter=tx, receiver=Receiver(fs=4e6), **changes)


def test_phase_noise_is_drawn_anew_for_every_frame() -> None:
    target = {"location": (60, 0, 0), "rcs": 10}
    drawn = sim_radar(noisy_radar(seed=1, frame_time=[0, 0.5]), [target])["baseband"]
    again = sim_radar(noisy_radar(seed=1, frame_time=[0, 0.5]), [target])["baseband"]
    assert np.array_equal(drawn, again)
    apart = [np.linalg.norm(drawn[i] - drawn[j]) for i in range(4) for j in range(i)]
    # Each is 11 % beside the echo without noise; two that are independent are more than half of that apart,
    # and so are an oscillator's moments 60 µs apart.
    assert min(apart) > 0.05 * np.linalg.norm(drawn[0])


def slow_radar(delays: list[float], **changes: Any) -> Radar:
    """A radar whose phase noise is slower than its transmitters' delays."""
    tx = Transmitter(
        f=[76.5e9, 77.5e9],
        t=50e-6,
        tx_power=10,
        prp=200e-6,
        pulses=32,
        channels=[{"location": (0, 0.01 * i, 0), "delay": delay} for i, delay in enumerate(delays)],
        **changes,
    )
    return Radar(transmitter=tx, receiver=Receiver(fs=4e6), seed=2)


@pytest.mark.parametrize("delays", [[0, 60e-6], [70e-6, 0, 70e-6]])
def test_one_oscillator_drives_transmitters_of_all_delays(delays: list[float]) -> None:
    target = {"location": (60, 3, 0), "speed": (-4, 1, 0), "rcs": 10}
    noise = {"pn_f": [500, 1e3, 2e3], "pn_power": [-10, -10, -190]}
    drawn = sim_radar(slow_radar(delays, **noise), [target])["baseband"]
    clean = sim_radar(slow_radar(delays), [target])["baseband"]
    turns = np.angle(drawn / clean)
    assert np.std(turns) > 1e-3, "there is noise"
    # The noise ends at 1.1 kHz, of which 70 µs are a thirteenth of a turn: its cosine is 0.88, that of slower
    # parts 1. Of two oscillators it is 0.08.
    likeness = np.corrcoef(turns.reshape(len(delays), -1))
    assert likeness.min() > 0.85, likeness


def test_pulses_with_phase_noise_that_are_sampled_at_once_are_refused() -> None:
    noise = {"pn_f": [1e3], "pn_power": [-60]}
    with pytest.raises(NotImplementedError, match="pn_f"):
        sim_radar(slow_radar([0, 20e-6], **noise), [TARGETS[2]])
    assert sim_radar(slow_radar([0, 20e-6]), [TARGETS[2]])["baseband"].shape == (2, 32, 200)


def test_without_a_seed_noise_is_another_each_time() -> None:
    first, second = (sim_radar(noisy_radar(), [{"location": (60, 0, 0), "rcs": 10}]) for _ in range(2))
    assert not np.array_equal(first["baseband"], second["baseband"])
    assert not np.array_equal(first["noise"], second["noise"])


def test_a_radar_of_few_samples_is_taken() -> None:
    tx = Transmitter(f=[76.5e9, 77.5e9], t=8 / 4e6)
    radar = Radar(tx, Receiver(fs=4e6, bb_type="real"))
    assert sim_radar(radar, [TARGETS[2]])["baseband"].shape == (1, 1, 8)


@pytest.mark.parametrize(
    ("target", "name"),
    [
        ({"location": (np.nan, 3, 0), "rcs": 10}, "location"),
        ({"location": (10, np.nan, 0), "rcs": 10}, "location"),
        ({"location": (-30, 3, 0), "rcs": 10, "foo": 3}, "foo"),
        ({"location": (-30, 3, 0), "rcs": 10, "phase": 40}, "phase"),
        ({"location": (-30, 3, 0)}, "rcs"),
        ({"location": (-30, 3, 0), "rcs": 10, "speed": (np.inf, 0, 0)}, "speed"),
        ({"location": (0, 0, 0), "rcs": 10}, "target-0"),
    ],
)
def test_targets_are_checked_wherever_they_are(target: dict[str, Any], name: str) -> None:
    with pytest.raises(Exception, match=name):
        sim_radar(fmcw_radar(), [target])


def test_codes_that_change_nothing_are_taken() -> None:
    place = {"location": (0, 0, 0)}
    neutral = {"pulse_amp": [1, 1], "pulse_phs": [0, 360], "mod_t": [0, 1e-6], "amp": [1, 1], "phs": [0, 0]}
    plain, coded = (
        sim_radar(Radar(chirps(pulses=2, channels=[{**place, **code}]), Receiver(fs=4e6)), [target])
        for code, target in (({}, TARGETS[2]), (neutral, {**TARGETS[2], "phase": 360}))
    )
    assert np.array_equal(plain["baseband"], coded["baseband"])


def test_a_name_that_is_none_of_theirs_is_no_attribute() -> None:
    assert not hasattr(radarsimpy, "sim_sonar")


def chirps(**changes: Any) -> Transmitter:
    return Transmitter(**({"f": [76e9, 77e9], "t": 20e-6} | changes))


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: chirps(pulses=0), "pulses: must be a whole number of 1 or more, is 0"),
        (lambda: chirps(pulses=1.5), "pulses"),
        (lambda: chirps(t=0), "t: must be above 0"),
        (lambda: chirps(f=[76e9, np.nan]), "f: must be finite"),
        (lambda: chirps(tx_power=np.nan), "tx_power"),
        (lambda: chirps(channels=[]), "tx channel: at least one is needed"),
        (lambda: chirps(channels=[{"location": (0, 0, 0), "delay": np.nan}]), "delay"),
        (lambda: chirps(channels=[{"location": (0, np.nan, 0)}]), "location"),
        (lambda: chirps(pn_f=[1e3, 1e4], pn_power=[-80]), "different lengths, 2 and 1"),
        (lambda: Receiver(fs=0), "fs: must be above 0"),
        (lambda: Receiver(fs=4e6, load_resistor=-1), "load_resistor: must be above 0, is -1"),
        (lambda: Receiver(fs=4e6, channels=[]), "rx channel: at least one"),
        (lambda: fmcw_radar(frame_time=np.nan), "frame_time: must be finite"),
        (lambda: fmcw_radar(frame_time=[]), "frame_time"),
        (lambda: fmcw_radar(frame_time=[0], time=[0]), "frame_time and time"),
        (lambda: fmcw_radar(location=(np.nan, 0, 0)), "location"),
        (lambda: fmcw_radar(rotation=(np.nan, 0, 0)), "rotation"),
        (lambda: fmcw_radar(seed=-1), "seed: must be 0 or more, is -1"),
        (lambda: sim_radar(fmcw_radar(), [], level="nonsense"), "level"),
        (lambda: sim_radar(fmcw_radar(), [], frame_time=np.inf), "frame_time"),
        (lambda: sim_radar(fmcw_radar(), TARGETS[0]), "targets: a list of dictionaries"),
        (lambda: sim_radar(fmcw_radar(), [TARGETS]), r"targets\[0\]: a dictionary"),
        (lambda: sim_radar(fmcw_radar(), [{"location": (9, 0, 0)}]), r"target\['rcs'\]: is needed"),
        (lambda: sim_radar(fmcw_radar(), [{**TARGETS[0], "rcs": None}]), r"target\['rcs'\]: is needed"),
        (lambda: sim_radar(fmcw_radar(), [{**TARGETS[0], "rcs": "a"}]), r"target\['rcs'\]: must be a number"),
        (lambda: sim_radar(fmcw_radar(), [{"rcs": 20}]), r"target\['location'\]: is needed"),
        (lambda: chirps(channels=[{"delay": 0}]), r"tx channel\['location'\]: is needed"),
        (lambda: chirps(channels={"location": (0, 0, 0)}), "tx channel: a list of dictionaries"),
        (lambda: chirps(pulses=2, prp=[3e-5] * 3), "prp: one number is needed, or 2"),
        (lambda: chirps(tx_power="strong"), "tx_power: must be a number, is 'strong'"),
        (lambda: Receiver(fs=4e6, channels=[{}]), r"rx channel\['location'\]: is needed"),
        (lambda: sim_rcs([{}], 77e9, 0, 90), r"target\['model'\]: is needed"),
        (lambda: sim_rcs({"model": "a.stl"}, 77e9, 0, 90), "targets: a list of dictionaries"),
        (lambda: sim_rcs([{"model": "a.stl"}], 77e9, np.nan, 90), "phi: must be finite"),
    ],
)
def test_a_value_that_is_none_is_refused_by_its_name(call: Any, name: str) -> None:
    with pytest.raises(ValueError, match=name):
        call()


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: Transmitter(f=24e9, t=1e-6), "f"),
        (lambda: Transmitter(f=[1e9, 2e9, 3e9], t=[0, 1e-6, 2e-6]), "f"),
        (lambda: Transmitter(f=[1e9, 2e9], t=1e-6, pulses=2, prp=[1e-6, 2e-6]), "prp"),
        (
            lambda: Transmitter(f=[1e9, 2e9], t=1e-6, channels=[{"location": (0, 0, 0), "pulse_phs": [90]}]),
            "pulse_phs",
        ),
        (lambda: Receiver(fs=1e6, channels=[{"location": (0, 0, 0), "gain": 3}]), "gain"),
        (lambda: fmcw_radar(rotation=(0, 10, 0)), "rotation"),
        (lambda: fmcw_radar(rotation_rate=(1, 0, 0)), "rotation_rate"),
        (lambda: sim_radar(fmcw_radar(), [], interf=fmcw_radar()), "interf"),
        (lambda: sim_radar(fmcw_radar(), [{**TARGETS[0], "phase": 30}]), "phase"),
        (
            lambda: sim_radar(fmcw_radar(), [{**TARGETS[0], "location": (np.zeros((1, 256, 160)), 0, 0)}]),
            "location",
        ),
        (lambda: sim_rcs([{"model": "a.stl", "permittivity": 3 + 1j}], 77e9, 0, 90), "permittivity"),
        (lambda: processing.cfar_ca_2d, "cfar_ca_2d"),
        (
            lambda: sim_radar(fmcw_radar(), [{**TARGETS[0], "rcs": np.full((1, 256, 160), 20)}]),
            r"target\['rcs'\]: not supported",
        ),
        (lambda: chirps(tx_power=[10, 11]), "tx_power: not supported"),
        (lambda: chirps(pulses=2, channels=[{"location": (0, 0, 0), "pulse_amp": [1, 0]}]), "pulse_amp"),
        (lambda: Receiver(fs=[1e6, 2e6]), "fs: not supported"),
        (lambda: fmcw_radar(location=3), "location: not supported"),
        (lambda: sim_rcs([{"model": "a.stl"}], [76e9, 77e9], 0, 90), "f: not supported"),
        (lambda: sim_rcs([{"model": 3}], 77e9, 0, 90), "model"),
        (lambda: radarsimpy.sim_lidar, "sim_lidar: not supported"),
        (lambda: radarsimpy.tools, "tools: not supported"),
        (lambda: radarsimpy.rt, "rt: not supported"),
    ],
)
def test_what_is_not_supported_is_refused_by_its_name(call: Any, name: str) -> None:
    with pytest.raises(NotSupported, match=name):
        call()
