"""Edit requests that propose new values. Their weight is the log Metropolis-Hastings ratio of the move."""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax.flatten_util import ravel_pytree

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.diff import Diff
from bayesmap.gen.edits import DiffAnnotate, Edited, EditRequest, EmptyRequest, Update
from bayesmap.gen.errors import BadArguments, format_address
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.selection import Selection
from bayesmap.gen.typing import PRNGKey


@dataclass
class Rejuvenate(EditRequest):
    """A request to propose new values from a generative function whose choices have the model's addresses."""

    proposal: GenerativeFunction
    # maps the old choices, or the new ones for the way back, to the proposal's arguments
    argument_mapping: Callable[[ChoiceMap], Any] = static()

    def edit(self, key: PRNGKey, trace: Trace, argdiffs: Any) -> Edited:
        """Return the trace with the proposed values. The weight includes both densities of the proposal."""
        propose_key, edit_key = jax.random.split(key)
        old = trace.get_choices()
        proposed, forward, _ = self.proposal.propose(propose_key, self.argument_mapping(old))
        new, weight, retdiff, _ = Update(proposed).edit(edit_key, trace, argdiffs)
        backward, _ = self.proposal.assess(proposed & old, self.argument_mapping(new.get_choices()))
        return new, weight + backward - forward, retdiff, self


@dataclass
class HMC(EditRequest):
    """A request for Hamiltonian Monte Carlo on the selected choices, which must be real.
    A proposal makes `L` leapfrog steps of size `eps`: equations 5.18 to 5.20 of Neal, MCMC using Hamiltonian dynamics
    (2011). Acceptance with probability min(1, exp(weight)) leaves the posterior invariant for any step size.
    """

    selection: Selection
    eps: Any
    L: int = static(default=10)

    def edit(self, key: PRNGKey, trace: Trace, argdiffs: Any) -> Edited:
        """Return the trace at the end of the leapfrog steps. Raises TypeError if a selected choice is not real."""
        momentum_key, edit_key = jax.random.split(key)
        # Move the trace to the new arguments, and check that the selected choices are real.
        current, args_weight, _, _ = EmptyRequest().edit(edit_key, trace, argdiffs)
        args = Diff.tree_primal(argdiffs)
        choices = current.get_choices()
        start = choices.filter(self.selection)
        for path in start.paths():
            dtype = jnp.result_type(start[path])
            if not jnp.issubdtype(dtype, jnp.floating):
                raise TypeError(f"HMC moves real choices; {format_address(path)} has dtype {dtype}")

        def log_density(values: ChoiceMap) -> Any:
            return current.get_gen_fn().assess(values | choices, args)[0]

        flat, unflatten = ravel_pytree(start)  # the momentum of all choices is drawn by one call, which is faster
        momentum = unflatten(jax.random.normal(momentum_key, flat.shape, flat.dtype))

        def add_scaled(tree: Any, direction: Any, scale: Any) -> Any:
            return jax.tree.map(lambda x, d: x + scale * d, tree, direction)

        def leapfrog(_: Any, state: Any) -> Any:
            """Do a position step and a whole momentum step: two half steps of successive leapfrog steps."""
            position, momentum, _ = state
            position = add_scaled(position, momentum, self.eps)
            gradient = jax.grad(log_density)(position)
            return position, add_scaled(momentum, gradient, self.eps), gradient

        # Half a momentum step, L steps, and half a momentum step back.
        gradient = jax.grad(log_density)(start)
        state = (start, add_scaled(momentum, gradient, self.eps / 2), gradient)
        position, final, gradient = jax.lax.fori_loop(0, self.L, leapfrog, state)
        final = add_scaled(final, gradient, -self.eps / 2)
        new, weight, retdiff, _ = Update(position).edit(edit_key, current, Diff.no_change(args))
        return new, args_weight + weight + _kinetic(momentum) - _kinetic(final), retdiff, self


def _kinetic(momentum: Any) -> Any:
    """Return the kinetic energy of momenta with unit mass."""
    return sum(0.5 * jnp.sum(p**2) for p in jax.tree.leaves(momentum))


def mala(selection: Selection, eps: Any) -> HMC:
    """Return a Metropolis-adjusted Langevin request: one leapfrog step, with drift eps^2 / 2 times the gradient."""
    return HMC(selection, eps, 1)


def SafeHMC(selection: Selection, eps: Any, L: int = 10) -> DiffAnnotate:
    """Return an `HMC` request that raises BadArguments if the return value depends on a selected choice."""
    return HMC(selection, eps, L).map(_unchanged)


def _unchanged(retdiff: Any) -> Any:
    """Return `retdiff`; raise BadArguments unless all of it is marked unchanged."""
    if not Diff.static_check_no_change(retdiff):
        raise BadArguments("SafeHMC: the return value depends on a selected choice")
    return retdiff
