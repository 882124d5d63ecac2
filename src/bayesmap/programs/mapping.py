"""The mapping model as a generative function: walls from the prior, readings from the sensor.

    model = bm.mapping_model(grid, pose, angles_rad, bm.Independent(0.5), bm.Gaussian(0.2), max_range_m=42.0)
    trace, weight = model.importance(key, C["readings"].set(ranges_m), ())

It describes the same joint law of walls and readings as `bayesmap.infer`, for programs of one's own. Poses may be
unknown too: give a generative function that draws them in place of an array.

An edit of several cells at once, such as a 2 x 2 block.
"""

from __future__ import annotations

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
from bayesmap.programs.beam_sensor import BeamSensor, beam_geometry
from bayesmap.programs.pose_sensor import PoseSensor
from bayesmap.programs.reading_law import reading_law
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import as_angles, as_poses, check_limits


@dataclass
class SetCells(EditRequest):
    """Give the cells (i[k], j[k]) of a map the values `values[k]`: a request for the address "walls".

    A block is `SetCells(i + jnp.array([0, 0, 1, 1]), j + jnp.array([0, 1, 0, 1]), values)`. The work is that of
    changing the cells one by one, beams included.

    Attributes:
        i, j: cells, integers, shape (k,); the shape is known when the program is compiled, the cells need not be.
        values: shape (k,).
    """

    i: Any
    j: Any
    values: Any

    def edit(self, key: PRNGKey, trace: Trace, argdiffs: Any) -> Edited:
        """Edit one cell after the other. Undone by the same request with the old values."""
        i, j, values = jnp.broadcast_arrays(*map(jnp.atleast_1d, (self.i, self.j, self.values)))
        old = trace.get_retval()[i, j]
        weight = jnp.zeros(())
        for row, column, value in zip(i.ravel(), j.ravel(), values.ravel(), strict=True):
            request = IndexRequest(row, IndexRequest(column, Update(ChoiceMap.choice(value))))
            trace, gain, _, _ = trace.edit(key, request, argdiffs)
            argdiffs = Diff.no_change(Diff.tree_primal(argdiffs))
            weight += gain
        return trace, weight, Diff.tree(trace.get_retval(), IndexChange((i, j))), SetCells(i, j, old)


def mapping_model(
    grid: Grid,
    poses: ArrayLike | GenerativeFunction,
    angles_rad: ArrayLike,
    prior: Independent,
    sensor: SensorModel,
    *,
    max_range_m: float,
    min_range_m: float = 0.0,
    hit_depth: float = 0.0,
) -> StaticGenerativeFunction:
    """A generative function without arguments: the joint law of a map and the readings taken in it.

    Its choices are

    - "walls", shape (nx, ny), bool;
    - "readings", metres, float, shape (A,) for a single pose of shape (3,), else (S, A): the ranges of `Scans`,
      typed readings included (`inf` no return, `-inf` too close, NaN invalid);

    and it returns both. An edit of one wall costs time in proportion to the beams through that cell. Make a model
    once, and use it many times: the beams are traced here.

    If `poses` is a generative function, the poses are unknown, and it is their prior:

        guesses, sigma = jnp.array([[1.0, 2.0, 0.0], [1.5, 2.0, 0.1]]), jnp.array([0.3, 0.3, 0.05])
        poses = gen.mv_normal_diag.vmap(in_axes=(0, None))(guesses, sigma)

    Then there is one more choice, "poses" (drawn first; its addresses are those of the prior), and the function returns
    (poses, walls, readings). An edit of a pose visits the beams of that scan alone, and walks them through the map as
    it is; an edit of a wall asks of every beam whether it crosses the cell.

    Args:
        grid: where the cells are.
        poses: (x, y, yaw) in the world frame, metres and radians, shape (3,) or (S, 3); or a generative function
            without arguments that returns such an array.
        angles_rad: beam angles in the sensor frame, shape (A,).
        prior: of the walls.
        sensor: the law of the readings: Gaussian, StudentT or BeamMixture.
        max_range_m: the sensor's largest range.
        min_range_m: the sensor's smallest range.
        hit_depth: where in a cell a beam stops, as a fraction of its chord: 0 at the near edge, as in the tutorial.

    Raises:
        BadInput: shapes that do not fit, numbers that are not finite, a sensor without likelihood on JAX, or a prior
            that couples neighbours.
    """
    remedy = "use infer, or write a program that draws its walls and gives them to sensor_model"
    prior = Independent.of(prior, "mapping_model", remedy)
    walls = _Walls(_Fixed(prior.probabilities(grid)))
    if isinstance(poses, GenerativeFunction):
        _check_pose_prior(poses)
        moving = pose_sensor_model(
            grid, angles_rad, sensor, max_range_m=max_range_m, min_range_m=min_range_m, hit_depth=hit_depth
        )
        return _poses_map_and_readings.partial_apply(poses, walls, moving)
    beams = sensor_model(
        grid, poses, angles_rad, sensor, max_range_m=max_range_m, min_range_m=min_range_m, hit_depth=hit_depth
    )
    return _map_and_readings.partial_apply(walls, beams)


def sensor_model(
    grid: Grid,
    poses: ArrayLike,
    angles_rad: ArrayLike,
    sensor: SensorModel,
    *,
    max_range_m: float,
    min_range_m: float = 0.0,
    hit_depth: float = 0.0,
) -> BeamSensor:
    """The sensor alone: a generative function of the walls, shape (nx, ny), with the readings as its only choice.

    For models with a prior of one's own:

        @gen
        def model():
            walls = my_prior() @ "walls"
            return sensor(walls) @ "readings"

    Arguments and errors as for `mapping_model`.
    """
    many, angles = as_poses(poses), as_angles(angles_rad)
    check_limits(min_range_m, max_range_m)
    limits = RangeLimits(float(min_range_m), float(max_range_m))
    shape = (len(angles),) if np.ndim(poses) == 1 else (len(many), len(angles))
    return BeamSensor(beam_geometry(grid, many, angles, limits, hit_depth), reading_law(sensor, limits), shape)


def pose_sensor_model(
    grid: Grid,
    angles_rad: ArrayLike,
    sensor: SensorModel,
    *,
    max_range_m: float,
    min_range_m: float = 0.0,
    hit_depth: float = 0.0,
) -> PoseSensor:
    """The sensor alone where poses are unknown: a generative function of walls (nx, ny) and poses (3,) or (S, 3).

    For models with priors of one's own, or with known walls (localization):

        @gen
        def model(walls):
            pose = my_prior() @ "pose"
            return sensor(walls, pose) @ "readings"

    Arguments and errors as for `mapping_model`.
    """
    angles = as_angles(angles_rad)
    check_limits(min_range_m, max_range_m)
    limits = RangeLimits(float(min_range_m), float(max_range_m))
    return PoseSensor(grid, tuple(angles.tolist()), reading_law(sensor, limits), float(hit_depth))


def _check_pose_prior(prior: GenerativeFunction) -> None:
    """Raise BadInput unless it returns poses."""
    try:
        drawn = jax.eval_shape(lambda key: prior.simulate(key, ()).get_retval(), jax.random.key(0))
    except TypeError as error:
        raise BadInput(f"mapping_model: the prior of the poses must run without arguments; it says: {error}") from None
    shape = getattr(drawn, "shape", None)
    if shape is None or len(shape) not in (1, 2) or shape[-1] != 3:
        raise BadInput(f"mapping_model: the prior of the poses must return an array (3,) or (S, 3), found {drawn}")


class _Fixed:
    """An array compared by content, so that it may be a static part of JAX's trees."""

    def __init__(self, array: NDArray[np.float64]) -> None:
        self.array = np.ascontiguousarray(array)
        self.content = (self.array.shape, self.array.tobytes())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Fixed) and self.content == other.content

    def __hash__(self) -> int:
        return hash(self.content)

    def __repr__(self) -> str:
        return f"array{self.array.shape}"


@dataclass
class _Walls(Pytree):
    """The prior of the walls."""

    p_wall: _Fixed = static()

    def draw(self) -> Any:
        """The call that draws them. One probability is kept as one number: edits then touch no array of them."""
        p = self.p_wall.array
        if (p == p[0, 0]).all():
            return flip.repeat(n=p.shape[1]).repeat(n=p.shape[0])(float(p[0, 0]))
        return flip.vmap(in_axes=(0,)).vmap(in_axes=(0,))(jnp.asarray(p, jnp.result_type(float)))


@gen
def _map_and_readings(prior: _Walls, sensor: BeamSensor) -> Any:
    walls = prior.draw() @ "walls"
    readings = sensor(walls) @ "readings"
    return walls, readings


@gen
def _poses_map_and_readings(pose_prior: GenerativeFunction, prior: _Walls, sensor: PoseSensor) -> Any:
    poses = (pose_prior if isinstance(pose_prior, GenerativeFunctionClosure) else pose_prior()) @ "poses"
    walls = prior.draw() @ "walls"
    readings = sensor(walls, poses) @ "readings"
    return poses, walls, readings
