"""How long chains run."""

from __future__ import annotations

from dataclasses import dataclass

from bayesmap.samplers.sampler import Keep


@dataclass(frozen=True)
class Schedule:
    """How long to run: ``warmup`` sweeps that are not kept, then ``draws`` maps, ``thin`` sweeps apart."""

    warmup: int
    draws: int
    thin: int = 1

    @property
    def sweeps(self) -> int:
        """All sweeps of one chain."""
        return self.warmup + self.draws * self.thin

    @property
    def keep(self) -> Keep:
        """Which draws are kept."""
        return Keep(self.warmup, self.thin if self.draws else 0)
