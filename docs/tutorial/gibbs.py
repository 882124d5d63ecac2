# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Gibbs sampling
#
# The [first page](mapping.md) built a model of a map and of a robot's readings in it, and saw that guessing whole maps
# does not find the walls. Here we change a map one cell at a time. That works. Then we make it work faster: by editing
# traces, by visiting the cells in a better order, and by changing several cells together.
#
# Code that only draws a figure or checks what the text says is folded away; so is the model, which is that of the
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
# Go through the cells, and draw each one from its distribution *given all the others and the readings*. For a cell
# that can only be a wall or free, this conditional is easy: score the map both ways, and compare. One walk over all
# cells is a *sweep*. Whatever map we start from, maps after many sweeps are draws from the posterior.

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
    viz.draw_sample(ax, grid, chain[n - 1])
    viz.draw_truth_outline(ax, grid, true_walls)
show(figure, "gibbs.png", "The chain after some sweeps, from an empty map. Outlined: the true walls.")

# %% [markdown]
# The free space grows from sweep to sweep, and after some ten sweeps the maps explain the readings as well as the true
# map does. Behind a wall that should not be there nothing is seen, so cells there are drawn from the prior: half of
# them are walls. When the wall in front falls, those stand in the light, and must go in turn.
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
viz.draw_sample(axes[0], grid, chain[-1])
viz.draw_probability(axes[1], grid, share)
viz.draw_entropy(axes[2], grid, share)
for ax in axes[:2]:
    viz.draw_truth_outline(ax, grid, true_walls)
show(figure, "posterior.png", "A draw of the posterior, the mean of a hundred, and its entropy: bright is uncertain.")

# %% [markdown]
# The inside of the room is free and its walls stand. Behind the walls the posterior is the prior, 0.5: no beam has
# been there. A single best map could not say so.
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


def edit_sweep(request, key, trace, order=RASTER):
    """A Gibbs sweep by edits of a trace."""
    keys = jrand.split(key, len(order))

    def update(k, trace):
        walls = trace.get_choices()["walls"]
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
# An edit by index visits one element of the prior, not 441. But it still computes all hundred beams, for the sensor
# sees only that its argument `walls` has changed. It could do better: a cell concerns only the beams that cross it.
# How many are those?

# %%
crossing = np.isfinite(np.asarray(to_cells)).sum(axis=0)
print(f"beams through a cell: {crossing.mean():.1f} on average, {np.median(crossing):.0f} at the median, of {N_BEAMS}")

# %% [markdown]
# bayesmap's own mapping model makes use of that. `bm.mapping_model` is a generative function like ours, but its sensor
# answers an edit of one wall by visiting the beams through it ([mapping-model.md](../mapping-model.md)). The same
# sweep of edits runs on it unchanged, and ends in a map that its own `assess`, ours and the edits score alike.

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
# Gibbs may visit the cells in any order. The order so far begins at a corner of the map. But we saw that free space
# grows outwards from the robot: what lies in the shadow of a wall has to wait until the wall falls. If the sweep
# itself goes outwards, then a wall falls first, and the cells that come to light behind it are drawn in the same
# sweep.
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
    viz.draw_sample(ax, grid, np.asarray(ring == r).reshape(21, 21))
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
    viz.draw_sample(ax, grid, walls)
    viz.draw_truth_outline(ax, grid, true_walls)
show(figure, "orders.png", "The same random numbers in two orders, from an empty map. Outlined: the true walls.")

# %% [markdown]
# How much is gained? We count. The cells below the robot (y < 10) that both chains have emptied in the end are to be
# cleared; a chain is done after the first sweep in which none of them is a wall. Two hundred chains for each order, by
# edits of the fast model.

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
# A prior of 0.5 is not how buildings are. Say that walls are rare: 0.05. We start again from an empty map, with the
# better order.

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
# The robot has walled itself in, and a hundred sweeps do not free it. In an empty map beams fly on to 42 m; the first
# cells that the sweep visits can stop them, and to stop them too early is the lesser evil. Now those cells throw their
# shadows over the map. To take one away alone sends its beams off to whatever stands behind; and behind, in the
# shadow, cells are drawn from the prior. Where half of all cells are walls, something catches the beams. Where one in
# twenty is, many fly on, which their readings forbid. The wall and what stands behind it depend on each other, and an
# update of one cell can change only one of them.
#
# ## Block Gibbs
#
# So change cells together. Take a block of 2 x 2 cells: it has 16 states. Score the map with each, and draw one of
# them. That can take a wall away and put another one behind it in a single step. A sweep visits all blocks, and
# blocks may overlap.

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
    viz.draw_sample(ax, grid, walls)
    viz.draw_truth_outline(ax, grid, true_walls)
show(figure, "blocks.png", "Walls are rare: single cells are stuck, blocks are not. Outlined: the true walls.")

# %% [markdown]
# Each sweep pushes the walls that stand too near outwards, until they match the readings.
#
# How large is the difference? Take the worst case, a wall in the robot's own cell, and compute the chance that one
# update takes it away: fill the rest of the map, its shadow, from the prior, a thousand times, and average the
# probability that the update leaves the robot's cell free.

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
# The same model, the same readings: what differs is which cells change together.
#
# **Try it yourself**: [interactive.html](interactive.html), downloaded and opened in a browser, holds draws of this
# posterior. In the live page, `bayesmap app`, set the prior to 0.05 and compare the methods *gibbs* and *block*.
#
# Next: [the same samplers as compiled kernels](kernels.md), on this map and on a building; or
# [where is the robot?](localization.md), the opposite question.
