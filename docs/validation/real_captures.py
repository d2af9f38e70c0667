"""NumPy's figures of the real capture of fixtures/captures, and the recording from what was published.

    python docs/validation/real_captures.py doppler_example_1.npy    writes room.bin (then room.numpy.*)
    python docs/validation/real_captures.py                          writes room.numpy.csv and room.numpy.npy
    python docs/validation/real_captures.py --out FOLDER             writes these two elsewhere

NumPy alone: no window but Hann's, FFTs over samples, chirps and the eight virtual elements.
`crates/wayside-python/tests/test_real_capture.py` compares figures made anew with those that are stored.
"""
import argparse
import pathlib

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "fixtures" / "captures"
LIGHT_MPS = 299792458.0
START_HZ, SLOPE, RATE_HZ, SAMPLES, CHIRPS, TX, RX = 77.42e9, 60e12, 2.5e6, 128, 128, 2, 4
# 30 µs idle and 62 µs of ramp, of each transmitter in turn.
INTERVAL_S = TX * 92e-6


def hann(count):
    """Periodic, of unit coherent gain."""
    taper = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(count) / count)
    return taper / taper.mean()


def write_recording(published):
    """[chirp][tx·4 + rx][sample] of uint16 in complex128 as a two-lane recording of 16-bit integers."""
    values = np.load(published)
    parts = [part.astype(np.uint16).view(np.int16) for part in (values.real, values.imag)]
    i, q = (part.reshape(CHIRPS * TX * RX, SAMPLES // 2, 2) for part in parts)
    np.concatenate([i, q], axis=2).astype("<i2").tofile(FOLDER / "room.bin")


def read_recording():
    """[tx·4 + rx, chirp, sample]."""
    pairs = np.fromfile(FOLDER / "room.bin", "<i2").reshape(CHIRPS, TX * RX, SAMPLES // 2, 2, 2)
    values = pairs[:, :, :, 0, :] + 1j * pairs[:, :, :, 1, :]
    return values.reshape(CHIRPS, TX * RX, SAMPLES).transpose(1, 0, 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("published", nargs="?")
    parser.add_argument("--out", type=pathlib.Path, default=FOLDER)
    asked = parser.parse_args()
    if asked.published:
        write_recording(asked.published)
    cube = read_recording()
    windowed = cube * hann(CHIRPS)[:, None] * hann(SAMPLES)
    maps = np.fft.fftshift(np.fft.fft2(windowed, axes=(1, 2)), axes=1)
    power = (np.abs(maps) ** 2).mean(axis=0) / (CHIRPS * SAMPLES) ** 2
    level_db = 10 * np.log10(power / 32768.0**2)
    np.save(asked.out / "room.numpy.npy", level_db.astype("<f4"))
    wavelength_m = LIGHT_MPS / (START_HZ + 0.5 * SLOPE * SAMPLES / RATE_HZ)
    cell_m = LIGHT_MPS / (2 * SLOPE * SAMPLES / RATE_HZ)
    cell_mps = wavelength_m / (2 * CHIRPS * INTERVAL_S)
    rows = [("echo", "range_m", "velocity_mps", "azimuth_deg", "level_dbfs", "coherence")]
    for name, (first_m, last_m), (slowest, fastest) in [
        ("still thing", (4.5, 6.0), (-0.1, 0.1)),
        ("walker who recedes", (2.5, 3.4), (0.3, 0.9)),
        ("walker who approaches", (2.5, 3.4), (-1.0, -0.3)),
    ]:
        ranges = np.arange(SAMPLES) * cell_m
        velocities = (np.arange(CHIRPS) - CHIRPS // 2) * cell_mps
        slow_enough = (velocities >= slowest) & (velocities <= fastest)
        inside = slow_enough[:, None] & (ranges >= first_m) & (ranges <= last_m)
        row, column = np.unravel_index(np.argmax(np.where(inside, power, 0)), power.shape)
        # The second transmitter's chirps are half a repetition later.
        later = np.exp(-2j * np.pi * 2 * velocities[row] / wavelength_m * INTERVAL_S / 2)
        values = maps[:, row, column] * np.r_[np.ones(RX), np.full(RX, later)]
        beam = np.abs(np.fft.ifft(values, 4096) * 4096)
        cycles = np.fft.fftfreq(4096)[np.argmax(beam)]
        coherence = beam.max() ** 2 / (TX * RX * (np.abs(values) ** 2).sum())
        azimuth_deg = np.degrees(np.arcsin(2 * cycles))
        numbers = f"{ranges[column]:.4f},{velocities[row]:.4f},{azimuth_deg:.3f},{level_db[row, column]:.3f}"
        rows.append((name, *numbers.split(","), f"{coherence:.4f}"))
    rows.append(("median of the map", "", "", "", f"{np.median(level_db):.3f}", ""))
    table = "".join(",".join(row) + "\n" for row in rows)
    text = f"# numpy {np.__version__}: docs/validation/real_captures.py\n{table}"
    (asked.out / "room.numpy.csv").write_text(text)
    print(text)


main()
