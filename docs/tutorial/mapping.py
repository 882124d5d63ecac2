# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100, E402

# %% [markdown]
# # Where are the walls?
#
# A robot stands in an unknown room. The robot knows its own place. Its laser measures the distance to the first wall in
# a hundred directions, with some noise. Two questions follow: where are the walls, and how sure can the robot be of
# each?
#
# On this page we write down a probabilistic model of this story: first in plain NumPy, then as a probabilistic program.
# Then we try the simplest way to infer the walls, importance sampling. Importance sampling fails here, and we see why.
# The [next page](gibbs.md) does better.
#
# **After this page you will be able to**
#
# - write the likelihood of a laser scan in a few lines of NumPy;
# - write a prior and a sensor as one generative function, and score maps with that function;
# - weigh maps from the prior by how well they explain a scan, and compute the effective sample size of the weights;
# - say why importance sampling does not find a map of 441 cells.
#
# Reading time: about 20 minutes, without the exercises.
#
# Every number in the text is computed in a cell nearby. Code that only draws a figure or checks the text is folded
# away; click on the title of such a cell to see the code. In lines that begin with `time:` measured figures are rounded
# to 1, 2 or 5 times a power of ten.
#
# The story follows a tutorial that was written for GenJAX; the code here runs on bayesmap alone. This page is made
# from [`mapping.py`](mapping.py), which is a jupytext notebook and a plain script.

# %%
import numpy as np
from drawing import panels, show

import bayesmap as bm
from bayesmap import viz

# %% [markdown]
# ## The map
#
# The world is a grid of 21 x 21 square cells, each a metre wide. A cell is either a wall or free. `walls[i, j]` is the
# cell around the point (i, j): the first index runs along x, the second along y.

# %%
true_walls, pose = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
print(f"{true_walls.shape[0]} x {true_walls.shape[1]} cells, {true_walls.sum()} of them walls")
print(f"the robot stands at x = {pose[0]:g} m, y = {pose[1]:g} m")

# %% Code of the figure tags=["hide-input"]
figure, (ax,) = panels("the true map")
viz.plot_sample(ax, grid, true_walls)
viz.plot_sensor(ax, pose)
show(figure, "map.png", "The true map. Dark cells are walls; the arrow is the robot.")

# %% [markdown]
# **Try it yourself.** [interactive.html](interactive.html) is this map as a page: download the file and open the file
# in a browser. The page holds a thousand draws of the posterior that we compute on the next page. Step through the
# draws, look at their mean and its uncertainty, and click a cell to see the beams through that cell. On the live page
# you draw walls of your own and drag the robot about, while the posterior follows: start it with `bayesmap app` ([how
# the page works](../app.md)).
#
# ## A beam and its likelihood, in NumPy
#
# A beam leaves the robot in some direction and stops at the first wall. The simplest program walks along the beam, a
# centimetre a step, and looks whether each point lies in a wall. A beam that meets no wall reads 42 m.

# %%
N_BEAMS, MAX_RANGE_M = 100, 42.0
angles_rad = np.arange(N_BEAMS) / N_BEAMS * 2 * np.pi


def walked_range_m(walls, angle_rad):
    """Return the distance to the first wall along a beam, in metres, to a centimetre."""
    way_m = np.arange(0, MAX_RANGE_M, 0.01)
    i = np.rint(pose[0] + way_m * np.cos(angle_rad)).astype(int)
    j = np.rint(pose[1] + way_m * np.sin(angle_rad)).astype(int)
    on_map = (i >= 0) & (i < 21) & (j >= 0) & (j < 21)
    blocked = on_map & (walls[i.clip(0, 20), j.clip(0, 20)] != 0)
    return way_m[blocked.argmax()] if blocked.any() else MAX_RANGE_M


for k in (0, 25, 40):
    print(f"beam {k}, at {np.degrees(angles_rad[k]):3.0f} degrees: {walked_range_m(true_walls, angles_rad[k]):5.2f} m")

# %% [markdown]
# A real reading is not exact. Ours is normally distributed around the exact range, with a standard deviation of 0.2 m.
# The *likelihood* of a map is the probability density of the readings if that map is true. The hundred errors are
# independent. So the log likelihood is a sum of a hundred normal log densities.

# %%
SIGMA_M = 0.2


def log_likelihood(walls, readings_m):
    """Return log p(readings | walls)."""
    exact_m = np.array([walked_range_m(walls, angle_rad) for angle_rad in angles_rad])
    return np.sum(-0.5 * ((readings_m - exact_m) / SIGMA_M) ** 2 - np.log(SIGMA_M * np.sqrt(2 * np.pi)))


rng = np.random.default_rng(0)
first_readings_m = np.array([walked_range_m(true_walls, angle_rad) for angle_rad in angles_rad])
first_readings_m += SIGMA_M * rng.normal(size=N_BEAMS)
one_wall_less = true_walls.copy()
one_wall_less[12, 13] = False
candidates = {"the true map": true_walls, "without the wall at (12, 13)": one_wall_less, "an empty map": 0 * true_walls}
first_fits = {name: log_likelihood(walls, first_readings_m) for name, walls in candidates.items()}
for name, fit in first_fits.items():
    print(f"{name:28s}: log likelihood {fit:11.1f}")

# %% tags=["hide-input"]
assert list(first_fits.values()) == sorted(first_fits.values(), reverse=True)

# %% [markdown]
# Among the three, the true map explains the readings best. Differences of log probabilities are called *nats* on these
# pages: a map that is 10 nats better is exp(10), some twenty thousand times, as probable, if both were equally probable
# before the readings.
#
# This is the whole sensor. Inferring the walls takes the scores of many maps, and random choices that have names. For
# that we use JAX, which compiles functions of arrays, and `bayesmap.gen`, in which a model is a program. Three tools of
# JAX occur again and again:
#
# - `jax.jit` compiles a function.
# - `jax.vmap` turns a function of one thing into a function of many: no loop over beams is needed.
# - A *key* stands for a sequence of random numbers. The same key gives the same numbers, and `split` makes many keys
#   from one.

# %%
import jax
import jax.numpy as jnp
import jax.random as jrand

from bayesmap import gen
from bayesmap.gen import ChoiceMapBuilder as C

# %% [markdown]
# ## The prior
#
# The *prior* says how probable each map is before the first reading. Here the robot knows nothing: each cell is a wall
# with probability 0.5, independently of all other cells.
#
# In `bayesmap.gen` a *generative function* is a program that makes random choices. `flip` makes one choice; `repeat`
# makes many independent ones. The method `simulate` runs the program, and returns a *trace*: the choices that
# were made, the value that the program returned, and the score. The score is the log probability of the choices.

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
    viz.plot_sample(ax, grid, drawn)
show(
    figure,
    "prior.png",
    "Three maps drawn from the prior. None looks like a building: the prior knows nothing of rooms.",
)

# %% [markdown]
# ## The exact sensor
#
# The walk in steps looks at the walls anew for each map. We can do better, since the range of a beam has two parts. The
# first part is geometry: how far along the beam does each cell begin? That distance does not depend on the walls, so we
# compute it once. The second part is a minimum: the range is the smallest of these distances among the wall cells.
#
# A cell is a square, the intersection of a vertical and a horizontal strip. The beam is in the square while it is in
# both strips. So the beam enters the square at the later of its two entries, and leaves the square when it leaves one
# of them. If the entry comes after the exit, the beam misses the cell.

# %%
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
walked = np.array([walked_range_m(true_walls, angle_rad) for angle_rad in angles_rad])
print(f"the walk in steps of a centimetre differs by {100 * np.abs(walked - exact).max():.1f} cm at most")

# %% A check against the library's own ray casting tags=["hide-input"]
library = bm.ranges(true_walls, grid, pose, angles_rad, max_range_m=MAX_RANGE_M)
agree = np.allclose(exact, library, rtol=0, atol=1e-4)
print(f"bm.ranges, which walks from cell to cell instead, agrees to 0.1 mm: {agree}")
assert agree
assert np.abs(walked - exact).max() < 0.0101

# %% [markdown]
# The room is open on its left side; the beams that leave there meet no wall.
#
# ## The noisy sensor
#
# The generative function for one beam makes one choice, the reading. `@ ()` says that the function makes no other
# choice, so the reading needs no name. `vmap` makes a scan from the function: one beam for each angle.


# %%
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
    viz.plot_sample(ax, grid, walls)
    viz.plot_rays(ax, seen)
    viz.plot_sensor(ax, pose)
    ax.set(xlim=(-0.5, 20.5), ylim=(-0.5, 20.5))
show(figure, "readings.png", "Exact readings, noisy readings, and the noisy ones without the map: the data.")

# %% [markdown]
# ## The full model
#
# The model is the prior, which makes the walls, and the sensor, which makes the readings. Each part gets an address:
# `"walls"` and `"readings"`. Under its address a choice can be found, fixed or changed.

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
# A generative function also *scores*: given all choices, `assess` returns their joint log probability. We score the
# true map with our readings, and an empty map with the same readings.

# %%
assess = jax.jit(full_model.assess)


def log_joint(walls, p_wall=P_WALL):
    """Log p(walls, readings)."""
    choices = C["walls"].set(jnp.asarray(walls) != 0) | C["readings"].set(readings)
    return assess(choices, (to_cells, p_wall))[0]


print(f"log p(true map, readings)  = {log_joint(true_walls):12.1f}")
print(f"log p(empty map, readings) = {log_joint(0 * true_walls):12.1f}")

# %% [markdown]
# The NumPy functions from above say the same. They lack the prior, which gives every map 441 log(0.5), and they are
# exact only to a centimetre a beam.

# %%
by_numpy = 441 * np.log(0.5) + log_likelihood(true_walls, np.asarray(readings))
print(f"the first number by NumPy  = {by_numpy:12.1f}")

# %% The first number, worked out by hand from the errors tags=["hide-input"]
by_hand = 441 * np.log(0.5) + (-0.5 * (errors / SIGMA_M) ** 2 - np.log(SIGMA_M * np.sqrt(2 * np.pi))).sum()
print(f"the first number by hand   = {by_hand:12.1f}")
assert np.isclose(log_joint(true_walls), by_hand, atol=0.1)
assert abs(by_numpy - by_hand) < 2.0

# %% [markdown]
# ## Importance sampling, and why it collapses
#
# We want the posterior: the probability of each map, given the readings. The plainest method draws many maps from the
# prior, and weighs each map by how well that map explains the readings. `importance` does this. The function fixes the
# choices that we hand over, draws the others, and returns the log weight. Here the log weight is log p(readings |
# walls). Divided by their sum, the weights say how much each map counts.
#
# The *effective sample size* is one over the sum of the squared weights. This number says how many equally weighted
# maps the weighted maps are worth. *Resampling* draws from the maps, each with a probability equal to its weight.

# %%
N_PARTICLES = 2_000


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
# All hundred resampled maps are the same map. Would more maps help? The compiled kernels of bayesmap do this work much
# faster, so we can afford five hundred times as many maps. `bm.infer` runs them.

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
viz.plot_weights(ax, weighed.log_weights, range_nats=(-50_000.0, 0.0))
ax.set_title(f"{len(weighed.log_weights):,} maps, effective sample size {size:.1f}", fontsize=10)
for note in ax.texts:
    note.set_fontsize(9)
show(figure, "weights.png", "A million log weights. The one at the right has all the weight; the others have none.")
figure, (ax,) = panels("best of a million")
viz.plot_sample(ax, grid, weighed.draws[0, 0])
viz.plot_truth_outline(ax, grid, true_walls)
viz.plot_sensor(ax, pose)
show(figure, "importance.png", "The map that has all the weight. Outlined: the true walls.")

# %% [markdown]
# With a thousand times as many maps, one map still has all the weight, and that map is bad. A map that explains the
# readings must have the first wall right in a hundred directions at once. How often does the prior draw such a map? At
# the least, every cell that a beam passes before its wall must be free:

# %%
passed = np.asarray((to_cells < exact[:, None, None] - 1e-3).any(axis=0))
print(f"cells that a beam passes before its first wall: {passed.sum()}")
print(f"the prior leaves them all free with probability 0.5^{passed.sum()} = 1e{np.log10(0.5) * passed.sum():.0f}")

# %% [markdown]
# No computer can draw enough maps. Importance sampling still has its use: the method works well where the unknown has
# three numbers instead of 441 cells, as on the page on [localization](localization.md).
#
# ## Exercises
#
# **1.** The map without the wall at (12, 13) was 64 nats worse than the true map; six beams end at that wall. At
# the wall at (17, 10) only three beams end. Compute how many nats the map loses without this wall, and explain the
# difference.

# %% Answer 1 tags=["hide-cell"]
without = true_walls.copy()
without[17, 10] = False
loss = log_likelihood(true_walls, first_readings_m) - log_likelihood(without, first_readings_m)
print(f"without the wall at (17, 10) the map is {loss:.0f} nats worse")
print("Behind (12, 13) the six beams soon meet another wall, so their readings are wrong by little.")
print("Behind (17, 10) there is none: three beams should then read 42 m instead of 6.5 m.")
print(f"A normal error of 35.5 m costs (35.5 / 0.2)^2 / 2 = {(35.5 / SIGMA_M) ** 2 / 2:.0f} nats.")
assert loss > 2 * (34.0 / SIGMA_M) ** 2 / 2

# %% [markdown]
# **2.** Three maps have the weights 1/2, 1/4 and 1/4. Compute their effective sample size. Compute also the effective
# sample size of ten thousand maps, one of which has all the weight.

# %% Answer 2 tags=["hide-cell"]
of_three = 1 / np.sum(np.array([1 / 2, 1 / 4, 1 / 4]) ** 2)
of_one = 1 / np.sum(np.eye(1, 10_000) ** 2)
print(f"{of_three:.2f} of three maps, and {of_one:.0f} of ten thousand")
assert np.isclose(of_three, 8 / 3)
assert of_one == 1

# %% [markdown]
# **3.** Let walls be rare: each cell is a wall with probability 0.05. With what probability does a map from the prior
# now leave all passed cells free? Does importance sampling find the walls with this prior?

# %% Answer 3 tags=["hide-cell"]
hits = np.where(true_walls, to_cells, np.inf).reshape(N_BEAMS, -1).argmin(axis=1)[exact < MAX_RANGE_M]
n_hit = len(np.unique(hits))
print(f"all {passed.sum()} passed cells are free with probability 0.95^{passed.sum()} = {0.95 ** passed.sum():.0e}")
print(f"all {n_hit} cells at which beams end are walls with probability 0.05^{n_hit} = 1e{n_hit * np.log10(0.05):.0f}")
print("So importance sampling fails with this prior too: now the walls are too rare to be guessed.")
assert 0.95 ** passed.sum() > 1e-5
assert n_hit * np.log10(0.05) < -40

# %% [markdown]
# Next: [Gibbs sampling](gibbs.md), which changes one cell at a time.
