"""Range-Doppler, CFAR and angles by NumPy, SciPy and OpenRadar: prints `job|program|seconds` of the quickest run of half a second."""
import os, sys, time
try:
    import numpy as np
except ImportError:
    sys.exit(print("skipped: NumPy is not here"))
file, channels, chirps, samples, guard, training, candidates = sys.argv[1], *map(int, sys.argv[2:])
cube = np.fromfile(file, np.complex64).reshape(channels, chirps, samples)
hann = lambda n: np.hanning(n).astype(np.float32)
fast, slow = hann(samples), hann(chirps)[:, None]

def quickest(job, program, work, least=3):
    seconds, begin = [], time.perf_counter()
    while len(seconds) < least or time.perf_counter() - begin < 0.5:
        start = time.perf_counter()
        result = work()
        seconds.append(time.perf_counter() - start)
    print(f"{job}|{program}|{min(seconds)}")
    return result

def by_numpy():
    ranges = np.fft.fft(cube * fast, axis=2)
    return np.fft.fftshift(np.fft.fft(ranges * slow, axis=1), axes=1)
maps = quickest("range-Doppler", f"NumPy {np.__version__}", by_numpy)
power = (np.abs(maps) ** 2).sum(0).astype(np.float64)
side, hole = 2 * (guard + training) + 1, 2 * guard + 1

bins = 1 << (4 * channels - 1).bit_length()
rows, columns = np.divmod(np.arange(candidates), samples)
def numpy_angles():
    return np.abs(np.fft.fft(maps[:, rows, columns], bins, axis=0)).argmax(0)
quickest("angle FFT of 1000 cells", f"NumPy {np.__version__}", numpy_angles)

try:
    import scipy, scipy.fft, scipy.ndimage
    name, workers = f"SciPy {scipy.__version__}", os.cpu_count()
    def by_scipy():
        ranges = scipy.fft.fft(cube * fast, axis=2, workers=workers, overwrite_x=True)
        return scipy.fft.fftshift(scipy.fft.fft(ranges * slow, axis=1, workers=workers, overwrite_x=True), axes=1)
    quickest("range-Doppler", name, by_scipy)
    mean = lambda size: scipy.ndimage.uniform_filter(power, size, mode="wrap") * size * size
    def averages():
        return power > 20 * (mean(side) - mean(hole)) / (side * side - hole * hole)
    quickest("CA-CFAR", name + ", the same threshold in every cell", averages)
    ring = np.ones((side, side), bool)
    ring[training:-training, training:-training] = False
    rank = int(0.75 * ring.sum())
    def ordered():
        return power > 20 * scipy.ndimage.rank_filter(power, rank, footprint=ring, mode="wrap")
    quickest("OS-CFAR", name + ", the same threshold in every cell", ordered, 1)
except ImportError:
    print("skipped: SciPy is not here")

try:
    import mmwave.dsp as openradar
    window = openradar.utils.Window.HANNING
    chirp_first = np.ascontiguousarray(cube.transpose(1, 0, 2))
    def by_openradar():
        ranges = openradar.range_processing(chirp_first, window_type_1d=window)
        return np.fft.fftshift(np.fft.fft(ranges * np.hanning(chirps)[:, None, None], axis=0), axes=0)
    quickest("range-Doppler", "OpenRadar 1.0.1", by_openradar)
    levels = 10 * np.log10(power)
    def lines(cfar, **settings):
        return np.apply_along_axis(cfar, 1, levels, guard_len=guard, noise_len=training, **settings)
    quickest("CA-CFAR", "OpenRadar 1.0.1, along range alone", lambda: lines(openradar.ca_, l_bound=13))
    quickest("OS-CFAR", "OpenRadar 1.0.1, along range alone", lambda: lines(openradar.os_, k=9, scale=1.1), 1)
except Exception as reason:
    print(f"skipped: OpenRadar ({reason!r})")
print("skipped: RadarSimPy has no package for this system" if not __import__("importlib.util").util.find_spec("radarsimpy") else "")
