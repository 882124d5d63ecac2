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
# On this page we write down a probabilistic model of this story, and then try the simplest way to infer the walls,
# importance sampling. It fails, and we see why. The [next page](gibbs.md) does better.
#
# Every number in the text is computed in a cell near it. Code that only draws a figure or checks what the text says is
# folded away; click on its title to see it. In lines that begin with `time:` this page rounds measured figures to 1, 2
# or 5 times a power of ten.
#
# The story follows a tutorial that was written for GenJAX; the code here runs on bayesmap alone. This page is made
# from [`mapping.py`](mapping.py), which is a notebook (jupytext opens it) and a plain script.

# %%
import jax
import jax.numpy as jnp
import jax.random as jrand
import numpy as np
from drawing import panels, show

import bayesmap as bm
from bayesmap import gen, viz
from bayesmap.gen import ChoiceMapBuilder as C

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

# %% Code of the figure tags=["hide-input"]
figure, (ax,) = panels("the true map")
viz.draw_sample(ax, grid, true_walls)
viz.draw_sensor(ax, pose)
show(figure, "map.png", "The true map. Dark cells are walls; the arrow is the robot.")

# %% [markdown]
# **Try it yourself.** [interactive.html](interactive.html) is this map as a page: download the file and open it in a
# browser. It holds a thousand draws of the posterior that the next page computes; step through them, look at
# their mean and at its uncertainty, and click a cell to see the beams through it. To draw walls of your own and
# drag the robot about, while the posterior follows, start the live page with `bayesmap app` ([how it
# works](../app.md)).
#
# ## The prior
#
# Before it measures, what does the robot believe? To begin with: nothing. Each cell is a wall with probability 0.5,
# whatever its neighbours are.
#
# In `bayesmap.gen` a *generative function* is a program that makes random choices. `flip` makes one choice; `repeat`
# makes many independent ones. To run the program is to `simulate` it. What comes back is a *trace*: the choices that
# were made, the value returned, and the score, which is the log probability of those choices.
#
# Random numbers in JAX come from a *key*. The same key gives the same numbers, and `split` makes many keys from one.

# %%
P_WALL = 0.5


def walls_prior(p_wall):
    """21 x 21 independent cells."""
    return gen.flip.repeat(n=21).repeat(n=21)(p_wall)


trace = jax.jit(walls_prior(P_WALL).simulate)(jrand.key(0), ())
print(trace)
print(f"score {trace.get_score():.3f}; 441 log(0.5) is {441 * np.log(0.5):.3f}")

draw_prior = jax.jit(jax.vmap(lambda key: walls_prior(P_WALL).simulate(key, ()).get_retval()))
prior_maps = draw_prior(jrand.split(jrand.key(1), 200))
print(f"walls in 200 prior maps: {prior_maps.mean():.1%} of all cells")

# %% tags=["hide-input"]
assert np.isclose(trace.get_score(), 441 * np.log(0.5), rtol=1e-5)
assert abs(prior_maps.mean() - 0.5) < 5 * 0.5 / np.sqrt(200 * 441)
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
print(f"nearest wall {exact.min():.2f} m; {(exact == MAX_RANGE_M).sum()} of the beams meet no wall")

# %% A check against the library's own ray casting tags=["hide-input"]
library = bm.ranges(true_walls, grid, pose, angles_rad, max_range_m=MAX_RANGE_M)
agree = np.allclose(exact, library, rtol=0, atol=1e-4)
print(f"bm.ranges, which walks from cell to cell instead, agrees to 0.1 mm: {agree}")
assert agree

# %% [markdown]
# The room is open on its left side; the beams that leave there meet no wall.
#
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

# %% tags=["hide-input"]
assert 0.15 < errors.std() < 0.25
scans = bm.Scans(poses=pose, angles_rad=angles_rad, ranges_m=np.asarray(readings), max_range_m=MAX_RANGE_M)
without_noise = bm.Scans(poses=pose, angles_rad=angles_rad, ranges_m=library, max_range_m=MAX_RANGE_M)
figure, axes = panels("exact", "noisy", "what the robot knows")
for ax, seen, walls in zip(axes, (without_noise, scans, scans), (true_walls, true_walls, 0 * true_walls), strict=True):
    viz.draw_sample(ax, grid, walls)
    viz.draw_rays(ax, seen)
    viz.draw_sensor(ax, pose)
    ax.set(xlim=(-0.5, 20.5), ylim=(-0.5, 20.5))
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

# %% The first number, worked out by hand tags=["hide-input"]
by_hand = 441 * np.log(0.5) + (-0.5 * (errors / SIGMA_M) ** 2 - np.log(SIGMA_M * np.sqrt(2 * np.pi))).sum()
print(f"the first one by hand      = {by_hand:12.1f}")
assert np.isclose(log_joint(true_walls), by_hand, atol=0.1)

# %% [markdown]
# Differences of log probabilities are called *nats* on these pages: a map that is 10 nats better is exp(10), some
# twenty thousand times, as probable.
#
# ## Importance sampling, and why it collapses
#
# What we want is the posterior: maps, given the readings. The plainest idea is to draw many maps from the prior and
# to weigh each by how well it explains the readings. `importance` does that. It fixes the choices that we give it,
# draws the others, and returns the log weight, here log p(readings | walls). Divided by their sum, the weights say
# how much each map counts.
#
# The *effective sample size*, one over the sum of the squared weights, says how many equally weighted maps they are
# worth. To *resample* is to draw from the maps, each with its weight as its probability.

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
print(f"{N_PARTICLES} maps, effective sample size {1 / jnp.sum(jnp.exp(2 * normalised)):.3f}")
print(f"a hundred maps resampled by weight: {len(set(resampled.tolist()))} distinct")
print(f"the second-best map is {best - second:.0f} nats behind the best")
assert len(set(resampled.tolist())) == 1

# %% [markdown]
# All hundred are the same map. Perhaps more maps help? bayesmap has compiled kernels that do the same work much
# faster, so we can afford a hundred times as many. `bm.infer` is the door to all of them.

# %%
problem = {"scans": scans, "grid": grid, "prior": bm.Independent(P_WALL), "sensor": bm.Gaussian(SIGMA_M)}
true_fit = float(log_joint(true_walls)) - bm.Independent(P_WALL).log_prob(true_walls, grid)
for particles in (1_000, 10_000, 100_000, 1_000_000):
    weighed = bm.infer(
        **problem, method=bm.Importance(particles=particles), schedule=bm.Schedule(draws=1, chains=1), seed=1
    )
    size = weighed.summary().effective_sample_size
    behind = true_fit - float(weighed.posterior.log_likelihood[0, 0])
    print(f"{particles:9,d} maps: effective sample size {size:.3f}; best map {behind:7.0f} nats behind the true one")
    assert size < 2
    assert behind > 1000

# %% Code of the figures tags=["hide-input"]
figure, (ax,) = panels("", size_in=6.0, height_in=3.0)
viz.draw_weights(ax, weighed.log_weights, range_nats=(-50_000.0, 0.0))
ax.set_title(f"{len(weighed.log_weights):,} maps, effective sample size {size:.1f}", fontsize=10)
for note in ax.texts:
    note.set_fontsize(9)
show(figure, "weights.png", "A million log weights. The one at the right has all the weight; the others have none.")
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
# No number of maps that a computer can draw is enough. Importance sampling is not useless, though: where the unknown
# has three numbers instead of 441 cells, as on the page on [localization](localization.md), it works well.
#
# Next: [Gibbs sampling](gibbs.md), which changes one cell at a time.
