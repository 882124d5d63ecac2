"""Save a posterior as one netCDF-4 file in the arviz layout, and load it: `save` and `load_saved`.

Settings, grid, prior, sensor and timings are the header, JSON in an attribute of the root. netCDF has neither bits nor
half precision: booleans are bytes in the file, and half precision is 32-bit floats, whose last bits are zero
and compress well. HDF5 checks each array by its Fletcher-32 sum, and the header has a CRC, so a damaged file is
refused. A trajectory's group holds the inputs of its approximation (`bayesmap.poses.trajectory`).
"""

import json
import math
import os
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import ArraySpec, Draws
from bayesmap.cells.kinds import prior_from
from bayesmap.errors import BadInput
from bayesmap.files import is_saved_run, saved_run_hint, write_whole
from bayesmap.model import POSES
from bayesmap.posterior.posterior import Posterior
from bayesmap.samplers.sampler import Snapshot
from bayesmap.sensors.model import describe, from_description
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.poses.trajectory import InferredTrajectory

FORMAT = "bayesmap run"
FORMAT_VERSION = 1
BLOCK_NUMBERS = 1 << 22  # count of numbers converted at a time, so that no whole copy of the draws is made
CHUNK_NUMBERS = 1 << 20  # count of numbers compressed together
NOISE_NATS = 1e-4  # noise on log likelihoods by reading: arviz refuses a tail of equal weights


def save(
    posterior: Posterior, path: str | os.PathLike[str],
    on_progress: Callable[[int, int], None] = lambda done, total: None, trajectory: "InferredTrajectory | None" = None,
    *, by_reading: bool = False,
) -> None:  # fmt: skip
    """Write a posterior, whole or not at all, with the approximation of all scans' poses, if there is one.
    ``on_progress`` is called with the count of the draws' numbers written so far, and their total. ``by_reading`` adds
    the group ``log_likelihood``, which is not read back. Raises `BadInput` for a folder that cannot be written to.
    """
    with write_whole(Path(path)) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        _write_header(posterior, file, trajectory)
        _write_posterior(posterior, file, on_progress)
        densities = {
            "lp": posterior.log_joint, "log_likelihood": posterior.log_likelihood, "log_prior": posterior.log_prior,
        }  # fmt: skip
        write_arrays(file.createGroup("sample_stats"), ("chain", "draw"), densities)
        write_arrays(file.createGroup("warmup_sample_stats"), ("chain", "draw"), {"lp": posterior.warmup_log_joint})
        _write_constants(posterior, file)
        if by_reading:
            _write_by_reading(posterior, file)


def _write_by_reading(posterior: Posterior, file: Any) -> None:
    """Write the log likelihood of every valid reading in every draw, as arviz's ``loo`` reads it."""
    from bayesmap.posterior.posterior import log_p_by_reading, valid_readings

    group, draws = file.createGroup("log_likelihood"), posterior.draws
    for name, count in (("chain", draws.chains), ("draw", draws.count)):
        write_arrays(group, (name,), {name: np.arange(count)}, compressed=False)
    write_arrays(group, ("reading",), dict(zip(("scan", "beam"), valid_readings(posterior), strict=True)))
    values = log_p_by_reading(posterior)
    values += np.random.default_rng(0).uniform(0.0, NOISE_NATS, values.shape).astype(np.float32)
    write_arrays(group, ("chain", "draw", "reading"), {"range_m": values})
    group["range_m"].coordinates = "scan beam"  # so that xarray takes them for no variables


def _write_header(posterior: Posterior, file: Any, trajectory: "InferredTrajectory | None") -> None:
    """Write all that is no array, as JSON with a checksum, and the arrays of the trajectory."""
    scans = posterior.scans
    header = {
        "cells": posterior.kind, "settings": posterior.settings, "prior": posterior.prior.describe(),
        "sensor": None if posterior.sensor is None else describe(posterior.sensor), "grid": asdict(posterior.grid),
        "limits": [scans.min_range_m, scans.max_range_m], "seconds": posterior.seconds, "counts": posterior.counts,
        "sweep": posterior.sweep, "finished": posterior.finished, "log_evidence": posterior.log_evidence,
        "notes": posterior.notes, "mount": None if scans.mount is None else scans.mount.tolist(),
    }  # fmt: skip
    if trajectory is not None:
        header["trajectory"] = trajectory_scalars(trajectory)
        for name, (dimensions, values) in trajectory_arrays(trajectory).items():
            write_arrays(file.createGroup("trajectory"), dimensions, {name: values})
    text = json.dumps(header)
    file.setncatts({
        "format": FORMAT, "format_version": FORMAT_VERSION, "inference_library": "bayesmap",
        "inference_library_version": __version__, "bayesmap": text, "checksum": zlib.crc32(text.encode()),
    })  # fmt: skip


def _write_posterior(posterior: Posterior, file: Any, on_progress: Callable[[int, int], None]) -> None:
    """Write the draws, with their coordinates."""
    grid, draws, group = posterior.grid, posterior.draws, file.createGroup("posterior")
    x, y = grid.centers_m()
    for name, values in (("chain", np.arange(draws.chains)), ("draw", np.arange(draws.count)), ("x", x), ("y", y)):
        write_arrays(group, (name,), {name: values}, compressed=False)
    for dimension, index in draws.index.items():
        coordinates = {f"{dimension}_x": index // grid.shape[1], f"{dimension}_y": index % grid.shape[1]}
        if not dimension.endswith("cell"):
            coordinates = {dimension: index}
        write_arrays(group, (dimension,), coordinates)
    total = sum(draws.size * math.prod(draws.shape_of(spec)) for spec in draws.specs)
    done = 0

    def on_written(count: int) -> None:
        nonlocal done
        done += count
        on_progress(done, total)

    for spec in draws.specs:
        write_draws(group, spec, draws.arrays[spec.name], draws.shape_of(spec), on_written)
        if spec.dims[0].endswith("cell"):  # so that xarray takes the places of cells for coordinates
            group[spec.name].coordinates = f"{spec.dims[0]}_x {spec.dims[0]}_y"


def _write_constants(posterior: Posterior, file: Any) -> None:
    """Write scans, marginals, parameters and statistics that are arrays, and the state to continue the chains."""
    scans = posterior.scans
    write_arrays(file.createGroup("observed_data"), ("scan", "beam"), {"range_m": scans.ranges_m})
    constant = file.createGroup("constant_data")
    write_arrays(constant, ("scan", "pose_part"), {"pose_world": scans.poses})
    write_arrays(constant, ("beam",), {"angle_rad": scans.angles_rad})
    if scans.own_angles_rad is not None:
        write_arrays(constant, ("scan", "beam"), {"own_angle_rad": scans.own_angles_rad})
    if scans.stamps_s is not None:
        write_arrays(constant, ("scan",), {"stamp_s": scans.stamps_s})
    if scans.beam_poses is not None:
        write_arrays(constant, ("scan", "beam", "pose_part"), {"beam_pose_world": scans.beam_poses})
    observed = posterior.observed.astype(np.int8)
    write_arrays(constant, ("x", "y"), {"occupancy": posterior.occupancy, "observed": observed})
    arrays = {f"prior_{name}": np.asarray(values) for name, values in posterior.prior.parameters().items()}
    arrays |= {f"statistic_{name}": np.asarray(values) for name, values in posterior.statistics.items()}
    arrays |= {} if posterior.log_weights is None else {"log_weight": posterior.log_weights}
    for name, values in arrays.items():
        write_arrays(constant, tuple(f"{name}_{i}" for i in range(values.ndim)), {name: values})
    state = file.createGroup("chain_state")
    for name, values in posterior.snapshot.arrays.items():
        # Large arrays of random bits: compression would only take time.
        dimensions = ("chain", *(f"{name}_{i}" for i in range(1, values.ndim)))
        write_arrays(state, dimensions, {name: values}, compressed=values.dtype == np.uint8)


def load_saved(path: str | os.PathLike[str]) -> tuple[Posterior, "InferredTrajectory | None"]:
    """Read a posterior, and its approximation of poses, if any. Raises `BadInput` for other or damaged files."""
    path = Path(path)
    if not path.is_file():
        state = "a folder without a run; give a run.nc" if path.is_dir() else "no such file"
        # slam writes the trajectory before its first sweep.
        if path.name == "run.nc" and (path.parent / "trajectory.tum").is_file():
            state = "no draws yet; trajectory.tum beside it is complete, and slam --resume draws the map"
        raise BadInput(f"{path}: {saved_run_hint(path) or state}")
    if not is_saved_run(path):
        raise BadInput(f"{path}: not a readable saved run; give the run.nc of infer or slam")
    try:
        with netCDF4.Dataset(path, "r") as file:
            file.set_auto_mask(False)
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            reason = _unreadable_reason(attributes)
            if reason is None:
                text = attributes["bayesmap"]
                if attributes["checksum"] != zlib.crc32(text.encode()):
                    raise ValueError("the checksum of its header does not match")
                return _read(file, json.loads(text))
    except BadInput as problem:
        raise BadInput(f"{path}: {problem}") from None
    except (ArithmeticError, AttributeError, LookupError, OSError, RuntimeError, TypeError, ValueError) as error:
        raise BadInput(f"{path}: not a readable saved run; damaged or truncated? ({error}); run again") from None
    raise BadInput(f"{path}: {reason}")


def _unreadable_reason(attributes: dict[str, Any]) -> str | None:
    """Return the reason why an undamaged netCDF file cannot be read, or None if it can."""
    if attributes.get("format") != FORMAT:
        return "a netCDF file, but not a saved run of bayesmap's"
    if int(attributes["format_version"]) == FORMAT_VERSION:
        return None
    origin = f"bayesmap {attributes.get('inference_library_version')} in format {attributes['format_version']}"
    remedy = "use that version of bayesmap, or run again"
    return f"saved by {origin}, and this version reads format {FORMAT_VERSION}; {remedy}"


def _read(file: Any, header: dict[str, Any]) -> tuple[Posterior, "InferredTrajectory | None"]:
    """Return the posterior and the trajectory in an open file. Raises errors of many kinds for a damaged file."""
    constant = file["constant_data"]
    prior = prior_from(header["prior"] | _with_prefix(constant, "prior_"))
    snapshot = Snapshot(header["sweep"], {name: v[:] for name, v in file["chain_state"].variables.items()})
    trajectory = None
    if "trajectory" in header:
        arrays = {name: variable[:] for name, variable in file["trajectory"].variables.items()}
        trajectory = trajectory_from(arrays, header["trajectory"])
    grid = Grid(tuple(header["grid"]["shape"]), header["grid"]["resolution"], tuple(header["grid"]["origin"]))
    draws, stats = file["posterior"], file["sample_stats"]
    specs = (*prior.arrays, POSES) if POSES.name in draws.variables else prior.arrays
    dimensions = sorted({dim for spec in specs for dim in spec.dims} - {"x", "y"})
    index = {dim: _index(draws, dim, grid) for dim in dimensions}
    empty = Draws(grid, specs, {}, index)
    arrays = {spec.name: read_draws(draws[spec.name], spec, empty.shape_of(spec)) for spec in specs}
    sensor = header["settings"]["sensor"] if header["sensor"] is None else header["sensor"]
    scans = Scans(
        poses=constant["pose_world"][:], angles_rad=constant["angle_rad"][:],
        ranges_m=file["observed_data"]["range_m"][:], min_range_m=header["limits"][0], max_range_m=header["limits"][1],
        stamps_s=_optional(constant, "stamp_s"), beam_poses=_optional(constant, "beam_pose_world"),
        own_angles_rad=_optional(constant, "own_angle_rad"), mount=header.get("mount"),
    )  # fmt: skip
    posterior = Posterior(
        scans=scans, sensor=from_description(sensor), prior=prior, settings=header["settings"],
        draws=Draws(grid, specs, arrays, index), occupancy=constant["occupancy"][:],
        observed=constant["observed"][:] != 0, log_likelihood=stats["log_likelihood"][:],
        log_prior=stats["log_prior"][:], warmup_log_joint=file["warmup_sample_stats"]["lp"][:],
        snapshot=snapshot, finished=header["finished"], seconds=header["seconds"], counts=header["counts"],
        log_weights=_optional(constant, "log_weight"), statistics=_with_prefix(constant, "statistic_"),
        log_evidence=header["log_evidence"], notes=tuple(header["notes"]),
    )  # fmt: skip
    return posterior, trajectory


def _with_prefix(group: Any, prefix: str) -> dict[str, NDArray[Any]]:
    """Return the arrays of a group whose names begin with a prefix, by the rest of their names."""
    names = [name for name in group.variables if name.startswith(prefix)]
    return {name.removeprefix(prefix): np.asarray(group[name][:]) for name in names}


def _index(draws: Any, dimension: str, grid: Grid) -> NDArray[np.int32]:
    """Return the coordinates of a dimension: flat indices of cells, or numbers."""
    if dimension.endswith("cell"):
        flat = draws[f"{dimension}_x"][:] * grid.shape[1] + draws[f"{dimension}_y"][:]
        return np.asarray(flat, dtype=np.int32)
    return np.asarray(draws[dimension][:], dtype=np.int32)


def _optional(constant: Any, name: str) -> NDArray[np.float64] | None:
    return constant[name][:] if name in constant.variables else None


def write_arrays(
    group: Any, dimensions: tuple[str, ...], arrays: Mapping[str, NDArray[Any]], *, compressed: bool = True
) -> None:
    """Write arrays of the same dimensions; new dimensions get the arrays' sizes."""
    for name, values in arrays.items():
        _create_dimensions(group, dimensions, values.shape)
        filters = {"compression": _compression(group) if compressed else None, "complevel": 1}
        group.createVariable(name, values.dtype, dimensions, fletcher32=bool(dimensions), **filters)[:] = values


def _compression(group: Any) -> str:
    """Return Zstandard: a quarter of deflate's time, and files a tenth smaller. Deflate if the library lacks it."""
    return "zstd" if group.has_zstd_filter() else "zlib"


def write_draws(
    group: Any, spec: ArraySpec, stored: NDArray[Any], shape: tuple[int, ...], on_written: Callable[[int], None]
) -> None:
    """Write a stored array of the draws, (chains, draws, ...); call ``on_written`` with the count of each block."""
    # A chunk holds whole draws of one chain, about `CHUNK_NUMBERS` numbers; only long vectors are split.
    chains, draws = stored.shape[:2]
    dimensions = ("chain", "draw", *spec.dims)
    _create_dimensions(group, dimensions, (chains, draws, *shape))
    size = int(np.prod(shape))
    dtype = {"bits": "i1", "half": "f4"}.get(spec.storage, spec.dtype)
    draw_shape = (CHUNK_NUMBERS,) if size > CHUNK_NUMBERS and len(shape) == 1 else tuple(max(1, n) for n in shape)
    chunks = (1, _draws_per_chunk(draws, size), *draw_shape)
    variable = group.createVariable(
        spec.name, dtype, dimensions, compression=_compression(group), complevel=1, shuffle=spec.storage != "bits",
        chunksizes=chunks, fletcher32=True,
    )  # fmt: skip
    # Chunks are written whole, so a small cache suffices: the default keeps 64 MB per array until the file is closed.
    variable.set_var_chunk_cache(size=math.prod(chunks) * np.dtype(dtype).itemsize)
    variable.setncatts({"dtype": "bool"} if spec.storage == "bits" else {})
    if spec.meaning:
        variable.long_name = spec.meaning
    for chain, block in _blocks(chains, draws, size):
        values = spec.values(stored[chain, block], shape)
        variable[chain, block] = values.view(np.int8) if spec.storage == "bits" else values.astype(dtype, copy=False)
        on_written(values.size)


def read_draws(variable: Any, spec: ArraySpec, shape: tuple[int, ...]) -> NDArray[Any]:
    """Return draws in their stored form. Raises `ValueError` for sizes that do not fit the file's cells."""
    chains, draws, *sizes = variable.shape
    if tuple(sizes) != shape:
        raise ValueError(f"{spec.name} has the sizes {sizes}, and not {shape}")
    stored = spec.empty(chains, draws, shape)
    if variable.chunking() != "contiguous":
        variable.set_var_chunk_cache(size=math.prod(variable.chunking()) * variable.dtype.itemsize)
    for chain, block in _blocks(chains, draws, int(np.prod(shape))):
        stored[chain, block] = spec.stored(variable[chain, block])
    return stored


def _create_dimensions(group: Any, dimensions: tuple[str, ...], sizes: tuple[int, ...]) -> None:
    """Create those dimensions of a group that it does not have yet."""
    for dimension, size in zip(dimensions, sizes, strict=True):
        if dimension not in group.dimensions:
            group.createDimension(dimension, size)


def _draws_per_chunk(draws: int, size: int) -> int:
    return max(1, min(draws, CHUNK_NUMBERS // max(size, 1)))


def _blocks(chains: int, draws: int, size: int) -> Iterator[tuple[int, slice]]:
    """Yield chain and draws of the blocks that are converted at a time."""
    per_chunk = _draws_per_chunk(draws, size)
    n_draws = max(1, BLOCK_NUMBERS // max(size * per_chunk, 1)) * per_chunk  # whole chunks
    for chain in range(chains if size else 0):
        for i in range(0, draws, n_draws):
            yield chain, slice(i, min(i + n_draws, draws))


VECTOR = ("pose_part",)  # dimensions of a pose
MATRIX = ("pose_part", "other_pose_part")  # dimensions of the covariance of a pose
FIELDS: dict[str, tuple[str, ...]] = {  # arrays of the trajectory itself, with their dimensions
    "poses": ("scan", *VECTOR), "stamps_s": ("scan",), "nearest_key": ("scan",), "own_covariance": ("scan", *MATRIX),
    "explained": ("scan",), "flagged": ("scan",), "order": ("scan",), "keys": ("key",), "breaks": ("break",),
    "leaps": ("leap",),
}  # fmt: skip

PARTS: dict[str, dict[str, tuple[str, ...]]] = {  # arrays of the parts of a trajectory, saved as part_name
    "gaussian": {
        "poses": ("key", *VECTOR), "first": ("pair",), "second": ("pair",), "relative": ("pair", *VECTOR),
        "curvature": ("pair", *MATRIX), "force": ("pair", *VECTOR), "elsewhere": ("alternative", "key", *VECTOR),
        "by_odometry": ("coefficient", "key", *VECTOR),
    },
    "alternatives": {
        "first": ("alternative",), "last": ("alternative",), "probabilities": ("alternative",),
        "poses": ("alternative", "key", *VECTOR),
    },
    "closures": {
        "first": ("closure",), "second": ("closure",), "relative": ("closure", *VECTOR),
        "residuals": ("closure", *VECTOR), "weights": ("closure",),
    },
    "odometry": {
        "first": ("step",), "second": ("step",), "relative": ("step", *VECTOR), "information": ("step", *MATRIX),
    },
    "calibration": {"angles_rad": ("beam",)},
}  # fmt: skip


def trajectory_arrays(trajectory: "InferredTrajectory") -> dict[str, tuple[tuple[str, ...], NDArray[Any]]]:
    """Return all arrays of a trajectory by their saved names, with their dimensions."""
    arrays = {name: (dims, getattr(trajectory, name)) for name, dims in FIELDS.items()}
    for name, fields in PARTS.items():
        part = getattr(trajectory, name)
        if part is not None and (name != "alternatives" or len(part)):
            arrays |= {f"{name}_{field}": (dims, getattr(part, field)) for field, dims in fields.items()}
    return {name: (dims, _stored(values)) for name, (dims, values) in arrays.items() if values is not None}


def trajectory_scalars(trajectory: "InferredTrajectory") -> dict[str, Any]:
    """Return the numbers of a trajectory that are no arrays of many scans, as JSON values."""
    calibration, fit = trajectory.calibration, trajectory.calibration.odometry
    odometry = None if fit is None else {
        "slope": fit.slope.tolist(), "slope_sigma": fit.slope_sigma.tolist(),
        "systematic_covariance": fit.systematic_covariance.tolist(), "lag_s": float(fit.lag_s),
        "lag_sigma_s": float(fit.lag_sigma_s), "rates": fit.noise.rates.tolist(),
    }  # fmt: skip
    return {
        "dof": trajectory.gaussian.dof, "angle_step_ratio": calibration.angle_step_ratio,
        "point_sigma_m": calibration.point_sigma_m, "odometry": odometry,
        "noise": None if calibration.noise is None else asdict(calibration.noise),
    }  # fmt: skip


def trajectory_from(arrays: Mapping[str, NDArray[Any]], scalars: Mapping[str, Any]) -> "InferredTrajectory":
    """Return the trajectory, given the arrays of `trajectory_arrays` and the result of `trajectory_scalars`."""
    from bayesmap.poses.calibration import MotionNoise, OdometryFit
    from bayesmap.poses.graph import Factors, PoseStudentT
    from bayesmap.poses.prior import Odometry
    from bayesmap.poses.trajectory import NO_ALTERNATIVES, Alternatives, Calibration, InferredTrajectory, LoopClosures

    def part(name: str) -> dict[str, Any]:
        return {field: arrays.get(f"{name}_{field}") for field in PARTS[name]}

    fields: dict[str, Any] = {name: arrays.get(name) for name in FIELDS}
    fields["flagged"] = fields["flagged"] != 0
    odometry, noise = scalars["odometry"], scalars["noise"]
    fit = None
    if odometry is not None:
        slope, covariance, rates = (np.array(odometry[n]) for n in ("slope", "systematic_covariance", "rates"))
        fit = OdometryFit(slope, covariance, odometry["lag_s"], odometry["lag_sigma_s"], MotionNoise(rates))
    calibration = Calibration(
        angle_step_ratio=scalars["angle_step_ratio"], odometry=fit, noise=None if noise is None else Odometry(**noise),
        point_sigma_m=scalars["point_sigma_m"], **part("calibration"),
    )  # fmt: skip
    return InferredTrajectory(
        **fields, gaussian=PoseStudentT(**part("gaussian"), dof=scalars["dof"]),
        closures=LoopClosures(**part("closures")),
        alternatives=Alternatives(**part("alternatives")) if "alternatives_first" in arrays else NO_ALTERNATIVES,
        odometry=Factors(**part("odometry")) if "odometry_first" in arrays else None, calibration=calibration,
    )  # fmt: skip


def _stored(values: NDArray[Any]) -> NDArray[Any]:
    """Return booleans as bytes, indices as 64-bit integers, and other numbers as double precision."""
    if values.dtype == np.bool_:
        return values.astype(np.int8)
    return values.astype(np.int64) if values.dtype.kind == "i" else np.asarray(values, dtype=np.float64)
