"""Values that group the arguments of `bayesmap.infer` and `bayesmap.slam`: how long, where, and how a run is kept."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bayesmap.errors import BadInput, check_count
from bayesmap.run.runner import Executor

if TYPE_CHECKING:
    from bayesmap.result import Run

CHECKPOINT_S = 30.0
MORE_DRAWS = 10
"""So many times the default draws are made at most where a better precision is asked for."""


def need_value(function: str, name: str, value: object, kind: type) -> None:
    """Refuse an argument that is not of the class that groups it.

    Raises:
        BadInput: it is not; the message says what to write.
    """
    if not isinstance(value, kind):
        example = f"bm.{kind.__name__}()"
        raise BadInput(f"{function}: {name} must be one such as {example}, got {value!r}")


@dataclass(frozen=True)
class Schedule:
    """How many chains run, and for how long.

    Attributes:
        chains: Markov chains; the methods without chains give ``chains * draws`` independent draws.
        warmup: sweeps of each chain that are not kept.
        draws: maps that each chain keeps. None: as many as suit the cells: 1000 for binary walls; 100 to 200 for `Beta`
            and `Surface` (50 to 200 if ``thin`` is 1), whose draws are larger and mix in tens of sweeps, the
            more the fewer beams there are (`CellPrior.default_draws`); and 0 for "propagate", whose answer is the
            marginals. They are the most that chains make: as a rule ``precision`` ends them sooner.
        thin: sweeps from one kept map to the next. None: 3 for `Beta` and `Surface` where ``draws`` is None too, and 1
            otherwise; `slam` takes 1.

        precision: Monte Carlo standard error of the mean map at which chains stop: 99 of 100 observed cells have this
            much or less (`bayesmap.run.chains.map_error`). None: 0.03, but no limit where ``draws`` is given. Below
            0.03 up to ten times as many draws are made as without it.

    Raises:
        BadInput: a number that is not a whole number, or too small; a precision that is not positive.
    """

    chains: int = 4
    warmup: int = 100
    draws: int | None = None
    thin: int | None = None
    precision: float | None = None

    def __post_init__(self) -> None:
        for name, least in {"chains": 1, "warmup": 0, "draws": 0, "thin": 1}.items():
            value = getattr(self, name)
            if value is not None or name in ("chains", "warmup"):
                object.__setattr__(self, name, check_count("Schedule", name, value, least))
        if self.precision is not None and not self.precision > 0:
            raise BadInput(f"Schedule: precision must be a positive probability, such as 0.03, got {self.precision!r}")


@dataclass(frozen=True)
class Where:
    """Where the work is done. Draws do not depend on it, but for the last bits between kinds of devices.

    Attributes:
        threads: chains that run at once, and threads of belief propagation; None: all cores. The beam table is built on
            all cores in any case.
        device: "cpu", or a CUDA device such as "cuda:0".
        executor: where chains run, such as `RayExecutor`; None: in this process.

    Raises:
        BadInput: no threads, or something that runs no chains.
    """

    threads: int | None = None
    device: str = "cpu"
    executor: Executor | None = None

    def __post_init__(self) -> None:
        if self.threads is not None:
            object.__setattr__(self, "threads", check_count("Where", "threads", self.threads, 1))
        if not isinstance(self.device, str):
            raise BadInput(f"Where: device must be a name such as 'cpu' or 'cuda:0', got {self.device!r}")
        executor = self.executor
        if executor is not None and (isinstance(executor, type) or not callable(getattr(executor, "run", None))):
            raise BadInput(
                f"Where: executor must be one such as bm.RayExecutor(), or None for this process, got {executor!r}"
            )


@dataclass(frozen=True, eq=False)
class Checkpoints:
    """How a run is kept while it goes on, and from where it goes on.

    Attributes:
        resume: a run that was stopped early, made with the same arguments: go on where it stopped, bit for bit as if it
            had never stopped.
        save: called with the run so far at the end of warm-up and every ``every_s`` seconds, such as
            ``lambda run: run.save("run.nc")``.
        every_s: seconds from one call of ``save`` to the next; more where ``save`` takes so long that it would hold the
            chains up.
        stages: a folder for the finished stages of the trajectory, for `slam`; stages that are there already are taken.

    Raises:
        BadInput: something that is no run, or a negative number of seconds.
    """

    resume: Run | None = None
    save: Callable[[Run], None] | None = None
    every_s: float = CHECKPOINT_S
    stages: str | os.PathLike[str] | None = None

    def __post_init__(self) -> None:
        if self.resume is not None and not hasattr(self.resume, "posterior"):
            raise BadInput(f"Checkpoints: resume must be a run, such as bm.load('run.nc'), got {self.resume!r}")
        if self.save is not None and not callable(self.save):
            raise BadInput(f"Checkpoints: save must be a function that takes a run, got {self.save!r}")
        if not self.every_s >= 0:
            raise BadInput(f"Checkpoints: every_s must be 0 or a positive number of seconds, got {self.every_s!r}")
