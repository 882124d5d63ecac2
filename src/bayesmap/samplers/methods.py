"""Methods of inference: the values by which users choose one, and the sampler that each names.

`CellPrior.methods` maps a method's name to the name of a sampler, a key of `WALL_SAMPLERS`, `OTHER_SAMPLERS` or
`INDEPENDENT_SAMPLERS`. `resolve_method` finds this name, and `make_sampler` builds a Markov chain sampler by it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, get_args

from bayesmap.errors import BadInput, check_count
from bayesmap.samplers import without_chains
from bayesmap.samplers.merge_moves import EARLY_SHARE
from bayesmap.samplers.metropolis import Metropolis
from bayesmap.samplers.sampler import Sampler, Watch
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import Order, Start, WallBlocks, WallGibbs, WallSampler, default_start
from bayesmap.samplers.without_chains import ROUNDS, DrawRequest, IndependentDraws
from bayesmap.space.arrays import Floats, Mask
from bayesmap.space.grid import Grid

PARTICLES = 100_000  # default of `Importance`


@dataclass(frozen=True, eq=False)
class Gibbs:
    """Draw single cells from their conditionals, sweep after sweep: the default of all kinds of cells.

    Reflectivities and surfaces have no order, start or rounds. Raises `BadInput` for other orders, starts or rounds.

    Attributes:
        order: order of the cells in a sweep: "radial", "raster" or "random".
        start: "prior", "zeros", "ones", "propagate", a map (nx, ny), or one map per chain, (chains, nx, ny). None:
            "propagate" on maps of more than 10 000 cells, and "prior" on others.
        start_poses: first poses if poses are unknown, one trajectory per chain, (chains, S, 3). None: prior draws.
        rounds: most rounds of belief propagation, for a start from it.
    """

    order: Order = "radial"
    start: Start | Mask | None = None
    start_poses: Floats | None = None
    rounds: int = ROUNDS
    name: ClassVar[str] = "gibbs"

    def __post_init__(self) -> None:
        kind = type(self).__name__
        if self.order not in get_args(Order):
            raise BadInput(f"{kind}: order must be one of {', '.join(get_args(Order))}, got {self.order!r}")
        if isinstance(self.start, str) and self.start not in get_args(Start):
            raise BadInput(f"{kind}: start must be one of {', '.join(get_args(Start))} or a map, got {self.start!r}")
        check_count(kind, "rounds", self.rounds, 1)


@dataclass(frozen=True, eq=False)
class Block(Gibbs):
    """Draw overlapping blocks of 2 x 2 binary cells, with the options of `Gibbs`: rare walls mix faster."""

    name: ClassVar[str] = "block"


@dataclass(frozen=True)
class Propagate:
    """Approximate marginals of binary walls by beliefs along beams, in up to ``rounds`` rounds. `BadInput` below 1."""

    rounds: int = ROUNDS
    name: ClassVar[str] = "propagate"

    def __post_init__(self) -> None:
        check_count("Propagate", "rounds", self.rounds, 1)


@dataclass(frozen=True)
class Importance:
    """Weigh ``particles`` prior maps of binary walls, for teaching: the weights collapse. Raises `BadInput` below 1."""

    particles: int = PARTICLES
    name: ClassVar[str] = "importance"

    def __post_init__(self) -> None:
        check_count("Importance", "particles", self.particles, 1)


@dataclass(frozen=True)
class Exact:
    """Enumerate all maps, for binary walls: 16 unknown cells at most."""

    name: ClassVar[str] = "exact"


Method = Gibbs | Block | Propagate | Importance | Exact
METHODS: Mapping[str, type[Method]] = {kind.name: kind for kind in (Gibbs, Block, Propagate, Importance, Exact)}

WALL_SAMPLERS: Mapping[str, type[WallSampler]] = {"wall-gibbs": WallGibbs, "wall-blocks": WallBlocks}
OTHER_SAMPLERS: Mapping[str, Callable[[], Sampler[Any, Any]]] = {"stop-gibbs": StopGibbs, "metropolis": Metropolis}
INDEPENDENT_SAMPLERS: Mapping[str, Callable[[WallProblem, DrawRequest, Watch], IndependentDraws]] = {
    "exact": without_chains.draw_by_enumeration, "importance": without_chains.draw_by_importance,
    "propagate": without_chains.draw_by_propagation,
}  # fmt: skip


def resolve_method(method: Method | str | None, samplers: Mapping[str, str], kind: str) -> tuple[str, Method]:
    """Return the name of a method, and the method with its options; None gives the first of the kind of cells.
    ``samplers`` maps the names of the kind's methods to their samplers. Raises `BadInput` for another method.
    """
    if method is None:
        method = next(iter(samplers))
    name = method if isinstance(method, str) else getattr(method, "name", "")
    if name not in samplers or isinstance(method, type):
        words = f"one method, {next(iter(samplers))!r}" if len(samplers) == 1 else f"the methods {', '.join(samplers)}"
        raise BadInput(f"infer: {kind} has {words}, got {method!r}")
    return name, METHODS.get(name, Gibbs)() if isinstance(method, str) else method


def make_sampler(name: str, grid: Grid, method: Gibbs, warmup: int = 0) -> Sampler[Any, Any]:
    """Return the Markov chain sampler of a name. Surfaces merge during ``warmup`` sweeps; with 0 they do not merge."""
    if name == "stop-gibbs":
        return StopGibbs(int(EARLY_SHARE * warmup))
    if name in OTHER_SAMPLERS:
        return OTHER_SAMPLERS[name]()
    start = default_start(grid) if method.start is None else method.start
    return WALL_SAMPLERS[name](method.order, start, method.rounds)


def sampler_options(name: str, grid: Grid, method: Method) -> dict[str, Any]:
    """Return the order and the start of a sampler, as the settings of a run have them."""
    if name in OTHER_SAMPLERS:
        return {"order": None, "start": "readings" if name == "stop-gibbs" else "prior"}
    start = getattr(method, "start", None)
    if start is None:
        start = default_start(grid)
    return {"order": getattr(method, "order", Gibbs.order), "start": start if isinstance(start, str) else "given map"}
