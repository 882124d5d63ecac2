# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Where are the walls?
#
# A robot stands in a room that it has never seen. It measures the distance to the nearest wall in a hundred
# directions, with some noise. It knows where it stands. It wants to know two things: where the walls are, and how
# sure it can be of each.
#
# We write down a probabilistic model of this story, and then infer the walls by one method after another: importance
# sampling, which fails; Gibbs sampling, which works, and can be made to work faster; block Gibbs, for maps on which
# single cells get stuck; belief propagation, for an answer at once. At the end stands a building.
#
# Every number in the text is computed in a cell near it. The story follows a tutorial that was written for GenJAX;
# the code here runs on bayesmap alone.
#
# This page is made from [`tutorial.py`](tutorial.py), which is a notebook (jupytext opens it) and a plain script. In
# its lines that begin with `time:`, this page rounds measured figures to powers of ten.

# %%
import os
import sys
import time
from pathlib import Path

import jax
import jax.numpy as jnp
import jax.random as jrand
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import bayesmap as bm
from bayesmap import gen, viz
from bayesmap.cells.defaults import default_sensor
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.posterior.diagnostics import rhat
from bayesmap.viz.palette import CHAINS

FIGURES = Path(os.environ.get("BAYESMAP_TUTORIAL_FIGURES") or Path(globals().get("__file__", "x")).parent / "figures")


def panels(*titles, size_in=3.1):
    """A figure with a row of panels."""
    figure = Figure(figsize=(size_in * len(titles), size_in + 0.2), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    axes = np.atleast_1d(figure.subplots(1, len(titles)))
    for ax, title in zip(axes, titles, strict=True):
        ax.set_title(title, fontsize=10)
    return figure, axes


def show(figure, name, caption):
    """Write a figure and name it; in a notebook, show it too."""
    FIGURES.mkdir(parents=True, exist_ok=True)
    viz.write_figure(figure, FIGURES / name)
    print(f"figure: {name}: {caption}")
    if "IPython" in sys.modules:
        from IPython.display import Image, display

        display(Image(FIGURES / name))


# %% [markdown]
# ## The map
#
# The world is a grid of 21 x 21 square cells, a metre wide. A cell is a wall or it is free. `walls[i, j]` is the cell
# around the point (i, j): the first index runs along x, the second along y.

# %%
true_walls, pose = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
print(f"{true_walls.shape[0]} x {true_walls.shape[1]} cells, {true_walls.sum()} of them walls")
print(f"the robot stands at x = {pose[0]:g} m, y = {pose[1]:g} m")

figure, (ax,) = panels("the true map")
viz.draw_sample(ax, grid, true_walls)
viz.draw_sensor(ax, pose)
show(figure, "map.png", "The true map. Dark cells are walls; the arrow is the robot.")

# %% [markdown]
# ## The prior
#
# Before it measures, what does the robot believe? To begin with: nothing. Each cell is a wall with probability 0.5,
# whatever its neighbours are.
#
# In `bayesmap.gen` a *generative function* is a program that makes random choices. `flip` makes one choice; `repeat`
# makes many independent ones. To run the program is to `simulate` it. What comes back is a *trace*: the choices that
# were made, the value returned, and the score, which is the log probability of those choices.

# %%
P_WALL = 0.5


def walls_prior(p_wall):
    """21 x 21 independent cells."""
    return gen.flip.repeat(n=21).repeat(n=21)(p_wall)


trace = jax.jit(walls_prior(P_WALL).simulate)(jrand.key(0), ())
print(trace)
print(f"score {trace.get_score():.3f}; 441 log(0.5) is {441 * np.log(0.5):.3f}")
assert np.isclose(trace.get_score(), 441 * np.log(0.5), rtol=1e-5)

draw_prior = jax.jit(jax.vmap(lambda key: walls_prior(P_WALL).simulate(key, ()).get_retval()))
prior_maps = draw_prior(jrand.split(jrand.key(1), 200))
print(f"walls in 200 prior maps: {prior_maps.mean():.1%} of all cells")

figure, axes = panels("prior draw 1", "prior draw 2", "prior draw 3")
for ax, drawn in zip(axes, prior_maps, strict=False):
    viz.draw_sample(ax, grid, drawn)
show(
    figure,
    "prior.png",
    "Three maps drawn from the prior. None looks like a building: the prior knows nothing of rooms.",
)

# %% [markdown]
# ## The exact sensor
#
# A beam leaves the robot in some direction and stops at the first wall that it meets. So there are two questions, and
# it pays to keep them apart. How far along the beam is each cell? That is geometry; it does not depend on the walls.
# And which cell is the first wall? That is a minimum over the cells that are walls.
#
# A cell is a square. A beam enters it through its later entry into the two strips that make the square, and leaves it
# through its earlier exit. If the entry comes before the exit, the beam crosses the cell. A beam that meets no wall
# reads 42 m.

# %%
N_BEAMS, MAX_RANGE_M = 100, 42.0
angles_rad = np.arange(N_BEAMS) / N_BEAMS * 2 * np.pi
position = jnp.array(pose[:2], jnp.float32)
centres = jnp.stack(jnp.meshgrid(jnp.arange(21.0), jnp.arange(21.0), indexing="ij"), axis=-1)


def distances_to_cells(position, angle_rad):
    """Where a beam first meets the boundary of each cell, (21, 21); infinite where it misses the cell."""
    direction = jnp.stack([jnp.cos(angle_rad), jnp.sin(angle_rad)])
    one, other = (centres - 0.5 - position) / direction, (centres + 0.5 - position) / direction
    enter, leave = jnp.minimum(one, other).max(axis=-1), jnp.maximum(one, other).min(axis=-1)
    ahead = jnp.where(enter >= 0, enter, leave)  # from inside a cell, its far side
    return jnp.where((enter <= leave) & (leave >= 0), ahead, jnp.inf)


def exact_range(to_cells, walls):
    """The distance to the first wall along a beam."""
    return jnp.minimum(jnp.where(walls, to_cells, jnp.inf).min(), MAX_RANGE_M)


to_cells = jax.vmap(distances_to_cells, in_axes=(None, 0))(position, jnp.array(angles_rad))  # (100, 21, 21)
exact = np.asarray(jax.vmap(exact_range, in_axes=(0, None))(to_cells, true_walls))
library = bm.ranges(true_walls, grid, pose, angles_rad, max_range_m=MAX_RANGE_M)
print(f"nearest wall {exact.min():.2f} m, farthest {exact.max():.2f} m")
agree = np.allclose(exact, library, rtol=0, atol=1e-4)
print(f"bm.ranges, which walks the grid instead, agrees to 0.1 mm: {agree}")
assert agree

# %% [markdown]
# ## The noisy sensor
#
# A real reading is not exact. Ours is normally distributed around the exact range, with a standard deviation of 0.2
# m. The generative function for one beam makes one choice, the reading; `@ ()` says that this choice is all there is,
# so it needs no name of its own. `vmap` makes a scan of it, a beam for each angle.

# %%
SIGMA_M = 0.2


@gen.gen
def beam(to_cells, walls, sigma_m):
    """One noisy reading."""
    return gen.normal(exact_range(to_cells, walls), sigma_m) @ ()


scan = beam.vmap(in_axes=(0, None, None))

readings = scan.simulate(jrand.key(0), (to_cells, jnp.array(true_walls), SIGMA_M)).get_retval()
errors = np.asarray(readings - exact)
print(f"{len(readings)} readings; error: mean {errors.mean():+.3f} m, standard deviation {errors.std():.3f} m")
assert 0.15 < errors.std() < 0.25

scans = bm.Scans(poses=pose, angles_rad=angles_rad, ranges_m=np.asarray(readings), max_range_m=MAX_RANGE_M)
without_noise = bm.Scans(poses=pose, angles_rad=angles_rad, ranges_m=library, max_range_m=MAX_RANGE_M)
figure, axes = panels("exact", "noisy", "what the robot knows")
for ax, seen, walls in zip(axes, (without_noise, scans, scans), (true_walls, true_walls, 0 * true_walls), strict=True):
    viz.draw_sample(ax, grid, walls)
    viz.draw_rays(ax, seen)
    viz.draw_sensor(ax, pose)
show(figure, "readings.png", "Exact readings, noisy readings, and the noisy ones without the map: the data.")

# %% [markdown]
# ## The full model
#
# The prior makes the walls, the sensor makes the readings: that is the model. The two parts get addresses, `"walls"`
# and `"readings"`, under which their choices can be found, fixed or changed.

# %%


@gen.gen
def full_model(to_cells, p_wall):
    """Walls from the prior, and a scan of them."""
    walls = walls_prior(p_wall) @ "walls"
    readings = scan(to_cells, walls, SIGMA_M) @ "readings"
    return walls, readings


ARGS = (to_cells, P_WALL)
trace = full_model.simulate(jrand.key(1), ARGS)
print(trace)

# %% [markdown]
# A generative function does not only draw. It also *scores*: given all choices, `assess` returns their joint log
# probability. Here is the true map with our readings, and a map without walls with the same readings.

# %%
assess = jax.jit(full_model.assess)


def log_joint(walls, p_wall=P_WALL):
    """Log p(walls, readings)."""
    choices = C["walls"].set(jnp.asarray(walls) != 0) | C["readings"].set(readings)
    return assess(choices, (to_cells, p_wall))[0]


print(f"log p(true map, readings)  = {log_joint(true_walls):12.1f}")
print(f"log p(empty map, readings) = {log_joint(0 * true_walls):12.1f}")
by_hand = 441 * np.log(0.5) + (-0.5 * (errors / SIGMA_M) ** 2 - np.log(SIGMA_M * np.sqrt(2 * np.pi))).sum()
print(f"the first one by hand      = {by_hand:12.1f}")
assert np.isclose(log_joint(true_walls), by_hand, atol=0.1)

# %% [markdown]
# ## Importance sampling, and why it collapses
#
# What we want is the posterior: maps, given the readings. The plainest idea is to draw many maps from the prior and
# to weigh each by how well it explains the readings. `importance` does that. It fixes the choices that we give it,
# draws the others, and returns the log weight, here log p(readings | walls). Divided by their sum, the weights say
# how much each map counts.
#
# The *effective sample size*, one over the sum of the squared weights, says how many equally weighted maps they are
# worth.

# %%
N_PARTICLES = 10_000


@jax.jit
def importance_sample(keys):
    """Log weights of maps from the prior; a map can be drawn again from its key."""
    observed = C["readings"].set(readings)
    return jax.vmap(lambda key: full_model.importance(key, observed, ARGS)[1])(keys)


log_weights = importance_sample(jrand.split(jrand.key(3), N_PARTICLES))
normalised = log_weights - jax.scipy.special.logsumexp(log_weights)
resampled = jrand.categorical(jrand.key(4), normalised, shape=(100,))
best, second = np.sort(np.asarray(log_weights))[[-1, -2]]
print(f"gen: {N_PARTICLES} maps, effective sample size {1 / jnp.sum(jnp.exp(2 * normalised)):.3f}")
print(f"a hundred maps resampled by weight: {len(set(resampled.tolist()))} distinct")
print(f"the second-best map is {best - second:.0f} nats behind the best")
assert len(set(resampled.tolist())) == 1

# %% [markdown]
# All hundred are the same map. Perhaps more maps help? bayesmap's kernels do the same work on a compiled table of
# beams and cells, so we can afford more. `bm.infer` is the door to all of them.

# %%
sensor = bm.Gaussian(SIGMA_M)
problem = {"scans": scans, "grid": grid, "prior": bm.Independent(P_WALL), "sensor": sensor}
true_fit = float(log_joint(true_walls)) - bm.Independent(P_WALL).log_prob(true_walls, grid)
for particles in (1_000, 10_000, 100_000, 1_000_000):
    weighed = bm.infer(**problem, method="importance", particles=particles, draws=1, chains=1, seed=1)
    size = weighed.summary().effective_sample_size
    behind = true_fit - float(weighed.posterior.log_likelihood[0, 0])
    print(f"{particles:9,d} maps: effective sample size {size:.3f}; best map {behind:7.0f} nats behind the true one")
    assert size < 2
    assert behind > 1000

show(
    viz.weights_figure(weighed.log_weights, range_nats=(-50_000.0, 0.0)),
    "weights.png",
    "A million log weights. The one at the right has all the weight; the others have none.",
)
figure, (ax,) = panels("best of a million")
viz.draw_sample(ax, grid, weighed.draws[0, 0])
viz.draw_truth_outline(ax, grid, true_walls)
viz.draw_sensor(ax, pose)
show(figure, "importance.png", "The map that has all the weight. Outlined: the true walls.")

# %% [markdown]
# A thousand times as many maps, and the answer is still one map, and a bad one. A map that explains the readings must
# have its first wall right in a hundred directions at once. How often does the prior draw that? At the least, every
# cell that the beams pass on their way must be free:

# %%
passed = np.asarray((to_cells < exact[:, None, None] - 1e-3).any(axis=0))
print(f"cells that a beam passes before its first wall: {passed.sum()}")
print(f"the prior leaves them all free with probability 0.5^{passed.sum()} = 1e{np.log10(0.5) * passed.sum():.0f}")

# %% [markdown]
# ## Gibbs sampling
#
# Do not guess the whole map at once. Go through the cells, and draw each one from its distribution *given all the
# others and the readings*. For a cell that can only be a wall or free, this conditional is easy: score the map both
# ways, and compare. One walk over all cells is a *sweep*. Maps after many sweeps are draws from the posterior.

# %%


def gibbs_update(key, walls, i, j):
    """Draw a cell given all others."""
    as_free, as_wall = walls.at[i, j].set(False), walls.at[i, j].set(True)
    is_wall = gen.bernoulli.sample(key, logits=log_joint(as_wall) - log_joint(as_free))
    return walls.at[i, j].set(is_wall.astype(bool))


def sweep(key, walls):
    """Visit all cells in raster order."""
    keys = jrand.split(key, 441)
    return jax.lax.fori_loop(0, 441, lambda k, walls: gibbs_update(keys[k], walls, k // 21, k % 21), walls)


@jax.jit
def gibbs_chain(keys, walls):
    """The map after each sweep."""

    def step(walls, key):
        walls = sweep(key, walls)
        return walls, walls

    return jax.lax.scan(step, walls, keys)[1]


empty = jnp.zeros((21, 21), bool)
sweep_keys = jrand.split(jrand.key(0), 120)
compiled = gibbs_chain.lower(sweep_keys, empty).compile()
began = time.perf_counter()
chain = np.asarray(compiled(sweep_keys, empty))
gen_seconds = (time.perf_counter() - began) / len(chain)
print(f"time: {1 / gen_seconds:.0f} sweeps a second, by assess")
for n in (1, 2, 5, 10, 20, 120):
    print(f"after sweep {n:3d}: log joint {log_joint(chain[n - 1]):10.1f}, {chain[n - 1].sum():3d} walls")

figure, axes = panels(*(f"sweep {n}" for n in (1, 3, 6, 12)))
for ax, n in zip(axes, (1, 3, 6, 12), strict=True):
    viz.draw_sample(ax, grid, chain[n - 1])
    viz.draw_truth_outline(ax, grid, true_walls)
show(figure, "gibbs.png", "The chain after some sweeps, from an empty map. Outlined: the true walls.")

# %% [markdown]
# The free space grows from sweep to sweep. Behind a wall that should not be there nothing is seen, so cells there are
# drawn from the prior: half of them are walls. When the wall in front falls, those stand in the light, and must go in
# turn. How many sweeps does that take? One chain is an anecdote; below we count over hundreds.
#
# ## Incremental edits
#
# To score the whole model twice for a change of one cell is wasteful. A trace can be *edited* instead: `edit` takes a
# request, and returns the new trace and the change of its log probability. That change is all that Gibbs needs: keep
# the flipped cell with probability 1 / (1 + exp(-change)).
#
# There are two ways to ask. We can hand over a whole new map by `Update`, or say by `IndexRequest` which element of
# the choice changes. They must agree, with each other and with `assess`.

# %%


def flip_by_update(walls, i, j):
    """The new map, whole."""
    return gen.StaticRequest({"walls": gen.Update(C.v(walls.at[i, j].set(~walls[i, j])))})


def flip_by_index(walls, i, j):
    """The new cell, and where it is."""
    cell = gen.IndexRequest(jnp.asarray(j), gen.Update(C.v(~walls[i, j])))
    return gen.StaticRequest({"walls": gen.IndexRequest(jnp.asarray(i), cell)})


def edit_sweep(request, key, trace):
    """A Gibbs sweep by edits of a trace."""
    keys = jrand.split(key, 441)

    def update(k, trace):
        walls = trace.get_choices()["walls"]
        flipped, change, _, _ = trace.edit(keys[k], request(walls, k // 21, k % 21), None)
        return jax.lax.cond(gen.bernoulli.sample(keys[k], logits=change), lambda: flipped, lambda: trace)

    return jax.lax.fori_loop(0, 441, update, trace)


start, _ = full_model.importance(jrand.key(0), C["walls"].set(empty) | C["readings"].set(readings), ARGS)
by_update = jax.jit(lambda key, trace: edit_sweep(flip_by_update, key, trace))(jrand.key(5), start)
by_index = jax.jit(lambda key, trace: edit_sweep(flip_by_index, key, trace))(jrand.key(5), start)
same = bool((by_update.get_choices()["walls"] == by_index.get_choices()["walls"]).all())
print(f"the two requests draw the same map: {same}")
print(f"score that 441 edits have kept up {by_index.get_score():.2f}")
print(f"score from scratch                {log_joint(by_index.get_choices()['walls']):.2f}")
assert same
assert np.isclose(by_index.get_score(), log_joint(by_index.get_choices()["walls"]), rtol=1e-5)

# %% [markdown]
# An edit by index visits one element of the prior, not 441. But it still computes all hundred beams, for the sensor
# sees only that its argument `walls` has changed. It could do better: a cell concerns only the beams that cross it.
# How many are those?

# %%
crossing = np.isfinite(np.asarray(to_cells)).sum(axis=0)
print(f"beams through a cell: {crossing.mean():.1f} on average, {np.median(crossing):.0f} at the median, of {N_BEAMS}")
assert crossing.mean() < 10

# %% [markdown]
# bayesmap's own mapping model makes use of that. `bm.mapping_model` is a generative function like ours, but its sensor
# answers an edit of one wall by visiting the beams through it. The same sweep of edits runs on it unchanged, and ends
# in a map that its own `assess`, ours and the edits score alike.

# %%
fast_model = bm.mapping_model(
    grid, scans.poses[0], scans.angles_rad, problem["prior"], sensor, max_range_m=scans.max_range_m
)
fast_start, _ = fast_model.importance(jrand.key(0), C["walls"].set(empty) | C["readings"].set(readings), ())
fast_sweep = jax.jit(lambda key, trace: edit_sweep(flip_by_index, key, trace))
fast_end = fast_sweep(jrand.key(5), fast_start)
began = time.perf_counter()
for k in range(5):
    jax.block_until_ready(fast_sweep(jrand.key(k), fast_end))
fast_ms = 1e3 * (time.perf_counter() - began) / 5
by_fast_model = fast_model.assess(fast_end.get_choices(), ())[0]
print(f"log joint by the edits {fast_end.get_score():.2f}, by its assess {by_fast_model:.2f}, "
      f"by ours {log_joint(fast_end.get_choices()['walls']):.2f}")  # fmt: skip
assert np.isclose(fast_end.get_score(), by_fast_model, rtol=1e-5)
assert np.isclose(by_fast_model, log_joint(fast_end.get_choices()["walls"]), rtol=1e-4)
print(f"time: a sweep of 441 such edits takes {fast_ms:.1f} ms")

# %% [markdown]
# ## The same posterior from the kernels
#
# This is what bayesmap's kernels are built on. For every beam they keep a list of the cells on its way, and for each
# the log-likelihood of the reading if that cell is the first wall. To update a cell, they visit the beams that cross
# it and nothing else ([beam-table.md](../beam-table.md)).
#
# It is the same model. Here is the same map scored by both:

# %%
run = bm.infer(**problem, method="gibbs", order="raster", chains=4, warmup=200, draws=5_000)
both = np.array([[log_joint(walls), run.log_joint[c, 0]] for c, walls in enumerate(run.draws[:, 0])])
print("log joint of four draws, by gen and by the kernels:")
print(np.array2string(both.T, precision=2))
assert np.allclose(both[:, 0], both[:, 1], atol=0.05)

# %% [markdown]
# And the same posterior. The 120 sweeps above are few, so we compare each cell's share of walls with its long-run
# value, measured in standard errors. If the two agree, the scores have a standard deviation of about one.

# %%
kept = chain[20:]
differs = kept.mean(axis=0) - run.occupancy
size = np.maximum(np.asarray(gen.effective_sample_size(jnp.asarray(kept[None]))), 1.0)
open_cells = (run.occupancy > 0.02) & (run.occupancy < 0.98)
z = differs[open_cells] / np.sqrt(run.occupancy * (1 - run.occupancy) / size)[open_cells]
kernel_us = run.summary().microseconds_per_sweep
print(f"time: {1e6 / kernel_us:.0f} sweeps a second on one core, by the kernels")
print(f"time: {1e6 * gen_seconds / kernel_us:.0f} times as many as by assess")
print(f"cells that are neither surely free nor surely wall: {open_cells.sum()}")
print(f"z-scores of the difference: standard deviation {np.std(z):.2f}, largest {np.abs(z).max():.1f}")
print(f"cells that are sure in the long run: largest difference {np.abs(differs[~open_cells]).max():.3f}")
assert np.std(z) < 1.3
assert np.abs(z).max() < 5.0
print(f"the long run: R-hat {run.summary().rhat_log_joint:.4f}, worst cell {run.summary().rhat_max:.4f}")
assert run.summary().rhat_max < 1.01

figure, axes = panels("gen, 100 sweeps", "kernels, 20 000 sweeps", "uncertainty")
for ax, mean in zip(axes[:2], (kept.mean(axis=0), run.occupancy), strict=True):
    viz.draw_probability(ax, grid, mean)
    viz.draw_truth_outline(ax, grid, true_walls)
viz.draw_entropy(axes[2], grid, run.occupancy)
show(figure, "posterior.png", "Posterior probability of a wall, twice, and its entropy: bright is uncertain.")

# %% [markdown]
# The inside of the room is free and its walls stand. Behind the walls the posterior is the prior, 0.5: no beam has
# been there. A single best map could not say so.

# %%
unseen = ~np.asarray(to_cells <= exact[:, None, None] + 1.0).any(axis=0)
print(f"{unseen.sum()} cells lie more than a metre behind the first wall of every beam through them")
print(f"their posterior probabilities: {run.occupancy[unseen].min():.3f} to {run.occupancy[unseen].max():.3f}")
assert np.abs(run.occupancy[unseen] - 0.5).max() < 0.03

# %% [markdown]
# ## A better order
#
# Gibbs may visit the cells in any order. Raster order begins at a corner of the map. But we saw that free space grows
# outwards from the robot: what lies in the shadow of a wall has to wait until the wall falls. If the sweep itself
# goes outwards (`order="radial"`), then a wall falls first, and the cells that come to light behind it are drawn in
# the same sweep.
#
# We count. The cells below the robot (y < 10) that are free with a posterior probability over 0.999 are to be
# cleared; a chain is done at the first sweep after which none of them is a wall. Each order gets 400 chains from an
# empty map.

# %%
below = run.occupancy < 1e-3
below[:, 10:] = False
print(f"{below.sum()} cells below the robot are to be cleared")


def sweeps_to_clear(order):
    """The first sweep after which the cells below are free, for 400 chains."""
    early = bm.infer(**problem, order=order, start="zeros", chains=400, warmup=0, draws=60, seed=2)
    walls_left = early.draws[..., below].any(axis=-1)
    assert not walls_left.all(axis=1).any()
    return np.argmin(walls_left, axis=1) + 1


cleared = {order: sweeps_to_clear(order) for order in ("raster", "random", "radial")}
for order, counts in cleared.items():
    low, middle, high = np.percentile(counts, [5, 50, 95])
    print(f"{order:6s}: mean {counts.mean():5.2f} sweeps, median {middle:.0f}, 90 % of chains {low:.0f} to {high:.0f}")
assert 4 < cleared["radial"].mean() < 5 < cleared["random"].mean() < 9 < cleared["raster"].mean() < 11

figure, (ax,) = panels("sweeps until clear", size_in=4.0)
for color, (order, counts) in zip(CHAINS, cleared.items(), strict=False):
    ax.hist(counts, bins=np.arange(0.5, 18.5), histtype="step", linewidth=1.6, label=order, color=color)
ax.set(xlabel="sweeps", ylabel="chains of 400", xticks=range(0, 19, 3))
ax.legend(frameon=False)
show(figure, "order.png", "Sweeps until the space below the robot is clear, by order of the cells.")

# %% [markdown]
# Raster order takes about ten sweeps, radial order between four and five. It is the default.
#
# ## Where walls are rare
#
# A prior of 0.5 is not how buildings are. Say that walls are rare: 0.05. We start chains from an empty map, from a
# map full of walls, and from prior draws, and let each run. If they have converged, they agree. R-hat compares the
# spread between chains with the spread within them: 1 means agreement, and over 1.05 is not to be trusted. It is
# computed here of the log joint, over the second half of the first n sweeps.

# %%
RARE = 0.05
rare = problem | {"prior": bm.Independent(RARE)}
prior_starts = [bm.Independent(RARE).sample(np.random.default_rng(k), grid) for k in range(4)]
starts = np.stack([0 * true_walls] * 4 + [0 * true_walls + 1] * 4 + prior_starts)
SWEEPS = {"gibbs": 16_384, "block": 1_024}
traces = {
    method: bm.infer(
        **rare, method=method, start=starts, chains=12, warmup=n, draws=0, seed=3
    ).posterior.warmup_log_joint
    for method, n in SWEEPS.items()
}


def rhat_after(trace):
    """R-hat of the second half of the first n sweeps, for n = 16, 32, ..."""
    return {n: rhat(trace[:, n // 2 : n]) for n in 2 ** np.arange(4, 15) if n <= trace.shape[1]}


single = rhat_after(traces["gibbs"])
for n, value in single.items():
    by_start = traces["gibbs"][:, n // 2 : n].mean(axis=1).reshape(3, 4).mean(axis=1)
    parts = ", ".join(f"{name} {mean:9.0f}" for name, mean in zip(("zeros", "ones", "prior"), by_start, strict=True))
    print(f"single cells, {n:5d} sweeps: R-hat {value:5.2f}; mean log joint from {parts}")
assert all(single[n] > 1.5 for n in (16, 64, 256, 1024))

# %% [markdown]
# After a thousand sweeps the chains still disagree, by thousands of nats. Only after some thousand more do they meet.
# One chain that is watched for a hundred sweeps is flat (the figure below shows it), and looks as if it had arrived.
#
# The chains that start full of walls fare best: their first sweep, going outwards, carves free space until it meets
# the readings. The line `ones` shows it. That is luck of the start, not a cure.
#
# Why do they stick? Here is where a chain that started empty stands after 200 sweeps, and what it would cost to take
# away the wall that is in the way.

# %%
stuck = bm.infer(**rare, start="zeros", chains=1, warmup=199, draws=1, seed=3).draws[0, 0]
without = stuck.copy()
without[10, 10] = False
print(f"is there a wall in the robot's own cell? {stuck[10, 10]}")
print(f"log joint with it {log_joint(stuck, RARE):.0f}, without it {log_joint(without, RARE):.0f}")
assert stuck[10, 10]
assert log_joint(stuck, RARE) > log_joint(without, RARE) + 10_000

# %% [markdown]
# The robot has walled itself in. In an empty map beams fly on to 42 m; the first cell that the sweep visits can stop
# them all, and to stop them too early is the lesser evil. Now that cell throws its shadow over the whole map. To take
# it away alone sends the beams off to whatever stands behind; and behind, in the shadow, cells are drawn from the
# prior. Where half of all cells are walls, something catches the beams. Where one in twenty is, many fly on, which
# their readings forbid.
#
# So the chain waits for a lucky shadow. We can compute how long: fill the shadow from the prior, many times, and
# average the probability that one update takes the wall away. We do it for an update of the cell alone, and for one
# of a block: the cell and three neighbours, drawn together from their 16 joint states.

# %%


@jax.jit
def chance_to_leave(maps, states, p_wall):
    """The probability that an update of the cells [10:, 10:] among ``states`` (n, h, w) frees cell (10, 10)."""

    def of_one(walls):
        scores = jax.vmap(lambda state: log_joint(jax.lax.dynamic_update_slice(walls, state, (10, 10)), p_wall))(states)
        return jnp.sum(jnp.where(states[:, 0, 0], 0.0, jax.nn.softmax(scores)))

    return jax.lax.map(of_one, maps, batch_size=50).mean()


one_cell = np.array([False, True]).reshape(2, 1, 1)
two_by_two = (np.arange(16)[:, None] >> np.arange(4) & 1).astype(bool).reshape(16, 2, 2)
for p_wall, name, states in ((0.5, "cell", one_cell), (RARE, "cell", one_cell), (RARE, "block", two_by_two)):
    shadows = np.random.default_rng(0).random((1_000, 21, 21)) < p_wall
    chance = float(chance_to_leave(jnp.asarray(shadows), jnp.asarray(states), p_wall))
    print(f"prior {p_wall:4}: one update of the {name:5s} frees the robot's cell with probability {chance:.4f}")

# %% [markdown]
# ## Block Gibbs
#
# Draw 2 x 2 cells together, from their 16 joint states, for all overlapping positions.

# %%
block = rhat_after(traces["block"])
for n, value in block.items():
    print(f"blocks, {n:5d} sweeps: R-hat {value:5.3f}")
assert all(block[n] < 1.05 for n in (128, 256, 512, 1024))

# %% [markdown]
# How long does one chain take to arrive? Say that it has when its log joint is as high as all but the lowest
# thousandth of the posterior's. And since a sweep over blocks costs more than one over cells, we give the ratio of
# their times too.

# %%
reference = bm.infer(**rare, method="block", chains=4, warmup=200, draws=3_000, seed=4)
assert reference.summary().rhat_max < 1.01
threshold = np.quantile(reference.log_joint, 1e-3)
arrived = {}
for method, n in (("gibbs", 6_000), ("block", 200)):
    early = bm.infer(**rare, method=method, start="zeros", chains=16, warmup=n, draws=0, seed=5)
    there = early.posterior.warmup_log_joint > threshold
    assert there.any(axis=1).all()
    arrived[method] = there.argmax(axis=1) + 1
    low, middle, high = np.percentile(arrived[method], [0, 50, 100])
    print(f"{method}: from an empty map, {low:.0f} to {high:.0f} sweeps, median {middle:.0f} (16 chains)")
cost = reference.summary().microseconds_per_sweep / kernel_us
print(f"time: a sweep over blocks costs {cost:.0f} times one over cells")
assert np.median(arrived["gibbs"]) > 20 * np.median(arrived["block"])

figure, axes = panels("single cells: log joint", "2 x 2 blocks: log joint", "R-hat", size_in=3.6)
top = reference.log_joint.max() + 10
for ax, trace in zip(axes[:2], traces.values(), strict=True):
    for chain_number, line in enumerate(trace):
        color = CHAINS[chain_number // 4]
        label = ("zeros", "ones", "prior")[chain_number // 4] if chain_number % 4 == 0 else None
        ax.loglog(1 + np.arange(len(line)), top - line, color=color, linewidth=0.7, alpha=0.8, label=label)
    ax.set(xlabel="sweep", ylim=(1e6, 1.0))
axes[0].set_ylabel("nats below the top")
axes[0].legend(frameon=False, title="start", fontsize=8)
for name, values in (("single cells", single), ("2 x 2 blocks", block)):
    axes[2].semilogx(list(values), list(values.values()), marker="o", markersize=3, label=name)
axes[2].axhline(1.05, color="grey", linewidth=0.8, linestyle="--")
axes[2].set(xlabel="sweeps")
axes[2].legend(frameon=False, fontsize=8)
show(figure, "rare.png", "Prior 0.05. Twelve chains by single cells and by blocks, and R-hat of both. Dashed: 1.05.")

figure, axes = panels("single cells, sweep 200", "blocks: one draw", "blocks: posterior")
viz.draw_sample(axes[0], grid, stuck)
viz.draw_sample(axes[1], grid, reference.draws[0, -1])
viz.draw_probability(axes[2], grid, reference.occupancy)
for ax in axes:
    viz.draw_truth_outline(ax, grid, true_walls)
show(
    figure, "stuck.png", "A map in which single cells are stuck, a draw by blocks, and the posterior. Outlined: truth."
)

# %% [markdown]
# ## Belief propagation
#
# Sampling is one road. Belief propagation is another: beams and cells exchange messages, "given what I have heard
# from the others, this is what I think of you", until nobody changes its mind. It gives marginals in a few rounds,
# and nothing else. They are exact where no two beams share a cell, and approximate otherwise. How good are they here?
# Block Gibbs, long converged, is the judge. Then we ask again with a worse sensor, 0.5 m of noise, where the readings
# leave more open.

# %%
figure, axes = panels("noise 0.2 m", "noise 0.5 m", size_in=3.6)
for ax, sigma_m in zip(axes, (0.2, 0.5), strict=True):
    worse = bm.Gaussian(sigma_m)
    seen = bm.simulate(true_walls, grid, pose, angles_rad, sensor=worse, max_range_m=MAX_RANGE_M, seed=0)
    known = {"scans": seen, "grid": grid, "prior": bm.Independent(RARE), "sensor": worse}
    gibbs = bm.infer(**known, method="block", chains=4, draws=2_000)
    belief = bm.infer(**known, method="propagate", rounds=50, chains=1, draws=500)
    off = np.abs(belief.occupancy - gibbs.occupancy)
    worst = np.unravel_index(off.argmax(), off.shape)
    sure = (belief.occupancy < 0.01) | (belief.occupancy > 0.99)
    wrong = int((sure & (off > 0.05)).sum())
    rounds, settled = len(belief.posterior.belief_changes), gibbs.summary().rhat_max
    print(f"noise {sigma_m} m, {rounds} rounds of beliefs; R-hat of block Gibbs {settled:.3f}")
    print(
        f"  marginals differ by {off.mean():.4f} on average, {off.max():.3f} at most, {(off > 0.1).sum()} by over 0.1"
    )
    print(f"  worst cell: {belief.occupancy[worst]:.3f} by beliefs, {gibbs.occupancy[worst]:.3f} by block Gibbs")
    print(f"  sure by beliefs to 1 %, and off by more than 5 %: {wrong} cells")
    print(f"  entropy of the marginals: {belief.entropy.sum():.1f} bits, by block Gibbs {gibbs.entropy.sum():.1f}")
    typical = np.median(gibbs.log_joint) - np.median(belief.log_joint)
    print(f"  whole maps drawn from the beliefs are {typical:.0f} nats less likely than draws (medians)")
    ax.plot([0, 1], [0, 1], color="grey", linewidth=0.8)
    ax.plot(gibbs.occupancy.ravel(), belief.occupancy.ravel(), "o", markersize=3, alpha=0.5)
    ax.set(xlabel="block Gibbs", ylabel="belief propagation", aspect="equal")
    assert gibbs.summary().rhat_max < 1.02
    assert typical > 1000
    assert off.max() < 0.03 if sigma_m == 0.2 else (off.max() > 0.2 and belief.entropy.sum() < gibbs.entropy.sum())
show(figure, "beliefs.png", "Wall probability of each cell, by beliefs and by block Gibbs. On the line they agree.")

# %% [markdown]
# With the good sensor the marginals are right to about a percent. With the worse one, beliefs are too sure: the cells
# off the line at the top of the figure are walls for certain, by beliefs, while the posterior leaves them open. Beams
# that share cells pass for independent witnesses. And in both cases marginals are not maps. "The wall is here or
# there" cannot be said cell by cell: whole maps drawn from the beliefs are less likely than the posterior's own draws
# by thousands of nats.
#
# So bayesmap uses belief propagation to start chains on large maps, and where marginals are all that is asked for.
#
# ## More than one place
#
# From the middle of the room some corners are not to be seen. Nothing in the model says that there is one pose only:
# more poses are more beams. The noise is 0.5 m again.

# %%
stops = np.array([pose, [6.0, 9.0, 0.0], [13.0, 10.0, 0.0], [9.0, 5.0, 0.0], [9.0, 14.0, 0.0]])
noisy = bm.Gaussian(0.5)
figure, axes = panels("one pose", "entropy", "five poses", "entropy")
for at, poses in ((0, stops[:1]), (2, stops)):
    seen = bm.simulate(true_walls, grid, poses, angles_rad, sensor=noisy, max_range_m=MAX_RANGE_M, seed=0)
    several = bm.infer(seen, grid, prior=bm.Independent(RARE), sensor=noisy, method="block", draws=1_000)
    undecided = int(((several.occupancy > 0.1) & (several.occupancy < 0.9)).sum())
    print(f"{len(poses)} pose(s): {several.entropy.sum():6.1f} bits, {undecided:2d} cells between 0.1 and 0.9")
    viz.draw_probability(axes[at], grid, several.occupancy)
    viz.draw_truth_outline(axes[at], grid, true_walls)
    viz.draw_sensor(axes[at], poses)
    viz.draw_entropy(axes[at + 1], grid, several.occupancy)
show(figure, "poses.png", "The posterior and its entropy after a scan from one place, and after scans from five.")

# %% [markdown]
# ## A building
#
# A robot's log is the same thing, only larger: thousands of beams, cells of 10 cm, and readings that no wall
# explains, because people walk by and glass lets beams through. `bm.read_log` reads one; here we simulate a robot's
# round through an office, so that there is a truth to compare with. The sensor model is a mixture with room for
# outliers ([defaults.md](../defaults.md)). The chains start from belief propagation. Every tenth scan is held out,
# and the posterior is asked to predict it.

# %%
office = bm.worlds.building(seed=3, size_m=(14.0, 9.0), resolution=0.1)
route = bm.worlds.patrol(office, 60, seed=1)
laser = default_sensor(office.grid.resolution)
log = bm.simulate(
    office.walls, office.grid, route, np.deg2rad(np.arange(-90, 90)), sensor=laser, max_range_m=10.0, seed=0,
    opacity=office.opacity,
)  # fmt: skip
used, held_out = log.holdout(10)
mapped = bm.infer(used, office.grid, prior=bm.Independent(0.2), sensor=laser, chains=4, warmup=200, draws=200)
diagnosis = mapped.summary()
print(f"{len(used)} scans, {used.n_beams} beams; {office.grid.shape[0]} x {office.grid.shape[1]} cells")
print(f"R-hat: log joint {diagnosis.rhat_log_joint:.3f}, log likelihood {diagnosis.rhat_log_likelihood:.3f}")
for problem_found in diagnosis.problems():
    print(f"  not settled: {problem_found}")

guess = bm.infer(used, office.grid, prior=bm.Independent(0.2), sensor=laser, method="propagate", chains=1, draws=100)
nothing = bm.infer(
    used, office.grid, prior=bm.Independent(0.2), sensor=laser, start="prior", chains=1, warmup=0, draws=1
)
print(
    f"held-out beams, nats each: {mapped.log_score(held_out):.3f} by chains, {guess.log_score(held_out):.3f} by beliefs"
)
print(f"  and {nothing.log_score(held_out):.3f} by a chain after a single sweep")
seconds = [some.posterior.seconds["sampling"] for some in (mapped, guess)]
print(f"time: {seconds[0]:.2f} s in sweeps, {seconds[1]:.2f} s in beliefs")
certain = (mapped.entropy < 0.1)[mapped.observed].mean()
print(f"of the observed cells {certain:.1%} are certain to 0.1 bits")
walls_seen, free_seen = mapped.observed & office.walls, mapped.observed & ~office.walls
print(f"their mean probability of a wall: {mapped.occupancy[walls_seen].mean():.2f} where there is one,")
print(f"  {mapped.occupancy[free_seen].mean():.3f} where there is none")
assert mapped.log_score(held_out) > nothing.log_score(held_out)
assert mapped.log_score(held_out) > guess.log_score(held_out) - 0.05
figure, axes = panels("probability of a wall", "entropy", size_in=4.0)
viz.draw_probability(axes[0], office.grid, mapped.occupancy, mapped.observed)
viz.draw_truth_outline(axes[0], office.grid, office.walls)
viz.draw_sensor(axes[0], route)
viz.draw_entropy(axes[1], office.grid, mapped.occupancy, mapped.observed)
show(figure, "building.png", "An office, with the robot's way. Outlined: the true walls. Hatched: no beam came there.")

# %% [markdown]
# What is uncertain lies at the rims of what was seen. The summary counts the cells on which the chains have not
# settled after 400 sweeps: it is there to be read. For such a map beliefs predict the held-out beams about as well as
# the chains, and sooner.
#
# ## Where to go from here
#
# - Your own log: `bayesmap infer my.log.gz -o runs/mine`; the [README](../../README.md) has the commands.
# - Your own sensor, prior or sampler: [CONTRIBUTING.md](../../CONTRIBUTING.md).
# - How the kernels avoid most of the work: [inference.md](../inference.md) and [beam-table.md](../beam-table.md).
# - `bayesmap.gen` for models of your own: [coming-from-genjax.md](../coming-from-genjax.md).
