# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Neither is known
#
# First the [walls](mapping.md) were unknown, then the [pose](localization.md). A robot that explores has neither: it
# does not know the map, and of its poses it knows only what its wheels have told it. To find both at once is called
# *simultaneous localization and mapping*. As a probabilistic program it is the two models put together: a prior over
# poses, a prior over walls, and readings that depend on both.
#
# Code that only draws a figure or checks what the text says is folded away. In lines that begin with `time:` measured
# figures are rounded.

# %%
import time

import jax
import jax.numpy as jnp
import jax.random as jrand
import numpy as np
from drawing import panels, show

import bayesmap as bm
from bayesmap import gen, viz
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.viz.palette import CHAINS, SENSOR, TRUTH

# %% [markdown]
# ## The model
#
# The robot scans at eight places. Its guess of each pose is normally distributed around the truth, with a standard
# deviation of 0.4 m in x and y and of 0.06 rad, three and a half degrees. Of the first pose it is sure, for it is the
# place from which it counts. Walls are rare, and the sensor is that of the pages before: a hundred beams, 0.2 m of
# noise.
#
# `bm.mapping_model` takes a generative function in place of known poses. Then the poses are choices of the model too, at
# the address `"poses"`.

# %%
SIGMA_M, P_WALL, MAX_RANGE_M = 0.2, 0.05, 42.0
true_walls, middle = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
angles_rad = np.arange(100) / 100 * 2 * np.pi
places = [(10, 10), (12.5, 8.3), (10.2, 6.1), (7.6, 4.4), (4.8, 6.2), (5.2, 9.7), (7.1, 12.3), (9.6, 13.6)]
true_poses = np.array([[x, y, 0.7 * k] for k, (x, y) in enumerate(places)])
scans = bm.simulate(
    true_walls, grid, true_poses, angles_rad, sensor=bm.Gaussian(SIGMA_M), max_range_m=MAX_RANGE_M, seed=0
)

S = len(true_poses)
SPREAD = jnp.array([[1e-3, 1e-3, 1e-3]] + [[0.4, 0.4, 0.06]] * (S - 1))
guesses = jnp.asarray(true_poses) + SPREAD * jrand.normal(jrand.key(0), (S, 3))

pose_prior = gen.mv_normal_diag.vmap()(guesses, SPREAD)
model = bm.mapping_model(
    grid, pose_prior, angles_rad, bm.Independent(P_WALL), bm.Gaussian(SIGMA_M), max_range_m=MAX_RANGE_M
)
readings = C["readings"].set(scans.ranges_m)
print(model.simulate(jrand.key(1), ()))


def off_m(poses):
    """Distance in metres from the true places, (..., S)."""
    return np.linalg.norm(np.asarray(poses)[..., :2] - true_poses[:, :2], axis=-1)


print(f"the guessed poses are {off_m(guesses)[1:].mean():.2f} m off on average")

# %% [markdown]
# ## The guesses taken for granted
#
# What if we take the guesses for the truth, and infer the walls alone? `bm.infer` does it with blocks of cells, once
# with the true poses and once with the guessed ones.

# %%


def walls_given(poses):
    """The posterior of the walls at known poses."""
    known = bm.Scans(poses, angles_rad, scans.ranges_m, MAX_RANGE_M)
    return bm.infer(
        known, grid, prior=bm.Independent(P_WALL), sensor=bm.Gaussian(SIGMA_M), method="block", warmup=200, draws=300
    )


def wrong_cells(occupancy):
    """Cells seen by some beam that are a wall with probability over 0.9 and free in truth, or the other way round."""
    sure = (occupancy < 0.1) | (occupancy > 0.9)
    return int((seen & sure & ((occupancy > 0.5) != true_walls)).sum())


at_truth, at_guesses = walls_given(true_poses), walls_given(np.asarray(guesses))
seen = at_truth.observed
for name, run in (("true", at_truth), ("guessed", at_guesses)):
    print(f"{name} poses: {wrong_cells(run.occupancy)} of {seen.sum()} cells surely wrong; ", end="")
    print(f"log likelihood of the readings {np.median(run.posterior.log_likelihood):.0f}")

# %% [markdown]
# With wrong poses the map is wrong, and sure of it. The log likelihood shows that something is amiss: no map explains
# these readings from these poses.
#
# ## Poses and walls together
#
# A trace of the model has both. We go on as on the pages before, by edits, in turns:
#
# - *walls*: a Gibbs sweep over blocks of 2 x 2 cells. `SetCells` is a request that changes some cells at once; the 16
#   states of a block are scored by 16 edits, and one of them is drawn.
# - *poses*: for each scan some Metropolis-Hastings moves. An edit of one pose by `IndexRequest` visits the beams of that
#   scan, and of no other: they walk through the map as it is.

# %%
BLOCKS = jnp.asarray((np.arange(16)[:, None] >> np.arange(4) & 1).astype(bool))  # (16, 4)


def cell_update(key, trace, k):
    """Draw a cell given all else, by the edit that flips it."""
    i, j = k // 21, k % 21
    flip = gen.IndexRequest(j, gen.Update(C.v(~trace.get_choices()["walls"][i, j])))
    flipped, change, _, _ = trace.edit(key, gen.StaticRequest({"walls": gen.IndexRequest(i, flip)}))
    return jax.lax.cond(gen.bernoulli.sample(key, logits=change), lambda: flipped, lambda: trace)


def block_update(key, trace, k):
    """Draw a block of 2 x 2 cells given all else, by 16 edits."""
    i, j = k // 20 + jnp.array([0, 0, 1, 1]), k % 20 + jnp.array([0, 1, 0, 1])

    def to(state):
        return gen.StaticRequest({"walls": SetCells(i, j, state)})

    changes = jax.lax.map(lambda state: trace.edit(key, to(state))[1], BLOCKS)
    return trace.edit(key, to(BLOCKS[gen.categorical.sample(key, logits=changes)]))[0]


STEP = jnp.array([0.05, 0.05, 0.007])


def pose_update(key, trace, s):
    """Propose another pose for scan s, and accept or reject it."""
    scale = STEP * jnp.exp(jrand.normal(key))  # now a small step, now a large one
    nearby = trace.get_choices()["poses"][s] + scale * jrand.normal(jrand.fold_in(key, 1), (3,))
    request = gen.StaticRequest({"poses": gen.IndexRequest(s, gen.Update(C.v(nearby)))})
    return gen.metropolis_hastings(request)(jrand.fold_in(key, 2), trace)[0]
