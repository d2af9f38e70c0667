"""Simulator of 77 GHz radar at a traffic intersection.

A scene is a TOML file or a dictionary with the same keys; results are NumPy arrays::

    import wayside

    scene = wayside.Scene("scenes/intersection.toml")
    print(scene.cost())                    # before anything runs
    paths = scene.trace()                  # paths[0].a_m: complex128 [n, 2, 2], metres
    cube = scene.echo(paths)               # cube.samples: complex64 [frame, channel, chirp, sample]
    found = cube.range_doppler().detect()  # found.points, found.objects: record arrays
    car = wayside.rcs("car-suv", 77.0, az_deg=range(360))

Signs, axes and units are those of the project's page ``docs/conventions.md``: SI units, world x across the
lanes, y along them away from the radar, z up; approaching is a negative velocity. Work of the library lets
the interpreter go, Ctrl-C ends it, ``progress`` is called with what is under way and the share that is
done, and with a share of 1 at the end.
"""

import atexit as _atexit

from ._core import (
    Cube,
    Detections,
    Paths,
    PathsFrame,
    RangeDoppler,
    Rcs,
    Scene,
    Tracks,
    __version__,
    mesh_bounds_m,
    rcs,
    set_threads,
)
from ._core import withdraw as _withdraw
from .errors import Fault, WaysideError

CLASSES = ("car", "bus", "truck", "motorcycle")
"""Names of the classes, in the order of probabilities."""

HEIGHTS = ("none", "assumed", "measured")
"""Sources of a height, by the numbers of the field ``height`` of points and objects."""

__all__ = [
    "CLASSES",
    "Cube",
    "Detections",
    "Fault",
    "HEIGHTS",
    "Paths",
    "PathsFrame",
    "RangeDoppler",
    "Rcs",
    "Scene",
    "Tracks",
    "WaysideError",
    "__version__",
    "mesh_bounds_m",
    "rcs",
    "set_threads",
]

# What was called off and is still under way at the end leaves nothing half-written.
_atexit.register(_withdraw)
