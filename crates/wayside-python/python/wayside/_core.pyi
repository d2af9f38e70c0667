"""Native part of the package `wayside`."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Cube",
    "Detections",
    "Paths",
    "PathsFrame",
    "RangeDoppler",
    "Rcs",
    "Scene",
    "Tracks",
    "__version__",
    "file_keys",
    "mesh_bounds_m",
    "rcs",
    "set_threads",
    "withdraw",
]

_Path = str | os.PathLike[str]
_Progress = Callable[[str, float], object]
_Numbers = float | Sequence[float] | NDArray[np.floating[Any]] | NDArray[np.integer[Any]] | range

__version__: str

def file_keys() -> list[str]:
    """Names of the keys of a scene that name files, which are sought beside the scene."""

def set_threads(threads: int) -> None:
    """Limits the threads that the library works with; once, before the first work."""

def withdraw() -> None:
    """Removes the temporary files of work that was called off and is still under way."""

def mesh_bounds_m(mesh: _Path, unit_scale: float | None = None) -> NDArray[np.float64]:
    """Lowest and highest coordinates of a mesh in metres, body axes as its file has them, float64 [2, 3]."""

def rcs(
    mesh: _Path,
    freq_ghz: _Numbers,
    az_deg: _Numbers | None = None,
    el_deg: _Numbers | None = None,
    *,
    range_m: float = ...,
    pol: str = "vv",
    bounces: int = 3,
    edges: str = "off",
    nodes: str = "own-edge",
    surface: str = "flat",
    detail: str = "mesh",
    sides: str = "two",
    accuracy_db: float = ...,
    rx_az_deg: float | None = None,
    rx_el_deg: float | None = None,
    rx_range_m: float | None = None,
    unit_scale: float | None = None,
    materials: _Path | None = None,
    transmission: str = "off",
    memory_limit_mib: int | None = None,
    progress: _Progress | None = None,
) -> Rcs:
    """Makes S of a mesh by BART, as `wayside rcs` does: `s_m` of the result is complex128 [freq, el, az] in
    metres.

    `mesh` is a file (of assets of OpenMATERIAL 3D in their own materials) or the name of an own vehicle.
    `freq_ghz` (GHz), `az_deg` and `el_deg` are a number or numbers and become the three axes. Directions are
    those of the antenna in body axes, in degrees: `az_deg` 0 before the front, growing counter-clockwise from
    above, `el_deg` above the horizon; left out they are 0°, one direction from ahead. `range_m` is the
    antenna's distance in metres, infinite for the far field. `rx_az_deg`, `rx_el_deg` (degrees) and
    `rx_range_m` are a receiver that stands still elsewhere. `detail="statistical"` draws the small parts that
    the mesh lacks. `materials` is a file that says what the mesh's names of materials stand for, else
    everything conducts; `transmission="on"` follows waves through its sheets and needs it, "off" lets nothing
    through.
    """

@final
class Scene:
    """A virtual traffic intersection and the radar that looks at it.

    `source` is the path of a TOML file, or a dictionary with the same keys, whose files are seen from
    `folder`. `radar` names one of several, `model` replaces the model of every target, `seed` and
    `accuracy_db` the scene's; `memory_limit_mib` is the memory that tracing may take. Raises WaysideError
    with every broken rule.
    """

    def __new__(
        cls,
        source: _Path | Mapping[str, Any],
        *,
        folder: _Path | None = None,
        radar: str | None = None,
        model: _Path | None = None,
        seed: int | None = None,
        accuracy_db: float | None = None,
        memory_limit_mib: int | None = None,
        progress: _Progress | None = None,
    ) -> Scene: ...
    @property
    def toml(self) -> str:
        """Text of the scene as TOML, which `wayside run` takes."""
    @property
    def name(self) -> str:
        """Name of the scene."""
    @property
    def seed(self) -> int:
        """Seed of the noise and of everything random."""
    @property
    def frames(self) -> int:
        """Number of frames."""
    @property
    def targets(self) -> list[str]:
        """Ids of the targets."""
    @property
    def radars(self) -> list[str]:
        """Ids of several radars; empty where the scene has one."""
    @property
    def radar(self) -> dict[str, Any]:
        """The radar in the words of the field, as `radar` of summary.json: carrier_hz, bandwidth_hz,
        range_resolution_m, velocity_max_mps and more."""
    def cost(self) -> dict[str, float]:
        """Cost that a run of all frames is expected to have, before anything runs.

        frames, processor_s, processor_from_s, processor_to_s (nine of ten runs lie between), wall_s, threads,
        expected_memory_mib (held when most is), memory_mib (no more is held).
        """
    def trace(self, *, progress: _Progress | None = None) -> Paths:
        """Scattering paths of every frame, as `wayside paths` traces them."""
    def echo(self, paths: Paths | None = None, *, progress: _Progress | None = None) -> Cube:
        """Radar cubes of every frame, as `wayside echo` makes them; of `paths` where they are given."""
    def range_doppler(self, *, progress: _Progress | None = None) -> RangeDoppler:
        """Range-Doppler maps of every frame."""
    def detect(self, *, progress: _Progress | None = None) -> Detections:
        """Points and objects of every frame."""
    def points(self, *, progress: _Progress | None = None) -> np.recarray[Any, Any]:
        """Points of every frame, as `Detections.points`."""
    def objects(self, *, progress: _Progress | None = None) -> np.recarray[Any, Any]:
        """Objects of every frame, as `Detections.objects`."""
    def track(self, *, progress: _Progress | None = None) -> Tracks:
        """Objects followed over the frames."""
    def classify(
        self, model: _Path | None = None, *, progress: _Progress | None = None
    ) -> np.recarray[Any, Any]:
        """Classes of the objects, as `Detections.classify`."""
    def run(
        self,
        out: _Path,
        *,
        cache: bool | _Path | None = None,
        classifier: _Path | None = None,
        progress: _Progress | None = None,
    ) -> dict[str, Any]:
        """Runs everything and writes the files of `wayside run` into the folder `out`.

        Returns summary.json as a dictionary. `cache`: None or False for none, True for the default one, or a
        folder. `classifier` is a file or a folder of `wayside train`; the one that ships where it is left
        out.
        """

@final
class PathsFrame:
    """Scattering paths of one frame, n of them, referred to the frame's first sample."""

    @property
    def index(self) -> int:
        """Index of the frame, from 0."""
    @property
    def time_s(self) -> float:
        """Time of the frame's first sample, s."""
    @property
    def a_m(self) -> NDArray[np.complex128]:
        """Scattering amplitude a in metres, complex128 [n, receive, transmit], v = 0, h = 1, at f_c."""
    @property
    def slope_m_per_hz(self) -> NDArray[np.complex128]:
        """Slope da/df in m/Hz, complex128 [n, receive, transmit]."""
    @property
    def x_a_m(self) -> NDArray[np.float64]:
        """Place x_a where the node appears from the transmitter, world metres, float64 [n, 3]."""
    @property
    def x_b_m(self) -> NDArray[np.float64]:
        """Place x_b where the node appears from the receiver, world metres, float64 [n, 3]."""
    @property
    def v_a_mps(self) -> NDArray[np.float64]:
        """Velocity of x_a, m/s, float64 [n, 3]."""
    @property
    def v_b_mps(self) -> NDArray[np.float64]:
        """Velocity of x_b, m/s, float64 [n, 3]."""
    @property
    def order(self) -> NDArray[np.uint8]:
        """Number of bounces, uint8 [n]; 0 of a point target."""
    @property
    def target(self) -> NDArray[np.uint32]:
        """Index of the target in `Paths.targets`, uint32 [n]; 4,294,967,295 of the road's own backscatter."""
    @property
    def spans(self) -> np.recarray[Any, Any]:
        """Part of the frame and of the array that each path stands for, a `numpy.recarray` [n]: first_s,
        step_s, moments, moment (of ways that were traced at several moments, each blended with its
        neighbours), transmit [3], receive [3], first_m, step_m, places, place (likewise from several places
        along the array's row), side_transmit [3], side_receive [3], side_from_m (of outlines that are those of
        the transmitter or of the receiver); NaN and −1 of a path that stands for all of it."""
    @property
    def delay_s(self) -> NDArray[np.float64]:
        """Delay at the frame's middle from the array's centre, s, float64 [n]."""
    @property
    def delay_rate(self) -> NDArray[np.float64]:
        """Rate of the delay at the frame's middle, s/s, float64 [n]."""
    @property
    def error_db(self) -> dict[str, float | None]:
        """Numerical errors in dB relative to the echo; None where not estimated and of no error at all."""
    @property
    def model_error_db(self) -> dict[str, float | None]:
        """Errors of what the model leaves out, in dB relative to the echo."""
    def __len__(self) -> int: ...

@final
class Paths:
    """Scattering paths of the frames of a scene: a sequence of `PathsFrame`."""

    @staticmethod
    def read(file: _Path) -> Paths:
        """Reads a `.paths` artifact."""
    def write(self, file: _Path) -> None:
        """Writes a `.paths` artifact, the bytes of `wayside paths`; another format's ending is refused."""
    @property
    def targets(self) -> list[str]:
        """Ids of the scene's targets."""
    @property
    def centre_frequency_hz(self) -> float:
        """Frequency f_c of the amplitudes, Hz: the centre of the sampled sweep."""
    def to_pandas(self) -> Any:
        """Table of all paths, a row each: `pandas.DataFrame`, where pandas is installed."""
    def __len__(self) -> int: ...
    def __getitem__(self, key: int, /) -> PathsFrame: ...

@final
class Cube:
    """Radar data cubes of the frames of a scene, √W or what was imported.

    `Cube(samples, scene)` makes them of anybody's samples: complex values [frame, channel, chirp, sample], or
    of one frame [channel, chirp, sample]; `scene` is a Scene, a path or a dictionary and says what the radar
    is. Their unit is what `import` takes it for: steps of a converter where `full_scale`, the largest part of
    a sample, is told, or all samples are whole numbers; else √W.
    """

    def __new__(
        cls,
        samples: ArrayLike,
        scene: Scene | _Path | Mapping[str, Any],
        *,
        full_scale: float | None = None,
    ) -> Cube: ...
    @staticmethod
    def read(file: _Path) -> Cube:
        """Reads a `.cube` artifact."""
    def write(self, file: _Path) -> None:
        """Writes a `.cube` artifact, the bytes of `wayside echo`; another format's ending is refused."""
    @property
    def unit(self) -> str:
        """Unit of the samples: "sqrt(W)", or "ADC steps" of a file that was imported so."""
    @property
    def samples(self) -> NDArray[np.complex64]:
        """IF samples in `unit`, complex64 [frame, channel, chirp, sample]; channel = tx·N_rx + rx."""
    @property
    def time_s(self) -> NDArray[np.float64]:
        """Times of the frames' first samples, s, float64 [frame]."""
    @property
    def error_db(self) -> list[dict[str, float | None]]:
        """Numerical errors of each frame in dB relative to the echo."""
    def range_doppler(self, *, progress: _Progress | None = None) -> RangeDoppler:
        """Range-Doppler maps of all channels, with the cells that the detector found."""
    def to_xarray(self) -> Any:
        """Cube with named axes: `xarray.DataArray`, where xarray is installed."""
    def __len__(self) -> int: ...

@final
class RangeDoppler:
    """Range-Doppler maps of the frames of a cube."""

    @staticmethod
    def read(file: _Path) -> RangeDoppler:
        """Reads a `.rdm` artifact. Its maps have no samples, so `detect` refuses them where `refine` of [dsp]
        is "on"."""
    def write(self, file: _Path) -> None:
        """Writes a `.rdm` artifact, the bytes of `wayside dsp`; another format's ending is refused."""
    @property
    def values(self) -> NDArray[np.complex64]:
        """Map values in `unit`, complex64 [frame, channel, doppler, range]; zero velocity at N/2."""
    @property
    def mask(self) -> NDArray[np.uint8]:
        """State of each cell, uint8 [frame, doppler, range]: 0 untested, 1 tested, 2 detected."""
    @property
    def range_m(self) -> NDArray[np.float64]:
        """Ranges of the columns, m, float64 [range]."""
    @property
    def velocity_mps(self) -> NDArray[np.float64]:
        """Radial velocities of the rows, m/s, receding positive, float64 [doppler]; of the first
        sub-frame."""
    @property
    def velocity_of_frames_mps(self) -> NDArray[np.float64]:
        """Radial velocities of the rows of each frame, m/s, receding positive, float64 [frame, doppler]."""
    @property
    def unit(self) -> str:
        """Unit of the values: "sqrt(W)", or "ADC steps" of samples that were imported so."""
    @property
    def time_s(self) -> NDArray[np.float64]:
        """Times of the frames' first samples, s, float64 [frame]."""
    @property
    def detections(self) -> list[int]:
        """Number of cells above the detector's threshold in each frame."""
    def detect(self, *, progress: _Progress | None = None) -> Detections:
        """Points and objects of the maps. What their directions lack (an array that tells no azimuth, points
        without a height) is told to the logger `wayside`."""
    def to_xarray(self) -> Any:
        """Maps with named axes: `xarray.Dataset`, where xarray is installed."""
    def __len__(self) -> int: ...

@final
class Detections:
    """Detected points and objects of the frames of a cube."""

    @staticmethod
    def read(file: _Path) -> Detections:
        """Reads a `.points` artifact. Its points have no maps, so `classify` refuses them."""
    @property
    def points(self) -> np.recarray[Any, Any]:
        """Points of all frames, a read-only `numpy.recarray`: frame, range_m, radial_velocity_mps (receding
        positive), azimuth_rad (from +y towards +x), elevation_rad, position_m [3] in world metres, snr_db,
        object (index among its frame's objects, −1 of a lone one), two_ways_rad [2] (NaN where there are
        none), stationary (1 yes, 0 no, −1 not asked), height.

        height is an index into `wayside.HEIGHTS`: 2 measured by elevation rows, 1 assumed as
        `assumed_height_m` says, 0 none: no place has that height and the range, and z is the radar's own.
        """
    @property
    def objects(self) -> np.recarray[Any, Any]:
        """Objects of all frames, a read-only `numpy.recarray`: frame, range_m, radial_velocity_mps,
        azimuth_rad, position_m [3], snr_db, points (how many), lane (−1 of none), range_extent_m [2],
        velocity_extent_mps [2], velocity_resolved, ghost_share (NaN where the array cannot tell), stationary,
        height (as of points)."""
    def track(self, *, progress: _Progress | None = None) -> Tracks:
        """Objects followed over the frames."""
    def classify(
        self, model: _Path | None = None, *, progress: _Progress | None = None
    ) -> np.recarray[Any, Any]:
        """Classes of the objects, a `numpy.recarray`: frame, object, a probability for each of
        `wayside.CLASSES`, told (index among them, −1 for "unknown"). `model` is a file or a folder of
        `wayside train`; the one that ships where it is left out."""
    def write(self, file: _Path) -> None:
        """Writes a `.points` artifact, the bytes of `wayside dsp`; another format's ending is refused."""
    def to_pandas(
        self,
        of: Literal["points", "objects", "classes"] = "points",
        *,
        model: _Path | None = None,
        progress: _Progress | None = None,
    ) -> Any:
        """Table of all points, all objects or the objects' classes: `pandas.DataFrame`, where pandas is
        installed.

        `of` is "points", "objects" or "classes"; `model` and `progress` are those of `classify`.
        """
    def __len__(self) -> int: ...

@final
class Tracks:
    """Tracks of the frames of a cube."""

    @staticmethod
    def read(file: _Path) -> Tracks:
        """Reads a `.tracks` artifact."""
    @property
    def records(self) -> np.recarray[Any, Any]:
        """Tracks of all frames, a read-only `numpy.recarray`: frame, id, state (0 tentative, 1 confirmed, 2
        coasting), age_frames, missed_frames, position_m [2], velocity_mps [2], covariance [4, 4] of (x, y,
        v_x, v_y), velocity_resolved, lane (−1 of none), box_centre_m [2], box_length_m, box_width_m,
        box_heading_rad (from world +x towards +y)."""
    def write(self, file: _Path) -> None:
        """Writes a `.tracks` artifact, the bytes of `wayside dsp`; another format's ending is refused."""
    def to_pandas(self) -> Any:
        """Table of all tracks: `pandas.DataFrame`, where pandas is installed."""
    def __len__(self) -> int: ...

@final
class Rcs:
    """Scattering amplitude S of a mesh over frequency, elevation and azimuth."""

    @staticmethod
    def read(file: _Path) -> Rcs:
        """Reads a table of `wayside rcs` or of `write`: `S.npy` with the `S.json` beside it."""
    def write(self, file: _Path) -> None:
        """Writes the table as `S.npy`, the bytes of `wayside rcs`, and its description as `S.json` beside it;
        another format's ending is refused."""
    @property
    def s_m(self) -> NDArray[np.complex128]:
        """Scattering amplitude S in metres, complex128 [freq, el, az], phase at the mesh's origin; |S|² is
        the RCS."""
    @property
    def rcs_dbsm(self) -> NDArray[np.float64]:
        """Radar cross section in dBsm, float64 [freq, el, az]; of `s_m` as it is now."""
    @property
    def freq_hz(self) -> NDArray[np.float64]:
        """Frequencies, Hz, float64 [freq]."""
    @property
    def el_deg(self) -> NDArray[np.float64]:
        """Elevations above the body's horizon, degrees, float64 [el]."""
    @property
    def az_deg(self) -> NDArray[np.float64]:
        """Azimuths, degrees, float64 [az]; 0 looks at the body's front, growing counter-clockwise from
        above."""
    @property
    def range_m(self) -> float:
        """Distance of the antenna from the mesh's origin, m; infinite for the far field."""
    @property
    def far_field_from_m(self) -> float:
        """Range from which on a table of infinite range is right, m: 2D²/λ."""
    @property
    def error_db(self) -> dict[str, float | None]:
        """Numerical errors of the table in dB relative to it; None where not estimated and of no error."""
    @property
    def model_error_db(self) -> dict[str, float | None]:
        """Errors of what the model leaves out, in dB relative to the table."""
    def to_xarray(self) -> Any:
        """Table with named axes: `xarray.Dataset`, where xarray is installed."""
