"""NumPyro's single-site Gibbs on the tutorial's map: what a good general-purpose sampler makes of it.

`numpyro.infer.DiscreteGibbs` (0.22) visits the 441 binary sites in a random order and evaluates the whole
model once an update, the energy of the current state being known. It gets its best fair chance: the
geometry is computed once, before the chain, and the model only looks up distances.

- `dense`: a table of the distance from every beam to every cell, (100, 441), infinite where the beam
  passes by. The plain way to write it.
- `sparse`: only the cells that a beam crosses, nearest first, padded to the longest beam. What someone
  would write who knows where the time goes.

Run it with an interpreter that has NumPyro 0.22 (`python -m benchmarks.environments numpyro` makes one):
`python numpyro_discrete_gibbs.py --case sparse --repeats 5 --json`.
"""

from collections.abc import Callable

import harness
import jax
import jax.numpy as jnp
import numpy as np
import numpyro
import numpyro.distributions as dist
from numpyro.infer import DiscreteGibbs
from numpyro.infer.util import log_density

GRID_SIZE = 21
CENTER = 10.0
NUM_BEAMS = 100
MAX_RANGE = 42.0
SENSOR_NOISE = 0.2

Ranges = Callable[[jax.Array], jax.Array]
"""From the walls, (441,) of 0 and 1, to the exact range of every beam, (100,)."""


def distance_table() -> np.ndarray:
    """The distance at which every beam would hit every cell, (100, 441); infinite where it passes by.

    A beam meets a closed unit square between the later of its two entries into the slabs and the earlier
    of its two exits. From inside the sensor's own cell the hit is the exit edge, as in the tutorial.
    """
    angle = np.arange(NUM_BEAMS) / NUM_BEAMS * 2 * np.pi
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    cells = np.stack(np.meshgrid(*[np.arange(GRID_SIZE)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    offset = (cells - CENTER)[None, :, :]
    half = np.copysign(0.5, direction)[:, None, :]
    with np.errstate(divide="ignore"):  # along an axis a slab is entered at -inf and left at +inf, or never
        entry = ((offset - half) / direction[:, None, :]).max(axis=2)
        leave = ((offset + half) / direction[:, None, :]).min(axis=2)
    hit = (entry <= leave) & (leave >= 0.0)
    return np.where(hit, np.where(entry >= 0.0, entry, leave), np.inf)


def dense_ranges(table: np.ndarray) -> Ranges:
    """The nearest wall of each beam as a minimum over all cells."""
    distances = jnp.asarray(table, dtype=jnp.float32)

    def ranges(walls: jax.Array) -> jax.Array:
        return jnp.minimum(jnp.where(walls[None, :] > 0, distances, jnp.inf).min(axis=1), MAX_RANGE)

    return ranges


def sparse_ranges(table: np.ndarray) -> Ranges:
    """The nearest wall of each beam as a minimum over the cells that it crosses."""
    length = int(np.isfinite(table).sum(axis=1).max())
    cells = np.argsort(table, axis=1, kind="stable")[:, :length]
    distances = jnp.asarray(np.take_along_axis(table, cells, axis=1), dtype=jnp.float32)
    cells = jnp.asarray(cells)

    def ranges(walls: jax.Array) -> jax.Array:
        return jnp.minimum(jnp.where(walls[cells] > 0, distances, jnp.inf).min(axis=1), MAX_RANGE)

    return ranges


def make_model(ranges: Ranges, readings: np.ndarray, prior: float) -> Callable[[], None]:
    """The tutorial's model: independent walls, and readings with Gaussian noise around the exact ranges."""
    observed = jnp.asarray(readings)

    def model() -> None:
        with numpyro.plate("cells", GRID_SIZE * GRID_SIZE):
            walls = numpyro.sample("walls", dist.Bernoulli(prior))
        with numpyro.plate("beams", NUM_BEAMS):
            numpyro.sample("readings", dist.Normal(ranges(walls), SENSOR_NOISE), obs=observed)

    return model


def chain(make_ranges: Callable[[np.ndarray], Ranges], sweeps: int) -> Callable[[float], harness.Ready]:
    """A case: a chain of `DiscreteGibbs` sweeps from an empty map, `sweeps` of them in one compiled scan."""

    def prepare(prior: float) -> harness.Ready:
        _, readings = harness.load_tutorial_data()
        kernel = DiscreteGibbs(make_model(make_ranges(distance_table()), readings, prior))
        empty = {"walls": jnp.zeros(GRID_SIZE * GRID_SIZE, dtype=int)}
        state = kernel.init(jax.random.key(0), 0, empty, (), {})
        scan = jax.jit(
            lambda state: jax.lax.scan(lambda s, _: (kernel.sample(s, (), {}), None), state, length=sweeps)[0]
        )

        def advance() -> None:
            nonlocal state
            state = jax.block_until_ready(scan(state))

        return harness.Ready(advance, sweeps, lambda: int(state.z["walls"].sum()))

    return prepare


CASES = {
    "dense": harness.Case(chain(dense_ranges, 20), 0.5, "sweep of 441 sites, table of (beam, cell) distances"),
    "sparse": harness.Case(chain(sparse_ranges, 20), 0.5, "sweep of 441 sites, only the cells that a beam crosses"),
}


def log_joint(make_ranges: Callable[[np.ndarray], Ranges], walls: np.ndarray, prior: float) -> float:
    """log p(walls, readings) under NumPyro's model."""
    _, readings = harness.load_tutorial_data()
    model = make_model(make_ranges(distance_table()), readings, prior)
    return float(log_density(model, (), {}, {"walls": jnp.asarray(walls.ravel(), dtype=int)})[0])


def log_joint_of_truth(prior: float) -> float:
    """log p(true walls, readings): the same for everyone who runs this problem."""
    walls, _ = harness.load_tutorial_data()
    return log_joint(sparse_ranges, walls, prior)


def check() -> dict[str, object]:
    """Compare the geometry and the log joint with what GenJAX's own model gives, at prior 0.5."""
    walls, _ = harness.load_tutorial_data()
    i, j = np.indices(walls.shape)
    maps = {
        "empty map": (np.zeros_like(walls), -1337054.125),
        "true map": (walls, -288.75955),
        "true map, transposed": (walls.T, -503346.84375),
        "walls around the edge": (np.maximum(abs(i - CENTER), abs(j - CENTER)) == CENTER, -244862.78125),
    }
    answers = {"incidences": (int(np.isfinite(distance_table()).sum()), 1572)}
    for name, (state, expected) in maps.items():
        for case, make_ranges in [("dense", dense_ranges), ("sparse", sparse_ranges)]:
            answers[f"{name}, {case}"] = (log_joint(make_ranges, state, 0.5), expected)
    return {
        "passed": all(np.isclose(got, expected, rtol=1e-5) for got, expected in answers.values()),
        "answers": {name: {"got": got, "expected": expected} for name, (got, expected) in answers.items()},
    }


if __name__ == "__main__":
    harness.main(
        "numpyro",
        "NumPyro's DiscreteGibbs on the tutorial's map.",
        CASES,
        ("numpyro", "jax", "jaxlib", "numpy"),
        log_joint_of_truth,
        check,
    )
