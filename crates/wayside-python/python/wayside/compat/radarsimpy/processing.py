"""Range and Doppler transforms by RadarSimPy's names.

What is not here raises :class:`NotSupported`: ``wayside.Cube`` and ``wayside.RangeDoppler`` detect and find
directions.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .refusal import refuse


def range_fft(data: Any, rwin: Any = None, n: int | None = None) -> NDArray[np.complex128]:
    """Transform over samples, [channels, pulses, range]; ``rwin`` is a window of as many samples."""
    return _transformed(np.asarray(data), rwin, n, axis=2)


def doppler_fft(data: Any, dwin: Any = None, n: int | None = None) -> NDArray[np.complex128]:
    """Transform over pulses, [channels, doppler, range]; zero velocity is cell 0."""
    return _transformed(np.asarray(data), dwin, n, axis=1)


def range_doppler_fft(
    data: Any, rwin: Any = None, dwin: Any = None, rn: int | None = None, dn: int | None = None
) -> NDArray[np.complex128]:
    """Both transforms, one after the other."""
    return doppler_fft(range_fft(data, rwin, rn), dwin, dn)


def _transformed(data: Any, window: Any, n: int | None, axis: int) -> NDArray[np.complex128]:
    weights = np.ones(data.shape[axis]) if window is None else np.asarray(window)
    shape = [1, 1, 1]
    shape[axis] = -1
    spectrum: NDArray[np.complex128] = np.fft.fft(data * weights.reshape(shape), n=n, axis=axis)
    return spectrum


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(name)
    raise refuse(f"processing.{name}", "wayside.Cube(samples, scene).range_doppler().detect() detects")
