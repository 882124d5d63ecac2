"""Where chains run: an executor takes the job of a posterior and returns its chains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from bayesmap.run.chains import Chains
from bayesmap.run.runner import Job, run_chains
from bayesmap.samplers.progress import Watch


class Executor(Protocol):
    """Runs the chains of a job, wherever."""

    def run(
        self,
        job: Job,
        resume: Chains | None,
        watch: Watch,
        on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:
        """All chains of the job, in the order of their numbers; see `bayesmap.run.runner.run_chains`."""


@dataclass(frozen=True)
class ThreadExecutor:
    """Runs all chains in this process, on its threads or its GPU.

    Attributes:
        should_stop: asked between two steps, beside the watch of the run.
    """

    should_stop: Callable[[], bool] = lambda: False

    def run(
        self,
        job: Job,
        resume: Chains | None,
        watch: Watch,
        on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:
        """Run the chains here."""
        both = replace(watch, should_stop=lambda: watch.should_stop() or self.should_stop())
        return run_chains(
            job, resume=resume, watch=both, on_checkpoint=on_checkpoint, checkpoint_every_s=checkpoint_every_s
        )
