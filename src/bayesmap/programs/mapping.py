"""The mapping model as a generative function: walls from the prior, readings from the sensor.

    model = bm.mapping_model(grid, pose, angles_rad, bm.Independent(0.5), bm.Gaussian(0.2), max_range_m=42.0)
    trace, weight = model.importance(key, C["readings"].set(ranges_m), ())

The joint distribution is that of `bayesmap.infer`. For unknown poses pass a generative function, not an array.
"""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.cells.binary import Independent
from bayesmap.errors import BadInput
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.closure import GenerativeFunctionClosure
from bayesmap.gen.densities import flip
from bayesmap.gen.diff import Diff, IndexChange
from bayesmap.gen.edits import Edited, EditRequest, IndexRequest, Update
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import Pytree, dataclass, static
from bayesmap.gen.static import StaticGenerativeFunction, gen
from bayesmap.gen.typing import PRNGKey
from bayesmap.programs.beam_sensor import BeamSensor, beam_geometry, reading_law
from bayesmap.programs.pose_sensor import PoseSensor
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import as_angles, as_poses, check_limits


@dataclass
class SetCells(EditRequest):
    """A request for the address "walls" to give the cells (i[k], j[k]) of a map the values `values[k]`.
    A 2 x 2 block is `SetCells(i + jnp.array([0, 0, 1, 1]), j + jnp.array([0, 1, 0, 1]), values)`. The work is that of
    one edit for each cell. All fields have shape (k,), with k known when the program is compiled.
    """

    i: Any
    j: Any
    values: Any

    def edit(self, key: PRNGKey, trace: Trace, argdiffs: Any) -> Edited:
        """Return the edited trace, after one edit for each cell. The backward request has the old values."""
        i, j, values = jnp.broadcast_arrays(*map(jnp.atleast_1d, (self.i, self.j, self.values)))
        old = trace.get_retval()[i, j]
        weight = jnp.zeros(())
        for row, column, value in zip(i.ravel(), j.ravel(), values.ravel(), strict=True):  # unrolled when compiled
            request = IndexRequest(row, IndexRequest(column, Update(ChoiceMap.choice(value))))
            trace, gain, _, _ = trace.edit(key, request, argdiffs)
            argdiffs = Diff.no_change(Diff.tree_primal(argdiffs))
            weight += gain
        return trace, weight, Diff.tree(trace.get_retval(), IndexChange((i, j))), SetCells(i, j, old)


def mapping_model(
    grid: Grid, poses: ArrayLike | GenerativeFunction, angles_rad: ArrayLike, prior: Independent, sensor: SensorModel,
    *, max_range_m: float, min_range_m: float = 0.0, hit_depth: float = 0.0,
) -> StaticGenerativeFunction:  # fmt: skip
    """Return the joint distribution of a map and its readings, as a generative function without arguments.

    Its choices, which it also returns, are

    - "walls", shape (nx, ny), bool;
    - "readings", metres, float, shape (A,) for a single pose of shape (3,), else (S, A): the ranges of `Scans`,
      typed readings included (`inf` no return, `-inf` too close, NaN invalid).

    An edit of one wall costs time in proportion to the beams through that cell. Make a model once: it traces all beams.

    If `poses` is a generative function, the poses are unknown, and this function is their prior:

        guesses, sigma = jnp.array([[1.0, 2.0, 0.0], [1.5, 2.0, 0.1]]), jnp.array([0.3, 0.3, 0.05])
        poses = gen.mv_normal_diag.vmap(in_axes=(0, None))(guesses, sigma)

    Then one more choice, "poses", is drawn first, with the prior's addresses below it, and the function returns (poses,
    walls, readings). An edit of a pose walks the beams of its scan; an edit of a wall checks all beams.

    Args:
        grid: the grid of the walls.
        poses: world (x, y, yaw), metres and radians, (3,) or (S, 3); or a generative function of no arguments for them.
        angles_rad: beam angles in the sensor frame, shape (A,).
        prior: the prior of the walls.
        sensor: the law of the readings: Gaussian, StudentT or BeamMixture.
        max_range_m: the sensor's largest range.
        min_range_m: the sensor's smallest range.
        hit_depth: where in a cell a beam stops, as a fraction of its chord: 0 at the near edge, 1 at the far edge.

    Raises `BadInput` for shapes that do not fit, numbers not finite, a sensor not known on JAX, or a coupled prior.
    """
    remedy = "use infer, or write a program that draws its walls and gives them to sensor_model"
    prior = Independent.of(prior, "mapping_model", remedy)
    walls = _WallPrior.of(prior.probabilities(grid))
    if isinstance(poses, GenerativeFunction):
        _check_pose_prior(poses)
        pose_sensor = pose_sensor_model(
            grid, angles_rad, sensor, max_range_m=max_range_m, min_range_m=min_range_m, hit_depth=hit_depth
        )
        return _poses_map_and_readings.partial_apply(poses, walls, pose_sensor)
    beam_sensor = sensor_model(
        grid, poses, angles_rad, sensor, max_range_m=max_range_m, min_range_m=min_range_m, hit_depth=hit_depth
    )
    return _map_and_readings.partial_apply(walls, beam_sensor)


def sensor_model(
    grid: Grid, poses: ArrayLike, angles_rad: ArrayLike, sensor: SensorModel, *,
    max_range_m: float, min_range_m: float = 0.0, hit_depth: float = 0.0,
) -> BeamSensor:  # fmt: skip
    """Return the sensor alone: a generative function of the walls (nx, ny), with the readings as its only choice.

    Use it in models with your own prior:

        @gen
        def model():
            walls = my_prior() @ "walls"
            return sensor(walls) @ "readings"

    Arguments and errors as for `mapping_model`.
    """
    scan_poses, angles, limits = as_poses(poses), as_angles(angles_rad), _limits(min_range_m, max_range_m)
    shape = (len(angles),) if np.ndim(poses) == 1 else (len(scan_poses), len(angles))
    return BeamSensor(beam_geometry(grid, scan_poses, angles, limits, hit_depth), reading_law(sensor, limits), shape)


def pose_sensor_model(
    grid: Grid, angles_rad: ArrayLike, sensor: SensorModel, *,
    max_range_m: float, min_range_m: float = 0.0, hit_depth: float = 0.0,
) -> PoseSensor:  # fmt: skip
    """Return the sensor alone, for unknown poses: a generative function of walls (nx, ny) and poses (3,) or (S, 3).
    Use it as `sensor_model`, by `sensor(walls, poses) @ "readings"`, or to localize. For the rest see `mapping_model`.
    """
    angles, law = as_angles(angles_rad), reading_law(sensor, _limits(min_range_m, max_range_m))
    return PoseSensor(grid, tuple(angles.tolist()), law, float(hit_depth))


def _limits(min_range_m: float, max_range_m: float) -> RangeLimits:
    """Return the sensor's limits. Raises `BadInput` if they are out of order."""
    check_limits(min_range_m, max_range_m)
    return RangeLimits(float(min_range_m), float(max_range_m))


def _check_pose_prior(prior: GenerativeFunction) -> None:
    """Raise `BadInput` unless the prior returns poses, (3,) or (S, 3)."""
    try:
        poses = jax.eval_shape(lambda key: prior.simulate(key, ()).get_retval(), jax.random.key(0))
    except TypeError as error:
        raise BadInput(f"mapping_model: the prior of the poses must run without arguments; it says: {error}") from None
    shape = getattr(poses, "shape", None)
    if shape is None or len(shape) not in (1, 2) or shape[-1] != 3:
        raise BadInput(f"mapping_model: the prior of the poses must return an array (3,) or (S, 3), found {poses}")


@dataclass
class _WallPrior(Pytree):
    """The prior of the walls. Its probabilities are bytes, so that they can be a static part of JAX's trees."""

    shape: tuple[int, ...] = static()
    p_wall: bytes = static(repr=False)

    @staticmethod
    def of(p_wall: NDArray[np.float64]) -> "_WallPrior":
        """Return the prior of an array of probabilities, (nx, ny)."""
        return _WallPrior(p_wall.shape, np.asarray(p_wall, np.float64).tobytes())

    def generator(self) -> Any:
        """Return the call that draws the walls. Equal probabilities become one number, so that edits read no array."""
        p = np.frombuffer(self.p_wall).reshape(self.shape)
        if (p == p[0, 0]).all():
            return flip.repeat(n=p.shape[1]).repeat(n=p.shape[0])(float(p[0, 0]))
        return flip.vmap(in_axes=(0,)).vmap(in_axes=(0,))(jnp.asarray(p, jnp.result_type(float)))


@gen
def _map_and_readings(prior: _WallPrior, sensor: BeamSensor) -> Any:
    """Draw a map and its readings at known poses."""
    walls = prior.generator() @ "walls"
    readings = sensor(walls) @ "readings"
    return walls, readings


@gen
def _poses_map_and_readings(pose_prior: GenerativeFunction, prior: _WallPrior, sensor: PoseSensor) -> Any:
    """Draw poses, a map and its readings."""
    poses = (pose_prior if isinstance(pose_prior, GenerativeFunctionClosure) else pose_prior()) @ "poses"
    walls = prior.generator() @ "walls"
    readings = sensor(walls, poses) @ "readings"
    return poses, walls, readings
