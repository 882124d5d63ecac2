"""Groups of arguments of `bayesmap.infer` and `bayesmap.slam`.

`Schedule` says how long chains run, `Where` on which threads and devices, and `Checkpoints` what is resumed and saved.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bayesmap.errors import BadInput, check_count
from bayesmap.run.chains import PRECISION
from bayesmap.run.runner import Executor

if TYPE_CHECKING:
    from bayesmap.poses.trajectory import InferredTrajectory
    from bayesmap.result import Run

CHECKPOINT_S = 30.0  # default number of seconds between two checkpoints
MORE_DRAWS = 10  # factor on the default number of draws if the precision is below the default, or has no limit


def need_value(function: str, name: str, value: object, kind: type) -> None:
    """Raise `BadInput`, with an example, for an argument that is not of the class ``kind``."""
    if not isinstance(value, kind):
        raise BadInput(f"{function}: {name} must be one such as bm.{kind.__name__}(), got {value!r}")


@dataclass(frozen=True)
class Schedule:
    """The number of chains, and their numbers of sweeps and draws.

    Attributes:
        chains: Markov chains; the methods without chains give ``chains * draws`` independent draws.
        warmup: sweeps of each chain that are not kept.
        draws: largest number of maps per chain; ``precision`` usually ends the chains sooner. None: 1000 for binary
            walls; 0 for "propagate", which returns marginals; 100 to 200 for `Beta` and `Surface` (50 to 200 if
            ``thin`` is 1). Those are larger, and mix faster. Fewer beams give more (`CellPrior.default_draws`).
        thin: sweeps between kept maps. None: 3 for `Beta` and `Surface` if ``draws`` is None, else 1; in `slam` 1.
        precision: Monte Carlo standard error of the mean map at which chains stop: 99 of 100 observed cells have this
            error or less (`bayesmap.run.chains.map_error`). None: 0.03, but no limit if ``draws`` is given. A value
            below 0.03 allows up to ten times the default number of draws.
        seconds: time after which chains stop with the draws that they have, at least two each, counted from the start
            of the inference. A slow map has a shorter warm-up then. Without ``precision`` or ``draws``, chains use all
            of the time. Draws equal the draws of a longer run, but their number depends on the machine. None: no limit.

    Raises `BadInput` for a count that is not whole or is too small, or a precision or time that is not positive.
    """

    chains: int = 4
    warmup: int = 100
    draws: int | None = None
    thin: int | None = None
    precision: float | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        for name, minimum in {"chains": 1, "warmup": 0, "draws": 0, "thin": 1}.items():
            value = getattr(self, name)
            if value is not None or name in ("chains", "warmup"):  # None is a value of the others
                object.__setattr__(self, name, check_count("Schedule", name, value, minimum))
        if self.precision is not None and not self.precision > 0:
            raise BadInput(f"Schedule: precision must be a positive probability, such as 0.03, got {self.precision!r}")
        if self.seconds is not None and not self.seconds > 0:
            raise BadInput(f"Schedule: seconds must be a positive number, such as 60, got {self.seconds!r}")

    def completed(self, sweeps_a_draw: int, default_draws: Callable[[int], int]) -> "Schedule":
        """Return the schedule with ``thin``, ``draws`` and ``precision``, by the defaults of the kind of cells."""
        default_thin = sweeps_a_draw if self.draws is None else 1
        thin = default_thin if self.thin is None else self.thin
        if self.draws is not None:
            return replace(self, thin=thin)
        precision = PRECISION if self.precision is None and self.seconds is None else self.precision
        factor = MORE_DRAWS if precision is None or precision < PRECISION else 1
        return replace(self, draws=default_draws(thin) * factor, thin=thin, precision=precision)


@dataclass(frozen=True)
class Where:
    """The threads, device and executor of a run. Except for the last bits on another kind of device, draws ignore them.

    Attributes:
        threads: number of chains that run at once, and of threads of belief propagation; None: all cores. The beam
            table is always built on all cores.
        device: "cpu", or a CUDA device such as "cuda:0".
        executor: object that runs the chains, such as `RayExecutor`; None: this process.
        any_size: whether to begin a run that will not fit into memory by its estimate (`bayesmap.run.cost`).

    Raises `BadInput` for less than one thread, an invalid device, or an object that is no executor.
    """

    threads: int | None = None
    device: str = "cpu"
    executor: Executor | None = None
    any_size: bool = False

    def __post_init__(self) -> None:
        if self.threads is not None:
            object.__setattr__(self, "threads", check_count("Where", "threads", self.threads, 1))
        if not isinstance(self.device, str):
            raise BadInput(f"Where: device must be a name such as 'cpu' or 'cuda:0', got {self.device!r}")
        executor = self.executor
        if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "run", None))):
            expected = "one such as bm.RayExecutor(), or None for this process"
            raise BadInput(f"Where: executor must be {expected}, got {executor!r}")


@dataclass(frozen=True, eq=False)
class Checkpoints:
    """The run to resume, and how to save a run while it continues.

    Attributes:
        resume: stopped run to resume, made with the same arguments. The result equals an unstopped run, bit for bit.
        save: function called with the run so far at the end of warm-up and every ``every_s`` seconds, such as
            ``lambda run: run.save("run.nc")``.
        every_s: seconds between two calls of ``save``; more if ``save`` is so slow that it would delay the chains.
        stages: folder for the finished stages of the trajectory, for `slam`; existing stages are reused.
        preview: function called within seconds of the start with a run of one draw, a first rough map; not called if
            the chains resume.
        trajectory: function called by `slam` with the approximate trajectory of all scans, before the map is inferred.

    Raises `BadInput` for an object that is no run, a callback that is no function, or a negative number of seconds.
    """

    resume: "Run | None" = None
    save: "Callable[[Run], None] | None" = None
    every_s: float = CHECKPOINT_S
    stages: str | os.PathLike[str] | None = None
    preview: "Callable[[Run], None] | None" = None
    trajectory: "Callable[[InferredTrajectory], None] | None" = None

    def __post_init__(self) -> None:
        if self.resume is not None and not hasattr(self.resume, "posterior"):
            raise BadInput(f"Checkpoints: resume must be a run, such as bm.load('run.nc'), got {self.resume!r}")
        for name, argument in (("save", "run"), ("preview", "run"), ("trajectory", "trajectory")):
            callback = getattr(self, name)
            if callback is not None and not callable(callback):
                raise BadInput(f"Checkpoints: {name} must be a function that takes a {argument}, got {callback!r}")
        if not self.every_s >= 0:
            raise BadInput(f"Checkpoints: every_s must be 0 or a positive number of seconds, got {self.every_s!r}")
