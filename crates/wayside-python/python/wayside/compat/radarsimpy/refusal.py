"""What is not supported, refused by its name."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


class NotSupported(NotImplementedError):
    """An argument that RadarSimPy takes and wayside does not."""


def refuse(name: str, why: str) -> NotSupported:
    """Exception that names the argument and says why, or what to do instead."""
    return NotSupported(f"{name}: not supported by wayside: {why}")


def refuse_keys(of: dict[str, Any], known: set[str], where: str) -> None:
    """Refuses keys that mean something elsewhere, and those that mean nothing anywhere."""
    for key in of:
        if key not in known:
            raise refuse(f"{where}[{key!r}]", f"the keys are {', '.join(sorted(known))}")


def vector(value: Any, name: str) -> NDArray[np.float64]:
    """Three numbers; values that change over the frame are refused."""
    parts = [np.asarray(part, dtype=float) for part in value]
    if len(parts) != 3 or any(part.ndim for part in parts):
        raise refuse(name, "three numbers are needed, and none that changes from sample to sample")
    return finite(np.array(parts), name)


def finite(values: NDArray[np.float64], name: str) -> NDArray[np.float64]:
    """The same values, all of them finite numbers."""
    if not np.all(np.isfinite(values)):
        raise ValueError(f"{name}: must be finite, is {values.tolist()}")
    return values


def above_zero(value: Any, name: str) -> float:
    """A number above 0."""
    number = float(finite(np.asarray(value, dtype=float), name))
    if number <= 0:
        raise ValueError(f"{name}: must be above 0, is {number:g}")
    return number


def nothing(value: Any, name: str, why: str) -> None:
    """Refuses anything but zeros."""
    if value is not None and np.any(np.asarray(value, dtype=complex) != 0):
        raise refuse(name, why)
