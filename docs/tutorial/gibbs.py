# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Gibbs sampling
#
# The [first page](mapping.md) built a model of a map and a robot's readings. Guessing whole maps did not find the
# walls. Here we change a map one cell at a time, and find them. Then we make the sampler faster: we edit traces, visit
# the cells in a better order, and change several cells together.
#
# **After this page you will be able to**
#
# - draw maps from the posterior, one cell at a time, by Gibbs sampling;
# - change a trace with `edit`, either by a whole new map or by the index of one cell;
# - choose an order of the cells in which a chain needs fewer sweeps;
# - recognise a chain that is stuck, and free it with blocks of cells.
#
# Reading time: about 20 minutes, without the exercises.
#
# Code that only draws a figure or checks the text is folded away. The model is folded away, too: it is that of the
# first page, word for word. In lines that begin with `time:` measured figures are rounded.

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
from bayesmap.viz.palette import CHAINS

# %% The model of the first page, and its readings tags=["hide-input"]
P_WALL, SIGMA_M, N_BEAMS, MAX_RANGE_M = 0.5, 0.2, 100, 42.0
true_walls, pose = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
angles_rad = np.arange(N_BEAMS) / N_BEAMS * 2 * np.pi
position = jnp.array(pose[:2], jnp.float32)
centres = jnp.stack(jnp.meshgrid(jnp.arange(21.0), jnp.arange(21.0), indexing="ij"), axis=-1)


def walls_prior(p_wall):
    """21 x 21 independent cells."""
    return gen.flip.repeat(n=21).repeat(n=21)(p_wall)


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


@gen.gen
def beam(to_cells, walls, sigma_m):
    """One noisy reading."""
    return gen.normal(exact_range(to_cells, walls), sigma_m) @ ()


scan = beam.vmap(in_axes=(0, None, None))


@gen.gen
def full_model(to_cells, p_wall):
    """Walls from the prior, and a scan of them."""
    walls = walls_prior(p_wall) @ "walls"
    readings = scan(to_cells, walls, SIGMA_M) @ "readings"
    return walls, readings


to_cells = jax.vmap(distances_to_cells, in_axes=(None, 0))(position, jnp.array(angles_rad))  # (100, 21, 21)
readings = scan.simulate(jrand.key(0), (to_cells, jnp.array(true_walls), SIGMA_M)).get_retval()
ARGS = (to_cells, P_WALL)
assess = jax.jit(full_model.assess)


def log_joint(walls, p_wall=P_WALL):
    """Log p(walls, readings)."""
    choices = C["walls"].set(jnp.asarray(walls) != 0) | C["readings"].set(readings)
    return assess(choices, (to_cells, p_wall))[0]


# %% [markdown]
# ## One cell at a time
#
# Gibbs sampling goes through the cells, and draws each cell from its distribution *given all other cells and the
# readings*. A cell has only two states, so this conditional distribution is easy to compute: score the map with the
# cell as a wall and with the cell free, and compare. One pass over all cells is a *sweep*, and the maps after each
# sweep are a *chain*. From any start, the maps after many sweeps are nearly draws from the posterior, each like the
# one before. How many sweeps it takes depends on the posterior: in *Where walls are rare* a chain is stuck for
# hundreds of sweeps. R-hat and effective sample sizes, on the next page, tell such chains from good ones.

# %%


def gibbs_update(key, walls, i, j):
    """Draw a cell given all others."""
    as_free, as_wall = walls.at[i, j].set(False), walls.at[i, j].set(True)
    is_wall = gen.bernoulli.sample(key, logits=log_joint(as_wall) - log_joint(as_free))
    return walls.at[i, j].set(is_wall.astype(bool))


RASTER = jnp.stack(jnp.meshgrid(jnp.arange(21), jnp.arange(21), indexing="ij"), axis=-1).reshape(441, 2)


def sweep(key, walls, order):
    """Visit all cells in some order: `order` holds their indices (i, j), shape (441, 2)."""
    keys = jrand.split(key, len(order))
    return jax.lax.fori_loop(0, len(order), lambda k, walls: gibbs_update(keys[k], walls, *order[k]), walls)


@jax.jit
def gibbs_chain(keys, walls, order):
    """The map after each sweep."""

    def step(walls, key):
        walls = sweep(key, walls, order)
        return walls, walls

    return jax.lax.scan(step, walls, keys)[1]


empty = jnp.zeros((21, 21), bool)
sweep_keys = jrand.split(jrand.key(0), 120)
compiled = gibbs_chain.lower(sweep_keys, empty, RASTER).compile()
began = time.perf_counter()
chain = np.asarray(compiled(sweep_keys, empty, RASTER))
assess_ms = 1e3 * (time.perf_counter() - began) / len(chain)
for n in (1, 2, 5, 10, 20, 120):
    print(f"after sweep {n:3d}: log joint {log_joint(chain[n - 1]):10.1f}, {chain[n - 1].sum():3d} walls")
print(f"time: a sweep takes about {assess_ms:.0f} ms")

# %% tags=["hide-input"]
assert log_joint(chain[4]) < log_joint(true_walls) - 10_000
assert all(abs(log_joint(walls) - log_joint(true_walls)) < 60 for walls in chain[19:])
figure, axes = panels(*(f"sweep {n}" for n in (1, 3, 6, 12)))
for ax, n in zip(axes, (1, 3, 6, 12), strict=True):
    viz.plot_sample(ax, grid, chain[n - 1])
    viz.plot_truth_outline(ax, grid, true_walls)
show(figure, "gibbs.png", "The chain after some sweeps, from an empty map. Outlined: the true walls.")

# %% [markdown]
# The free space grows from sweep to sweep. After some ten sweeps the maps explain the readings as well as the true map
# does. No beam passes a wall that stands too near, so the cells behind this wall are drawn from the prior: half of them
# are walls. When the near wall is removed, beams reach the walls behind it, which are then removed in turn.
#
# One map is one draw. The share of draws in which a cell is a wall is its posterior probability:

# %%
share = chain[20:].mean(axis=0)
passed = np.asarray((to_cells < np.asarray(readings)[:, None, None] - 2.0).any(axis=0))
unseen = ~np.asarray(to_cells <= np.asarray(readings)[:, None, None] + 2.0).any(axis=0)
print(f"cells that some beam passes, two metres before its end: walls in {share[passed].mean():.1%} of draws")
print(f"cells that no beam comes within two metres of: walls in {share[unseen].mean():.1%} of draws")

# %% tags=["hide-input"]
assert share[passed].mean() < 0.01
assert abs(share[unseen].mean() - 0.5) < 0.02
figure, axes = panels("one draw", "probability of a wall", "uncertainty")
viz.plot_sample(axes[0], grid, chain[-1])
viz.plot_probability(axes[1], grid, share)
viz.plot_entropy(axes[2], grid, share)
for ax in axes[:2]:
    viz.plot_truth_outline(ax, grid, true_walls)
show(figure, "posterior.png", "A draw of the posterior, the mean of a hundred, and its entropy: bright is uncertain.")

# %% [markdown]
# The inside of the room is free, and the walls of the room are found. Behind the walls the posterior equals the prior,
# 0.5, because no beam has been there. A single best map could not show this.
#
# ## Incremental edits
#
# Scoring the whole model twice for a change of one cell is wasteful. A trace can be *edited* instead: `edit` takes a
# request, and returns the new trace and the change of its log probability. Gibbs sampling needs only this change, and
# keeps the flipped cell with probability 1 / (1 + exp(-change)).
#
# Two requests can flip a cell. `Update` hands over a whole new map; `IndexRequest` names the one element that changes.
# Both must give the same trace, and the score that `assess` gives.

# %%


def flip_by_update(walls, i, j):
    """The new map, whole."""
    return gen.StaticRequest({"walls": gen.Update(C.v(walls.at[i, j].set(~walls[i, j])))})


def flip_by_index(walls, i, j):
    """The new cell, and where it is."""
    cell = gen.IndexRequest(jnp.asarray(j), gen.Update(C.v(~walls[i, j])))
    return gen.StaticRequest({"walls": gen.IndexRequest(jnp.asarray(i), cell)})


def edit_sweep(request, key, trace, order=RASTER):
    """A Gibbs sweep by edits of a trace."""
    keys = jrand.split(key, len(order))

    def update(k, trace):
        walls = trace.get_choices()["walls"]
        # These edits draw nothing, so the key is used once.
        flipped, change, _, _ = trace.edit(keys[k], request(walls, *order[k]), None)
        return jax.lax.cond(gen.bernoulli.sample(keys[k], logits=change), lambda: flipped, lambda: trace)

    return jax.lax.fori_loop(0, len(order), update, trace)


start, _ = full_model.importance(jrand.key(0), C["walls"].set(empty) | C["readings"].set(readings), ARGS)
by_update = jax.jit(lambda key, trace: edit_sweep(flip_by_update, key, trace))(jrand.key(5), start)
by_index = jax.jit(lambda key, trace: edit_sweep(flip_by_index, key, trace))(jrand.key(5), start)
same = bool((by_update.get_choices()["walls"] == by_index.get_choices()["walls"]).all())
print(f"the two requests draw the same map: {same}")
print(f"score that 441 edits have kept up {by_index.get_score():.2f}")
print(f"score from scratch                {log_joint(by_index.get_choices()['walls']):.2f}")

# %% tags=["hide-input"]
assert same
assert np.isclose(by_index.get_score(), log_joint(by_index.get_choices()["walls"]), rtol=1e-5)

# %% [markdown]
# An edit by index visits one element of the prior instead of 441. The sensor still computes all hundred beams, since
# the sensor learns only that its argument `walls` has changed. Yet a cell changes only those beams that cross the cell.
# How many beams cross a cell?

# %%
crossing = np.isfinite(np.asarray(to_cells)).sum(axis=0)
print(f"beams through a cell: {crossing.mean():.1f} on average, {np.median(crossing):.0f} at the median, of {N_BEAMS}")

# %% [markdown]
# `bm.mapping_model` is a generative function like ours. After an edit of one cell, its sensor computes only the beams
# that cross this cell ([mapping-model.md](../mapping-model.md)). Our sweep of edits runs on `bm.mapping_model`
# unchanged. Three scores of the last map agree: the score that the edits keep up, the model's `assess`, and our
# `assess`.

# %%


def fast_trace(p_wall, walls=empty):
    """A trace of bayesmap's mapping model, with our readings."""
    model = bm.mapping_model(
        grid, pose, angles_rad, bm.Independent(p_wall), bm.Gaussian(SIGMA_M), max_range_m=MAX_RANGE_M
    )
    return model.importance(jrand.key(0), C["walls"].set(walls) | C["readings"].set(readings), ())[0]


fast_start = fast_trace(P_WALL)
fast_sweep = jax.jit(lambda key, trace: edit_sweep(flip_by_index, key, trace))
fast_end = fast_sweep(jrand.key(5), fast_start)
began = time.perf_counter()
for k in range(5):
    jax.block_until_ready(fast_sweep(jrand.key(k), fast_end))
fast_ms = 1e3 * (time.perf_counter() - began) / 5
by_fast_model = fast_end.get_gen_fn().assess(fast_end.get_choices(), ())[0]
print(
    f"log joint by the edits {fast_end.get_score():.2f}, by its assess {by_fast_model:.2f}, "
    f"by ours {log_joint(fast_end.get_choices()['walls']):.2f}"
)
print(f"time: a sweep by such edits takes about {fast_ms:.1f} ms; by assess it took {assess_ms:.0f} ms")

# %% tags=["hide-input"]
assert crossing.mean() < 10
assert np.isclose(fast_end.get_score(), by_fast_model, rtol=1e-5)
assert np.isclose(by_fast_model, log_joint(fast_end.get_choices()["walls"]), rtol=1e-4)

# %% [markdown]
# ## A better order
#
# Gibbs sampling may visit the cells in any order. So far, each sweep began at a corner of the map. But free space grows
# outwards from the robot: a cell behind a wall can be found free only after this wall has been removed. A sweep that
# goes outwards removes the wall first, and then draws the cells behind it in the same sweep.
#
# So we visit the robot's own cell, then the ring of four cells around it, then the next ring, and so on. A cell's ring
# is its distance to the robot, counted in steps along x and along y.

# %%
ring = jnp.abs(RASTER - jnp.round(position).astype(int)).sum(axis=-1)
RADIAL = RASTER[jnp.argsort(ring)]
print("the first cells of the sweep:", ", ".join(str(tuple(cell)) for cell in RADIAL[:6].tolist()))
radial_chain = np.asarray(gibbs_chain(sweep_keys[:12], empty, RADIAL))

# %% Code of the figures tags=["hide-input"]
shown = (0, 1, 4, 8)
figure, axes = panels(*(f"ring {r}" for r in shown), "place in the sweep", size_in=2.6)
for ax, r in zip(axes, shown, strict=False):
    viz.plot_sample(ax, grid, np.asarray(ring == r).reshape(21, 21))
place = np.empty(441, int)
place[np.asarray(RADIAL @ jnp.array([21, 1]))] = np.arange(441)
image = axes[-1].imshow(place.reshape(21, 21).T, origin="lower", cmap="viridis")
axes[-1].set(xlabel="x [m]", ylabel="y [m]", xticks=range(0, 21, 5), yticks=range(0, 21, 5))
figure.colorbar(image, ax=axes[-1], shrink=0.8)
show(
    figure, "rings.png", "Four of the rings around the robot, dark, and the order in which the sweep visits all cells."
)
figure, axes = panels(*(f"raster, sweep {n}" for n in (2, 4)), *(f"radial, sweep {n}" for n in (2, 4)))
for ax, walls in zip(axes, (chain[1], chain[3], radial_chain[1], radial_chain[3]), strict=True):
    viz.plot_sample(ax, grid, walls)
    viz.plot_truth_outline(ax, grid, true_walls)
show(figure, "orders.png", "The same random numbers in two orders, from an empty map. Outlined: the true walls.")

# %% [markdown]
# How many sweeps does the better order save? We look at the cells below the robot (y < 10) that a beam passes two
# metres before its end. We count the sweeps until none of these cells is a wall, in two hundred chains for each order.
# The chains use edits of the fast model.

# %%
N_CHAINS, MOST_SWEEPS = 200, 20
below = passed.copy()
below[:, 10:] = False


@jax.jit
def sweeps_to_clear(keys, order):
    """The number of the first sweep after which the cells below are free, for a chain a key."""

    def one_chain(key):
        def step(trace, key):
            trace = edit_sweep(flip_by_index, key, trace, order)
            return trace, (trace.get_choices()["walls"] & below).any()

        return 1 + jax.lax.scan(step, fast_start, jrand.split(key, MOST_SWEEPS))[1].argmin()

    return jax.lax.map(one_chain, keys, batch_size=25)


keys = jrand.split(jrand.key(7), N_CHAINS)
cleared = {name: np.asarray(sweeps_to_clear(keys, order)) for name, order in (("raster", RASTER), ("radial", RADIAL))}
print(f"{below.sum()} cells below the robot are to be cleared")
for name, counts in cleared.items():
    low, middle, high = np.percentile(counts, [5, 50, 95])
    print(f"{name}: mean {counts.mean():5.2f} sweeps, median {middle:.0f}, 90 % of chains {low:.0f} to {high:.0f}")

# %% tags=["hide-input"]
assert cleared["radial"].mean() < 0.6 * cleared["raster"].mean()
figure, (ax,) = panels("sweeps until clear", size_in=4.0, height_in=3.0)
for color, (name, counts) in zip(CHAINS, cleared.items(), strict=False):
    ax.hist(counts, bins=np.arange(0.5, 18.5), histtype="step", linewidth=1.6, label=name, color=color)
ax.set(xlabel="sweeps", ylabel=f"chains of {N_CHAINS}", xticks=range(0, 19, 3))
ax.legend(frameon=False, fontsize=9)
show(figure, "order.png", "Sweeps until the space below the robot is clear, by order of the cells.")

# %% [markdown]
# ## Where walls are rare
#
# In real buildings fewer than half of the cells are walls. So let each cell be a wall with probability 0.05. We start
# again from an empty map, with the better order.

# %%
RARE = 0.05
rare_start = fast_trace(RARE)
rare_sweep = jax.jit(lambda key, trace: edit_sweep(flip_by_index, key, trace, RADIAL))
stuck = rare_start
for k in range(100):
    stuck = rare_sweep(jrand.key(k), stuck)
stuck = np.asarray(stuck.get_choices()["walls"])
print(f"log joint of the true map {log_joint(true_walls, RARE):.0f}, after 100 sweeps {log_joint(stuck, RARE):.0f}")
near = [(i, j) for i, j in RADIAL[:5].tolist() if stuck[i, j]]
for i, j in near:
    without = stuck.copy()
    without[i, j] = False
    print(f"there is a wall at {i, j}, beside the robot; without it the log joint is {log_joint(without, RARE):.0f}")
    assert log_joint(without, RARE) < log_joint(stuck, RARE) - 100

# %% tags=["hide-input"]
assert near
assert log_joint(stuck, RARE) < log_joint(true_walls, RARE) - 10_000

# %% [markdown]
# The chain has put walls right beside the robot, and a hundred sweeps do not remove them. In an empty map every beam
# reads 42 m. A wall that stops a beam too early explains the reading better than 42 m does, so the first cells of the
# sweep become walls. Such a wall hides all cells behind it, and hidden cells follow the prior. If this wall is removed,
# its beams travel on among the hidden cells. With a prior of 0.5, another wall soon stops each beam. With a prior of
# 0.05, many beams travel too far, and their readings forbid that. So a near wall can be removed only if a wall behind
# it appears at the same time. An update of one cell cannot make both changes.
#
# ## Block Gibbs
#
# The remedy is to change cells together. A block of 2 x 2 cells has 16 states. *Block Gibbs* scores the map with each
# state, and draws one of the 16. One step can then remove a wall and put another one behind it. A sweep visits all
# blocks, and blocks overlap.

# %%
BLOCKS = (np.arange(16)[:, None] >> np.arange(4) & 1).astype(bool).reshape(16, 2, 2)


def block_update(key, walls, i, j):
    """Draw the cells [i : i + 2, j : j + 2] given all others."""
    maps = jax.vmap(lambda block: jax.lax.dynamic_update_slice(walls, block, (i, j)))(jnp.asarray(BLOCKS))
    scores = jax.vmap(lambda walls: log_joint(walls, RARE))(maps)
    return maps[gen.categorical.sample(key, logits=scores)]


@jax.jit
def block_sweep(key, walls):
    """Visit all overlapping blocks, by rows."""
    keys = jrand.split(key, 400)
    return jax.lax.fori_loop(0, 400, lambda k, walls: block_update(keys[k], walls, k // 20, k % 20), walls)


block_chain = [empty]
for k in range(30):
    block_chain.append(block_sweep(jrand.key(k), block_chain[-1]))
for n in (1, 2, 5, 10, 20, 30):
    print(f"after sweep {n:2d}: log joint {log_joint(block_chain[n], RARE):10.1f}, {int(block_chain[n].sum())} walls")

# %% tags=["hide-input"]
assert log_joint(block_chain[-1], RARE) > log_joint(true_walls, RARE) - 30
figure, axes = panels("one cell at a time: sweep 100", "blocks: sweep 3", "blocks: sweep 10", "blocks: sweep 30")
for ax, walls in zip(axes, (stuck, block_chain[3], block_chain[10], block_chain[30]), strict=True):
    viz.plot_sample(ax, grid, walls)
    viz.plot_truth_outline(ax, grid, true_walls)
show(figure, "blocks.png", "Walls are rare: single cells are stuck, blocks are not. Outlined: the true walls.")

# %% [markdown]
# Each sweep pushes the walls that stand too near outwards, until they match the readings.
#
# How much easier does a block remove a wall? We take the worst case, a wall in the robot's own cell, which hides all
# other cells. We draw the other cells from the prior, a thousand times. For each of these maps we compute the
# probability that one update frees the robot's cell, and then average the thousand probabilities.

# %%


@jax.jit
def chance_to_leave(maps, states, p_wall):
    """The probability that an update of the cells [10:, 10:] among `states` (n, h, w) frees cell (10, 10)."""

    def of_one(walls):
        scores = jax.vmap(lambda state: log_joint(jax.lax.dynamic_update_slice(walls, state, (10, 10)), p_wall))(states)
        return jnp.sum(jnp.where(states[:, 0, 0], 0.0, jax.nn.softmax(scores)))

    return jax.lax.map(of_one, maps, batch_size=50).mean()


one_cell = np.array([False, True]).reshape(2, 1, 1)
chances = []
for p_wall, name, states in ((P_WALL, "cell", one_cell), (RARE, "cell", one_cell), (RARE, "block", BLOCKS)):
    shadows = np.random.default_rng(0).random((1_000, 21, 21)) < p_wall
    chances.append(float(chance_to_leave(jnp.asarray(shadows), jnp.asarray(states), p_wall)))
    print(f"prior {p_wall:4}: one update of the {name:5s} frees the robot's cell with probability {chances[-1]:.4f}")

# %% tags=["hide-input"]
assert chances[0] > 0.9
assert chances[2] > 20 * chances[1]

# %% [markdown]
# Model and readings are the same for cell and block. Only the set of cells that change together differs.
#
# **Try it yourself**: start the live page with `bayesmap app`, set the prior to 0.05, and compare the methods
# *Gibbs, cell by cell* and *Gibbs, 2 × 2 blocks*.
#
# ## Exercises
#
# **1.** A cell lies behind the walls, where no beam comes. Give its conditional probability of being a wall, for a
# prior of 0.5 and for a prior of 0.05. Check your answer with `log_joint`.

# %% Answer 1 tags=["hide-cell"]
i, j = np.argwhere(unseen)[0]
as_free, as_wall = true_walls.copy(), true_walls.copy()
as_free[i, j], as_wall[i, j] = False, True
for p_wall in (P_WALL, RARE):
    change = float(log_joint(as_wall, p_wall) - log_joint(as_free, p_wall))
    print(f"prior {p_wall}: the cell {int(i), int(j)} is a wall with probability {1 / (1 + np.exp(-change)):.3f}")
    assert np.isclose(1 / (1 + np.exp(-change)), p_wall, atol=1e-3)
print("No reading depends on the cell, so the probability is that of the prior.")

# %% [markdown]
# **2.** A block of 3 x 3 cells removes a near wall more easily still. How many maps does a sweep over all overlapping
# 3 x 3 blocks score, and how many does a sweep over 2 x 2 blocks?

# %% Answer 2 tags=["hide-cell"]
maps_scored = {side: (21 - side + 1) ** 2 * 2 ** (side * side) for side in (2, 3)}
print(f"2 x 2: 20 * 20 blocks of 2^4 states, {maps_scored[2]:,} maps")
print(
    f"3 x 3: 19 * 19 blocks of 2^9 states, {maps_scored[3]:,} maps, {maps_scored[3] / maps_scored[2]:.0f} times as many"
)
assert maps_scored == {2: len(BLOCKS) * 400, 3: 361 * 512}

# %% [markdown]
# **3.** A chain in the radial order needs fewer sweeps than a chain in the raster order. Does the posterior depend on
# the order, too?
#
# <details><summary>Answer 3</summary>
#
# No. An update draws one cell from its conditional distribution. If the map is a draw from the posterior before the
# update, the map is a draw from the posterior after the update. This holds for every cell, and so for any fixed
# sequence of cells. The order changes only how many sweeps a chain needs until its start is forgotten.
#
# </details>
#
# Next: [the same samplers as compiled kernels](kernels.md), on this map and on a building; or [where is the
# robot?](localization.md), the opposite question.
