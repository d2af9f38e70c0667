"""Seconds of FINUFFT for a number of two-dimensional type-1 transforms onto 128 x 256; tones (x, y) as float32 pairs on stdin."""
import sys, time
try:
    import numpy as np, finufft
except ImportError:
    sys.exit(print("skipped: FINUFFT is not here"))
count, eps, threads = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
x, y = np.ascontiguousarray(np.frombuffer(sys.stdin.buffer.read(), np.float32).reshape(-1, 2).T)
rng = np.random.default_rng(1)
strengths = (rng.standard_normal((count, x.size)) + 1j * rng.standard_normal((count, x.size))).astype(np.complex64)
best = {}
for upsampling in (1.25, 2.0):
    for _ in range(5):
        start = time.perf_counter()
        plan = finufft.Plan(1, (256, 128), n_trans=count, eps=eps, isign=1, dtype="complex64", nthreads=threads, upsampfac=upsampling)
        plan.setpts(x, y)
        plan.execute(strengths)
        best[upsampling] = min(best.get(upsampling, 9e9), time.perf_counter() - start)
fastest = min(best, key=best.get)
print(f"FINUFFT {finufft.__version__}, {count} transforms of {x.size} tones at {eps:g} (upsampling {fastest}): {1e3 * best[fastest]:.1f} ms, given strengths and nothing else to do")
