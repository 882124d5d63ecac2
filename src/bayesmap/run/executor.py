"""Where chains run: an executor takes the job of a posterior and gives back its chains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
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
    """All chains in this process, on its threads or its GPU."""

    def run(
        self,
        job: Job,
        resume: Chains | None,
        watch: Watch,
        on_checkpoint: Callable[[Chains], None] | None,
        checkpoint_every_s: float,
    ) -> Chains:
        """Run them here."""
        return run_chains(
            job, resume=resume, watch=watch, on_checkpoint=on_checkpoint, checkpoint_every_s=checkpoint_every_s
        )
