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


def dictionaries(value: Any, name: str) -> list[dict[str, Any]]:
    """A list of dictionaries; one alone is none."""
    if isinstance(value, (dict, str)) or not hasattr(value, "__iter__"):
        raise ValueError(f"{name}: a list of dictionaries is needed, is {value!r}")
    every = list(value)
    for index, one in enumerate(every):
        if not isinstance(one, dict):
            raise ValueError(f"{name}[{index}]: a dictionary is needed, is {one!r}")
    return every


def needed(of: dict[str, Any], key: str, where: str) -> Any:
    """The value of a key that has to be there."""
    if of.get(key) is None:
        raise ValueError(f"{where}[{key!r}]: is needed")
    return of[key]


def number(value: Any, name: str) -> float:
    """One finite number; several, one for each sample or pulse, are refused."""
    try:
        values = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a number, is {value!r}") from None
    if values.ndim:
        raise refuse(name, "one number is needed, and none that changes from sample to sample")
    return float(finite(values, name))


def vector(value: Any, name: str) -> NDArray[np.float64]:
    """Three numbers; values that change over the frame are refused."""
    parts = list(value) if hasattr(value, "__iter__") else [value]
    if len(parts) != 3 or any(np.ndim(part) for part in parts):
        raise refuse(name, "three numbers are needed, and none that changes from sample to sample")
    return np.array([number(part, name) for part in parts])


def finite(values: NDArray[np.float64], name: str) -> NDArray[np.float64]:
    """The same values, all of them finite numbers."""
    if not np.all(np.isfinite(values)):
        raise ValueError(f"{name}: must be finite, is {values.tolist()}")
    return values


def above_zero(value: Any, name: str) -> float:
    """A number above 0."""
    told = number(value, name)
    if told <= 0:
        raise ValueError(f"{name}: must be above 0, is {told:g}")
    return told


def nothing(value: Any, name: str, why: str) -> None:
    """Refuses anything but zeros."""
    if value is not None and np.any(np.asarray(value, dtype=complex) != 0):
        raise refuse(name, why)
