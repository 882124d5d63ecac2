# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Neither is known
#
# First the [walls](mapping.md) were unknown, then the [pose](localization.md). A robot that explores knows neither the
# map nor its poses; the wheels report the poses only roughly. Inferring both together is called *simultaneous
# localization and mapping*. The probabilistic program joins the two models: a prior over poses, a prior over walls, and
# readings that depend on both.
#
# **After this page you will be able to**
#
# - write a model in which both the poses and the walls are unknown;
# - infer both in turns: cells and blocks by Gibbs sampling, poses by Metropolis-Hastings;
# - check whether the errors of the poses are as large as the posterior says;
# - say why a sensor model without outliers can stop a chain from moving.
#
# Reading time: about 15 minutes, without the exercises.
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
from bayesmap.programs.mapping import SetCells
from bayesmap.sensors.model import RangeLimits
from bayesmap.viz.palette import CHAINS, SENSOR, TRUTH

# %% [markdown]
# ## The model
#
# The robot scans at eight places, with sixty beams each. Its guess of each pose is normally distributed around the
# truth. The standard deviation is 0.4 m in x and y, and 0.06 rad, three and a half degrees, in the heading. The first
# pose is known, since this pose defines the frame of the map. Walls are rare.
#
# The sensor is a little more like a real one (`bm.BeamMixture`). A reading has 0.2 m of noise. But some readings have
# nothing to do with the walls, because somebody walks by or because a beam does not come back. The end of the page
# shows how much the inference depends on such readings.
#
# `bm.mapping_model` takes either known poses or a generative function of poses. With a generative function, the poses
# are choices of the model, at the address `"poses"`.

# %%
P_WALL, MAX_RANGE_M = 0.05, 42.0
SENSOR_MODEL = bm.BeamMixture(bm.Gaussian(0.2))
true_walls, _ = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
angles_rad = np.arange(60) / 60 * 2 * np.pi
places = [(10, 10), (12.5, 8.3), (10.2, 6.1), (7.6, 4.4), (4.8, 6.2), (5.2, 9.7), (7.1, 12.3), (9.6, 13.6)]
true_poses = np.array([[x, y, 0.7 * k] for k, (x, y) in enumerate(places)])
scans = bm.simulate(true_walls, grid, true_poses, angles_rad, sensor=SENSOR_MODEL, max_range_m=MAX_RANGE_M, seed=0)

S = len(true_poses)
SPREAD = jnp.array([[1e-3, 1e-3, 1e-3]] + [[0.4, 0.4, 0.06]] * (S - 1))
guesses = jnp.asarray(true_poses) + SPREAD * jrand.normal(jrand.key(0), (S, 3))


def model_with(sensor):
    """Poses from around the guesses, walls, and the readings."""
    poses = gen.mv_normal_diag.vmap()(guesses, SPREAD)
    return bm.mapping_model(grid, poses, angles_rad, bm.Independent(P_WALL), sensor, max_range_m=MAX_RANGE_M)


model = model_with(SENSOR_MODEL)
readings = C["readings"].set(scans.ranges_m)
print(model.simulate(jrand.key(1), ()))


def off_m(poses):
    """Distance in metres from the true places, (..., S)."""
    return np.linalg.norm(np.asarray(poses)[..., :2] - true_poses[:, :2], axis=-1)


print(f"the guessed poses are {off_m(guesses)[1:].mean():.2f} m off on average")

# %% [markdown]
# ## The guesses taken for granted
#
# Suppose that we take the guesses for the truth, and infer the walls alone. `bm.infer` runs block Gibbs, once with the
# true poses and once with the guessed poses.

# %%


def walls_given(poses):
    """The posterior of the walls at known poses."""
    known = bm.Scans(poses, angles_rad, scans.ranges_m, MAX_RANGE_M)
    prior = bm.Independent(P_WALL)
    return bm.infer(
        known, grid, prior=prior, sensor=SENSOR_MODEL, method="block", schedule=bm.Schedule(warmup=200, draws=300)
    )


at_truth, at_guesses = walls_given(true_poses), walls_given(np.asarray(guesses))
seen = at_truth.observed


def wrong_cells(occupancy):
    """Of the seen cells, how many are a wall with probability over 0.9 and free in truth, or the other way round."""
    sure = (occupancy < 0.1) | (occupancy > 0.9)
    return int((seen & sure & ((occupancy > 0.5) != true_walls)).sum())


for name, run in (("true", at_truth), ("guessed", at_guesses)):
    print(f"{name} poses: {wrong_cells(run.occupancy)} of {seen.sum()} seen cells surely wrong;", end=" ")
    print(f"log likelihood of the readings {np.median(run.posterior.log_likelihood):.0f}")

# %% [markdown]
# With the guessed poses some cells are wrong, although the posterior calls them certain. The log likelihood shows the
# fault: no map explains these readings from these poses.
#
# ## Poses and walls together
#
# A trace of the model holds both the poses and the walls. As on the pages before, we change the trace by edits. Walls
# and poses take turns:
#
# - *Walls*: a Gibbs sweep over all cells, and in every tenth round a sweep over blocks of 2 x 2 cells. The request
#   `SetCells` changes several cells together. 16 edits score the 16 states of a block, and one state is drawn.
# - *Poses*: ten Metropolis-Hastings moves for each scan. An edit of one pose by `IndexRequest` recomputes only the
#   beams of this scan, in the present map.

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


@jax.jit
def cells_and_poses(key, trace):
    """A sweep over the cells, and ten moves of each pose."""
    cell_key, pose_key = jrand.split(key)
    trace = jax.lax.fori_loop(0, 441, lambda k, trace: cell_update(jrand.fold_in(cell_key, k), trace, k), trace)
    return jax.lax.fori_loop(0, 10 * S, lambda k, trace: pose_update(jrand.fold_in(pose_key, k), trace, k % S), trace)


@jax.jit
def blocks(key, trace):
    """A sweep over the blocks."""
    return jax.lax.fori_loop(0, 400, lambda k, trace: block_update(jrand.fold_in(key, k), trace, k), trace)


def chain(model, key, walls, rounds):
    """Scores (rounds,), poses (rounds, S, 3) and walls (rounds, 21, 21) of a chain that begins at the guesses."""
    begin = C["walls"].set(walls) | C["poses"].set(guesses)
    trace, _ = model.importance(key, readings | begin, ())
    kept = []
    for n in range(rounds):
        trace = cells_and_poses(jrand.fold_in(key, n), trace)
        if n % 10 == 0:
            trace = blocks(jrand.fold_in(key, n), trace)
        choices = trace.get_choices()
        kept.append((trace.get_score(), choices["poses"], choices["walls"]))
    return [np.stack(part) for part in zip(*kept, strict=True)]


N_ROUNDS, N_WARM = 100, 30
empty = np.zeros((21, 21), bool)
starts = [at_guesses.draws[0, -1], at_guesses.draws[1, -1], empty, empty]
began = time.perf_counter()
scores, poses, walls = (
    np.stack(part)
    for part in zip(*(chain(model, jrand.key(k), start, N_ROUNDS) for k, start in enumerate(starts)), strict=True)
)
print(f"time: {(time.perf_counter() - began) / 4:.0f} s a chain")
for n in (1, 5, 10, 20, N_ROUNDS):
    off = off_m(poses[:, n - 1])[:, 1:].mean(axis=1)
    print(f"after round {n:3d}: poses", np.round(off, 2), "m off on average; log joint", np.round(scores[:, n - 1]))

# %% [markdown]
# Two of the four chains start from the wrong map above, and two from an empty map. All four arrive at the same poses
# within some twenty rounds. How good are these poses, and how good is the map?

# %%
poses, walls = poses[:, N_WARM:], walls[:, N_WARM:]
rhat = np.asarray(gen.split_rhat(jnp.asarray(poses[:, :, 1:])))
mean, spread = poses.mean(axis=(0, 1)), poses.std(axis=(0, 1))
occupancy = walls.mean(axis=(0, 1))
error = (mean - true_poses)[1:]
print(f"R-hat of the poses: {np.median(rhat):.2f} at the median, {rhat.max():.2f} at most")
print(f"places: {off_m(guesses)[1:].mean():.2f} m off as guessed, {off_m(mean)[1:].mean():.3f} m as inferred;", end=" ")
guessed = np.abs(np.asarray(guesses) - true_poses)[1:, 2].mean()
print(f"headings: {guessed:.3f} rad and {np.abs(error[:, 2]).mean():.4f} rad")
print(f"what the posterior says of its errors: {np.sqrt((spread[1:, :2] ** 2).sum(axis=-1)).mean():.3f} m,", end=" ")
print(f"{spread[1:, 2].mean():.4f} rad; errors in units of that: {np.sqrt(((error / spread[1:]) ** 2).mean()):.2f}")
print(f"{wrong_cells(occupancy)} of {seen.sum()} seen cells surely wrong; with guessed poses it was", end=" ")
print(f"{wrong_cells(at_guesses.occupancy)}, with the true ones {wrong_cells(at_truth.occupancy)}")

# %% tags=["hide-input"]
assert np.median(rhat) < 1.1
assert off_m(mean)[1:].max() < 0.2
assert off_m(mean)[1:].mean() < 0.2 * off_m(guesses)[1:].mean()
assert 0.4 < np.sqrt(((error / spread[1:]) ** 2).mean()) < 2.0
assert wrong_cells(occupancy) <= 2 < wrong_cells(at_guesses.occupancy)


def draw_places(ax, places, color):
    """Places (n, 2 or more) as points."""
    ax.plot(places[..., 0].ravel(), places[..., 1].ravel(), ".", color=color, markersize=3, zorder=5)


figure, axes = panels("guessed poses, map from them", "both inferred", "true poses, map from them", size_in=3.6)
for ax, p_wall in zip(axes, (at_guesses.occupancy, occupancy, at_truth.occupancy), strict=True):
    viz.plot_probability(ax, grid, p_wall)
    viz.plot_truth_outline(ax, grid, true_walls)
    ax.plot(*true_poses[:, :2].T, "+", color=TRUTH, markersize=7, zorder=6)
draw_places(axes[0], np.asarray(guesses), CHAINS[0])
draw_places(axes[1], poses[:, ::4], CHAINS[0])
show(
    figure,
    "both.png",
    "Crosses: where the robot was. Points: its guesses, and draws of the posterior. Outlined: truth.",
)

figure, axes = panels("pose 4 of a chain, from round 1", "its posterior", size_in=3.6)
path = np.concatenate([np.asarray(guesses)[None, 3], chain(model, jrand.key(2), empty, 30)[1][:, 3]])
axes[0].plot(*path[:, :2].T, "-o", color=CHAINS[0], markersize=3, linewidth=0.8)
axes[1].plot(*poses[:, :, 3, :2].reshape(-1, 2).T, ".", color=CHAINS[0], markersize=3)
for ax in axes:
    ax.plot(*np.asarray(guesses)[3, :2], "s", color=SENSOR, markersize=6, label="guess")
    ax.plot(*true_poses[3, :2], "+", color=TRUTH, markersize=12, markeredgewidth=2, label="truth")
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
axes[1].set(xlim=axes[0].get_xlim(), ylim=axes[0].get_ylim())
axes[0].legend(fontsize=8)
show(figure, "both-pose.png", "How one pose is found: thirty rounds of a chain, and the draws of all four.")

# %% [markdown]
# The map is as good as the map from known poses. The poses are known to a few centimetres, although the cells are a
# metre wide. And the errors are about as large as the posterior says.
#
# ## Why the sensor matters
#
# Now we take readings without outliers, and a model that allows only normal noise. Under this model, one wrong wall in
# the way of one beam makes a map nearly impossible. This holds even if the wall fits all other beams.

# %%
plain = bm.simulate(true_walls, grid, true_poses, angles_rad, sensor=bm.Gaussian(0.2), max_range_m=MAX_RANGE_M, seed=0)
readings = C["readings"].set(plain.ranges_m)
strict_model = model_with(bm.Gaussian(0.2))
at_truth_score = strict_model.assess(readings | C["poses"].set(true_poses) | C["walls"].set(true_walls), ())[0]
strict_scores, strict_poses, _ = chain(strict_model, jrand.key(2), empty, 40)
print(f"after 40 rounds the poses are {off_m(strict_poses[-1])[1:].mean():.2f} m off on average")
print(f"log joint {strict_scores[-1]:.0f}; at the true poses and walls {at_truth_score:.0f}")

# %% tags=["hide-input"]
assert off_m(strict_poses[-1])[1:].mean() > 0.15
assert strict_scores[-1] < at_truth_score - 300

# %% [markdown]
# The chain is stuck, with poses and a map that fit each other badly. A pose can move only if walls move, too, and
# every state in between is nearly impossible. The posterior of this model is right: the density is high near the truth.
# But the chain cannot get there in small steps. A sensor model that allows outliers describes real sensors better, and
# makes the states in between possible.
#
# ## Exercises
#
# **1.** A beam should read 6 m, but somebody walks by and the beam reads 3 m. Compute how many nats this reading costs,
# compared with a reading of 6 m, under `bm.Gaussian(0.2)` and under `bm.BeamMixture(bm.Gaussian(0.2))`.

# %% Answer 1 tags=["hide-cell"]
costs = {}
for law in (bm.Gaussian(0.2), SENSOR_MODEL):
    right, short = law.log_likelihood(np.array([6.0, 3.0]), np.array([6.0, 6.0]), RangeLimits(0.0, MAX_RANGE_M))
    costs[type(law).__name__] = right - short
    print(f"{type(law).__name__}: {right - short:.1f} nats")
assert np.isclose(costs["Gaussian"], (3.0 / 0.2) ** 2 / 2)
assert costs["BeamMixture"] < 8

# %% [markdown]
# **2.** The page prints the errors of seven poses in units of their standard deviations, as a root mean square over 21
# numbers. If the posterior is right, between which two values does this number lie in 95 % of all cases? Take the 21
# errors as independent and normal.

# %% Answer 2 tags=["hide-cell"]
rms = np.sqrt((np.random.default_rng(0).normal(size=(20_000, 21)) ** 2).mean(axis=1))
low, high = np.percentile(rms, [2.5, 97.5])
print(f"between {low:.2f} and {high:.2f}")
assert np.allclose([low, high], [0.70, 1.30], atol=0.02)

# %% [markdown]
# **3.** We fixed the first pose. Suppose instead that all eight poses have a standard deviation of 0.4 m. Which shifts
# of all poses and walls together leave every reading unchanged? How many nats does the prior of the poses take from the
# smallest of these shifts, if the guesses are right on average? And how many with cells of 5 cm?

# %% Answer 3 tags=["hide-cell"]
print("Walls fill cells of a fixed grid, so these are the shifts by whole cells.")
taken = {shift_m: S * (shift_m / 0.4) ** 2 / 2 for shift_m in (1.0, 0.05)}
for shift_m, nats in taken.items():
    print(f"A shift by one cell of {shift_m} m takes {nats:.2f} nats.")
print("Cells of a metre fix the place of the map. With cells of 5 cm the place stays open, unless one pose is fixed.")
assert np.isclose(taken[1.0], 25.0)
assert taken[0.05] < 0.1

# %% [markdown]
# ## Where to go from here
#
# - The robot took eight scans. For logs of thousands bayesmap has compiled kernels: the [next page](odometry.md)
#   takes a robot through a building.
# - [mapping-model.md](../mapping-model.md): the model of this page, its addresses and its edits. Its prior of poses
#   can be any program, such as the moves of the [page before](localization.md).
