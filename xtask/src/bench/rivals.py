"""One job by one package: rivals.py JOB PACKAGE FOLDER WORDS…; reads FOLDER/input.raw, writes FOLDER/result.raw, prints `program|seconds`
of the quickest run. Ends with an error where the package is not installed."""
import os, sys, time
import numpy as np

job, package, folder, *words = sys.argv[1:]
raw = open(os.path.join(folder, "input.raw"), "rb").read()


def quickest(work, seconds=0.2, least=3):
    runs, begin = [], time.perf_counter()
    while len(runs) < least or time.perf_counter() - begin < seconds:
        start = time.perf_counter()
        result = work()
        runs.append(time.perf_counter() - start)
    return result, min(runs)


def hann(n):
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n)
    return (window / window.mean()).astype(np.float32)


def range_doppler():
    channels, chirps, samples = map(int, words[:3])
    cube = np.frombuffer(raw, np.complex64).reshape(channels, chirps, samples)
    fast, slow = hann(samples), hann(chirps)[:, None]
    if package == "scipy":
        import scipy.fft as fft
        more = dict(workers=os.cpu_count(), overwrite_x=True)
    else:
        fft, more = np.fft, {}
    return quickest(lambda: fft.fftshift(fft.fft(fft.fft(cube * fast, axis=2, **more) * slow, axis=1, **more), axes=1),
                    float(words[6]))


def detector(kind):
    import scipy.ndimage as image
    chirps, samples, guard, training = (int(words[i]) for i in (1, 2, 3, 4))
    factor = np.frombuffer(raw, np.float64, 1)[0]
    power = np.frombuffer(raw, np.float64, offset=8).reshape(chirps, samples)
    side, hole = 2 * (guard + training) + 1, 2 * guard + 1
    ring = np.ones((side, side), bool)
    ring[training:-training, training:-training] = False
    rank = int(np.ceil(0.75 * ring.sum())) - 1
    total = lambda size: image.uniform_filter(power, size, mode="wrap") * size * size
    def averages():
        return power > factor * (total(side) - total(hole)) / (side * side - hole * hole)
    def ordered():
        return power > factor * image.rank_filter(power, rank, footprint=ring, mode="wrap")
    mask, seconds = quickest(averages if kind == "ca-cfar" else ordered, float(words[6]), 3 if kind == "ca-cfar" else 1)
    return mask.astype(np.uint8), seconds


def angles():
    channels, chirps, samples = map(int, words[:3])
    maps = np.frombuffer(raw, np.complex64).reshape(channels, chirps, samples)
    rows, columns = np.divmod(np.arange(int(words[5])), samples)
    bins = 1 << (4 * channels - 1).bit_length()
    found, seconds = quickest(lambda: np.abs(np.fft.fft(maps[:, rows, columns], bins, axis=0)).argmax(0), float(words[6]))
    # Half a wavelength further to the right, half a wavelength less of the way for each u: the phase of an IF value grows with the way.
    return -2.0 * np.fft.fftfreq(bins)[found], seconds


def tones():
    import finufft
    paths, channels, chirps, samples = map(int, words)
    turns = np.frombuffer(raw, np.float64, 2 * paths).reshape(2, paths).astype(np.float32)
    strengths = np.frombuffer(raw, np.complex64, offset=16 * paths).reshape(channels, paths)
    return quickest(lambda: finufft.nufft2d1(turns[0], turns[1], strengths, (chirps, samples), eps=1e-3, isign=1))


def first_hits():
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh
    towards, step = np.array([float(x) for x in words[:3]]), float(words[3])
    corners = np.frombuffer(raw, np.float32).reshape(-1, 3)
    across = np.cross([0, 0, 1], towards)
    across /= np.linalg.norm(across)
    up = np.cross(towards, across)
    u, v, depth = corners @ across, corners @ up, corners @ towards
    columns, rows = np.arange(u.min(), u.max(), step), np.arange(v.min(), v.max(), step)
    def hits():
        scene = rtcore_scene.EmbreeScene()
        TriangleMesh(scene, corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
        count = 0
        for row in range(0, len(rows), 256):
            places = columns[None, :, None] * across + rows[row:row + 256, None, None] * up + (depth.max() + 1) * towards
            origins = places.reshape(-1, 3).astype(np.float32)
            directions = np.broadcast_to(-towards.astype(np.float32), origins.shape).copy()
            count += int((np.asarray(scene.run(origins, directions)) != -1).sum())
        return np.array([count * step * step])
    return quickest(hits, 0.0, 1)


jobs = {"range-doppler": range_doppler, "ca-cfar": lambda: detector("ca-cfar"), "os-cfar": lambda: detector("os-cfar"),
        "angles": angles, "tones": tones, "first-hits": first_hits}
module = __import__(package)
result, seconds = jobs[job]()
if np.iscomplexobj(result):
    result = result.astype(np.complex64)
np.ascontiguousarray(result).tofile(os.path.join(folder, "result.raw"))
print(f"{package} {getattr(module, '__version__', '')}".strip() + f"|{seconds}")
