# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # The same samplers, compiled
#
# The [page before](gibbs.md) wrote Gibbs sampling as programs of `bayesmap.gen`. bayesmap has these samplers as
# compiled kernels, too, which are thousands of times faster; `bm.infer` runs the kernels. First we check that programs
# and kernels sample the same posterior. Then we use the speed of the kernels to measure how many sweeps a chain needs.
# We compare Gibbs sampling with belief propagation, and end with a building.
#
# **After this page you will be able to**
#
# - check that two samplers draw from the same posterior;
# - judge with R-hat whether chains from different starts have converged;
# - say which answers belief propagation gives, and when these are too sure;
# - map a building with `bm.infer`, and score the map on held-out beams.
#
# Reading time: about 20 minutes, without the exercises.
#
# Code that only draws a figure or checks what the text says is folded away. In lines that begin with `time:` measured
# figures are rounded.

# %%
import jax
import jax.numpy as jnp
import jax.random as jrand
import numpy as np
from drawing import panels, show

import bayesmap as bm
from bayesmap import gen, viz
from bayesmap.cells.kinds import default_sensor
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.posterior.summary import rhat
from bayesmap.viz.palette import CHAINS

# %% [markdown]
# ## The same posterior
#
# For every beam the kernels keep a list of the cells that the beam crosses. Beside each cell of the list stands the log
# likelihood of the reading if that cell is the first wall. An update of a cell visits only the beams that cross the
# cell ([beam-table.md](../beam-table.md)).
#
# The map, the robot and its sensor are those of the pages before. We score four draws from the kernels' chains twice:
# by the kernels, and by the generative function `bm.mapping_model`.

# %%
MAX_RANGE_M = 42.0
true_walls, pose = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
angles_rad = np.arange(100) / 100 * 2 * np.pi
sensor = bm.Gaussian(0.2)
scans = bm.simulate(true_walls, grid, pose, angles_rad, sensor=sensor, max_range_m=MAX_RANGE_M, seed=0)
problem = {"scans": scans, "grid": grid, "prior": bm.Independent(0.5), "sensor": sensor}

run = bm.infer(**problem, method="gibbs", schedule=bm.Schedule(chains=4, warmup=200, draws=5_000))
model = bm.mapping_model(grid, pose, angles_rad, bm.Independent(0.5), sensor, max_range_m=MAX_RANGE_M)
readings = C["readings"].set(scans.ranges_m[0])
by_gen = [float(model.assess(readings | C["walls"].set(walls), ())[0]) for walls in run.draws[:, 0]]
print("log joint by gen:        ", np.round(by_gen, 2))
print("log joint by the kernels:", np.round(run.log_joint[:, 0], 2))
assert np.allclose(by_gen, run.log_joint[:, 0], atol=0.05)

# %% [markdown]
# The two scores agree. Do the draws agree, too? We run the program of the last page, Gibbs sampling by edits of a
# trace, for a few thousand sweeps. Then we compare how often each cell is a wall.

# %%
N_SWEEPS = 4_000


@jax.jit
def edit_chain(keys, trace):
    """The map after each sweep of edits."""

    def update(k, carried):
        key, trace = carried
        cell_key, i, j = jrand.fold_in(key, k), k // 21, k % 21
        flip = gen.IndexRequest(j, gen.Update(C.v(~trace.get_choices()["walls"][i, j])))
        flipped, change, _, _ = trace.edit(cell_key, gen.StaticRequest({"walls": gen.IndexRequest(i, flip)}))
        keep = gen.bernoulli.sample(cell_key, logits=change)
        return key, jax.lax.cond(keep, lambda: flipped, lambda: trace)

    def sweep(trace, key):
        _, trace = jax.lax.fori_loop(0, 441, update, (key, trace))
        return trace, trace.get_choices()["walls"]

    return jax.lax.scan(sweep, trace, keys)[1]


start, _ = model.importance(jrand.key(0), readings | C["walls"].set(jnp.zeros((21, 21), bool)), ())
by_edits = np.asarray(edit_chain(jrand.split(jrand.key(0), N_SWEEPS), start))[200:].mean(axis=0)
differs = np.abs(by_edits - run.occupancy)
print(f"a cell's share of walls by the program and by the kernels: {differs.mean():.4f} apart on average,")
print(
    f"  {differs.max():.3f} at most (the true map is {np.abs(true_walls - run.occupancy).mean():.2f} away on average)"
)
print(f"time: {1e6 / run.summary().microseconds_per_sweep:.0f} sweeps a second by the kernels, on one core")

# %% tags=["hide-input"]
assert differs.max() < 0.06
assert differs.mean() < 0.01
assert run.summary().rhat_max < 1.01
figure, axes = panels("gen, 3800 sweeps", "kernels, 20 000 sweeps", "uncertainty")
for ax, mean in zip(axes[:2], (by_edits, run.occupancy), strict=True):
    viz.plot_probability(ax, grid, mean)
    viz.plot_truth_outline(ax, grid, true_walls)
viz.plot_entropy(axes[2], grid, run.occupancy)
show(figure, "agree.png", "Posterior probability of a wall, twice, and its entropy: bright is uncertain.")

# %% [markdown]
# ## Where walls are rare, counted
#
# On the last page walls had a prior probability of 0.05. A chain that changed single cells was stuck there, and a chain
# that changed blocks was not. One chain proves little. So we start chains from an empty map, from a map full of walls,
# and from draws of the prior. Converged chains agree, wherever they started. *R-hat* compares the spread between chains
# with the spread within chains: 1 means agreement, and chains with an R-hat over 1.05 have not converged. Here R-hat is
# that of the log joint, over the second half of the first n sweeps.

# %%
RARE = 0.05
rare = problem | {"prior": bm.Independent(RARE)}
prior_starts = [bm.Independent(RARE).sample(np.random.default_rng(k), grid) for k in range(4)]
starts = np.stack([0 * true_walls] * 4 + [0 * true_walls + 1] * 4 + prior_starts)
METHODS = {"gibbs": bm.Gibbs, "block": bm.Block}
SWEEPS = {"gibbs": 16_384, "block": 1_024}
traces = {}
for method, n in SWEEPS.items():
    schedule = bm.Schedule(chains=12, warmup=n, draws=0)
    watched = bm.infer(**rare, method=METHODS[method](start=starts), schedule=schedule, seed=3)
    traces[method] = watched.posterior.warmup_log_joint


def rhat_after(trace):
    """R-hat of the second half of the first n sweeps, for n = 16, 32, ..."""
    return {n: rhat(trace[:, n // 2 : n]) for n in 2 ** np.arange(4, 15) if n <= trace.shape[1]}


single, block = (rhat_after(traces[method]) for method in ("gibbs", "block"))
for n, value in single.items():
    by_start = traces["gibbs"][:, n // 2 : n].mean(axis=1).reshape(3, 4).mean(axis=1)
    parts = ", ".join(f"{name} {mean:9.0f}" for name, mean in zip(("zeros", "ones", "prior"), by_start, strict=True))
    print(f"single cells, {n:5d} sweeps: R-hat {value:5.2f}; mean log joint from {parts}")
for n, value in block.items():
    print(f"blocks,       {n:5d} sweeps: R-hat {value:5.2f}")

# %% tags=["hide-input"]
assert all(single[n] > 1.5 for n in (16, 64, 256, 1024))
assert all(block[n] < 1.05 for n in (128, 256, 512, 1024))
figure, axes = panels("single cells: log joint", "2 x 2 blocks: log joint", "R-hat", size_in=3.6)
top = max(trace.max() for trace in traces.values()) + 10
for ax, trace in zip(axes[:2], traces.values(), strict=True):
    for chain_number, line in enumerate(trace):
        color = CHAINS[chain_number // 4]
        label = ("zeros", "ones", "prior")[chain_number // 4] if chain_number % 4 == 0 else None
        ax.loglog(1 + np.arange(len(line)), top - line, color=color, linewidth=0.7, alpha=0.8, label=label)
    ax.set(xlabel="sweep", ylim=(1e6, 1.0))
axes[0].set_ylabel("nats below the top")
axes[0].legend(frameon=False, title="start", fontsize=8, title_fontsize=8)
for name, values in (("single cells", single), ("2 x 2 blocks", block)):
    axes[2].semilogx(list(values), list(values.values()), marker="o", markersize=3, label=name)
axes[2].axhline(1.05, color="grey", linewidth=0.8, linestyle="--")
axes[2].set(xlabel="sweeps")
axes[2].legend(frameon=False, fontsize=8)
show(figure, "rare.png", "Prior 0.05. Twelve chains by single cells and by blocks, and R-hat of both. Dashed: 1.05.")

# %% [markdown]
# After a thousand sweeps over single cells the chains still disagree, by thousands of nats. They agree only after some
# thousand sweeps more. A single chain hides this: over a hundred sweeps its log joint is flat, as if the chain had
# converged. The chains that start full of walls do best, because their first sweep goes outwards and removes walls
# until the readings are explained. This start happens to suit this map, and does not mend the sampler. Chains that
# change blocks agree within tens of sweeps, from every start.
#
# How many sweeps does one chain need? We say that a chain has arrived when its log joint first exceeds the posterior's
# 0.1 % quantile. A sweep over blocks costs more than a sweep over cells, so we also give the ratio of their times.

# %%
reference = bm.infer(**rare, method="block", schedule=bm.Schedule(chains=4, warmup=200, draws=3_000), seed=4)
threshold = np.quantile(reference.log_joint, 1e-3)
arrived = {}
for method, n in (("gibbs", 8_000), ("block", 200)):
    schedule = bm.Schedule(chains=16, warmup=n, draws=0)
    early = bm.infer(**rare, method=METHODS[method](start="zeros"), schedule=schedule, seed=5)
    there = early.posterior.warmup_log_joint > threshold
    assert there.any(axis=1).all()
    arrived[method] = there.argmax(axis=1) + 1
    low, middle, high = np.percentile(arrived[method], [0, 50, 100])
    print(f"{method}: from an empty map, {low:.0f} to {high:.0f} sweeps, median {middle:.0f} (16 chains)")
settled, schedule = reference.draws[:, -1], bm.Schedule(chains=4, warmup=0, draws=1_000)
timed = [bm.infer(**rare, method=kind(start=settled), schedule=schedule, seed=6) for kind in METHODS.values()]
cost = [run.summary().microseconds_per_sweep for run in timed]
print(f"time: a sweep over blocks costs about {cost[1] / cost[0]:.0f} times one over cells")

# %% tags=["hide-input"]
assert reference.summary().rhat_max < 1.01
assert np.median(arrived["gibbs"]) > 20 * np.median(arrived["block"])

# %% [markdown]
# ## Belief propagation
#
# *Belief propagation* computes probabilities without sampling. Beams and cells send messages to each other. A message
# from a beam to a cell says how probable this beam makes a wall in the cell. The beam computes the message from the
# messages of its other cells. The rounds of messages end when the messages no longer change. The result is one
# probability for each cell, its *marginal*. The marginals are exact if no two beams share a cell, and approximate
# otherwise. We compare the marginals with converged chains of block Gibbs, first for our sensor, and then for a sensor
# with 0.5 m of noise.

# %%
compared = []
for sigma_m in (0.2, 0.5):
    worse = bm.Gaussian(sigma_m)
    seen = bm.simulate(true_walls, grid, pose, angles_rad, sensor=worse, max_range_m=MAX_RANGE_M, seed=0)
    known = {"scans": seen, "grid": grid, "prior": bm.Independent(RARE), "sensor": worse}
    gibbs = bm.infer(**known, method="block", schedule=bm.Schedule(chains=4, draws=2_000))
    belief = bm.infer(**known, method=bm.Propagate(rounds=50), schedule=bm.Schedule(chains=1, draws=500))
    off = np.abs(belief.occupancy - gibbs.occupancy)
    typical = np.median(gibbs.log_joint) - np.median(belief.log_joint)
    rounds = len(belief.posterior.statistics["belief_changes"])
    print(f"noise {sigma_m} m, {rounds} rounds of beliefs")
    print(
        f"  marginals differ by {off.mean():.4f} on average, {off.max():.3f} at most, {(off > 0.1).sum()} by over 0.1"
    )
    print(f"  entropy of the marginals: {belief.entropy.sum():.1f} bits, by block Gibbs {gibbs.entropy.sum():.1f}")
    print(f"  whole maps drawn from the beliefs are {typical:.0f} nats less likely than draws (medians)")
    compared.append((gibbs, belief))
    assert gibbs.summary().rhat_max < 1.02
    assert typical > 1000

# %% tags=["hide-input"]
off_good, off_worse = (np.abs(belief.occupancy - gibbs.occupancy).max() for gibbs, belief in compared)
assert off_good < 0.03
assert off_worse > 0.2
assert compared[1][1].entropy.sum() < compared[1][0].entropy.sum()
figure, axes = panels("noise 0.2 m", "noise 0.5 m", size_in=3.6)
for ax, (gibbs, belief) in zip(axes, compared, strict=True):
    ax.plot([0, 1], [0, 1], color="grey", linewidth=0.8)
    ax.plot(gibbs.occupancy.ravel(), belief.occupancy.ravel(), "o", markersize=3, alpha=0.5)
    ax.set(xlabel="block Gibbs", ylabel="belief propagation", aspect="equal")
show(figure, "beliefs.png", "Wall probability of each cell, by beliefs and by block Gibbs. On the line they agree.")

# %% [markdown]
# With the good sensor the marginals are right to about a percent. With the worse sensor they are too sure. The cells
# off the line at the top of the figure are certain walls by belief propagation, but the posterior leaves them open. The
# reason is that belief propagation counts beams that share cells as independent evidence. With both sensors, marginals
# say nothing about how cells depend on each other. "The wall is in this cell or in the next" cannot be said cell by
# cell. So whole maps drawn from the marginals are thousands of nats less likely than draws from the posterior.
#
# bayesmap uses belief propagation to start chains on large maps, and where only marginals are needed.
#
# ## More than one place
#
# From the middle of the room the robot cannot see some corners. The model allows more than one pose: more poses are
# more beams. The noise is 0.5 m again.

# %%
stops = np.array([pose, [6.0, 9.0, 0.0], [13.0, 10.0, 0.0], [9.0, 5.0, 0.0], [9.0, 14.0, 0.0]])
noisy = bm.Gaussian(0.5)
several = []
for poses in (stops[:1], stops):
    seen = bm.simulate(true_walls, grid, poses, angles_rad, sensor=noisy, max_range_m=MAX_RANGE_M, seed=0)
    several.append(
        bm.infer(
            seen, grid, prior=bm.Independent(RARE), sensor=noisy, method="block", schedule=bm.Schedule(draws=1_000)
        )
    )
    undecided = int(((several[-1].occupancy > 0.1) & (several[-1].occupancy < 0.9)).sum())
    print(f"{len(poses)} pose(s): {several[-1].entropy.sum():6.1f} bits, {undecided:2d} cells between 0.1 and 0.9")

# %% tags=["hide-input"]
assert several[1].entropy.sum() < 0.8 * several[0].entropy.sum()
figure, axes = panels("one pose", "entropy", "five poses", "entropy")
for at, poses, inferred in ((0, stops[:1], several[0]), (2, stops, several[1])):
    viz.plot_probability(axes[at], grid, inferred.occupancy)
    viz.plot_truth_outline(axes[at], grid, true_walls)
    for stop in poses:
        viz.plot_sensor(axes[at], stop)
    viz.plot_entropy(axes[at + 1], grid, inferred.occupancy)
show(figure, "poses.png", "The posterior and its entropy after a scan from one place, and after scans from five.")

# %% [markdown]
# ## A building
#
# A robot's log has thousands of beams, and its map has cells of 10 cm. Some readings fit no wall, because people walk
# by and glass lets beams through. `bm.read_log` reads such a log. Here we simulate a robot's round through an office,
# so that we can compare the map with the truth. The sensor model is a mixture that allows outliers
# ([defaults.md](../defaults.md)). The chains start from belief propagation. Every tenth scan is held out, and we score
# how well the posterior predicts these scans.

# %%
office = bm.worlds.building(seed=3, size_m=(14.0, 9.0), resolution=0.1)
route = bm.worlds.patrol(office, 60, seed=1)
laser = default_sensor(office.grid.resolution)
log = bm.simulate(
    office.walls, office.grid, route, np.deg2rad(np.arange(-90, 90)), sensor=laser, max_range_m=10.0, seed=0,
    opacity=office.opacity,
)  # fmt: skip
used, held_out = log.holdout(10)
office_problem = {"scans": used, "grid": office.grid, "prior": bm.Independent(0.2), "sensor": laser}
mapped = bm.infer(**office_problem, schedule=bm.Schedule(chains=4, warmup=200, draws=200))
guess = bm.infer(**office_problem, method="propagate", schedule=bm.Schedule(chains=1, draws=100))
nothing = bm.infer(**office_problem, method=bm.Gibbs(start="prior"), schedule=bm.Schedule(chains=1, warmup=0, draws=1))
print(f"{len(used)} scans, {used.n_beams} beams; {office.grid.shape[0]} x {office.grid.shape[1]} cells")
summary = mapped.summary()
print(f"the mean map is known to {summary.map_error:.2f} in 99 of 100 observed cells;")
print(f"  R-hat is over 1.05 in {summary.rhat_high_cells} cells, {summary.rhat_max:.2f} at most")
print(f"held-out beams, nats each: {mapped.log_score(held_out):.3f} by chains,")
print(
    f"  {guess.log_score(held_out):.3f} by beliefs, {nothing.log_score(held_out):.3f} by a chain after a single sweep"
)
seconds = [some.posterior.seconds["sampling"] for some in (mapped, guess)]
print(f"time: {seconds[0]:.2f} s in sweeps, {seconds[1]:.2f} s in beliefs")
certain = (mapped.entropy < 0.1)[mapped.observed].mean()
print(f"of the observed cells {certain:.1%} are certain to 0.1 bits")
walls_seen, free_seen = mapped.observed & office.walls, mapped.observed & ~office.walls
print(f"their mean probability of a wall: {mapped.occupancy[walls_seen].mean():.2f} where there is one,")
print(f"  {mapped.occupancy[free_seen].mean():.3f} where there is none")

# %% tags=["hide-input"]
assert mapped.log_score(held_out) > nothing.log_score(held_out)
assert mapped.log_score(held_out) > guess.log_score(held_out) - 0.05
assert mapped.occupancy[walls_seen].mean() > 0.7
assert mapped.occupancy[free_seen].mean() < 0.02
figure, axes = panels("probability of a wall", "entropy", size_in=4.4, height_in=3.2)
viz.plot_probability(axes[0], office.grid, mapped.occupancy, mapped.observed)
viz.plot_truth_outline(axes[0], office.grid, office.walls)
viz.plot_sensor(axes[0], route)
viz.plot_entropy(axes[1], office.grid, mapped.occupancy, mapped.observed)
show(figure, "building.png", "An office, with the robot's way. Outlined: the true walls. Hatched: no beam came there.")

# %% [markdown]
# The uncertain cells lie at the edge of the observed area. After 400 sweeps the mean map is known to 0.03. In some
# single cells the chains still disagree, and the summary counts these cells. For this map belief propagation predicts
# the held-out beams about as well as the chains do, in a fraction of the time.
#
# ## Exercises
#
# **1.** Two chains of a thousand normal draws have standard deviation 1, and means that differ by d. Compute R-hat for
# d = 0, 0.5, 1 and 2. From which of these differences on would you not trust the chains?

# %% Answer 1 tags=["hide-cell"]
noise = np.random.default_rng(0).normal(size=(2, 1_000))
by_difference = {d: rhat(noise + np.array([[0.0], [d]])) for d in (0.0, 0.5, 1.0, 2.0)}
for d, value in by_difference.items():
    print(f"means that differ by {d}: R-hat {value:.3f}")
print("At 0.5 standard deviations R-hat is just under 1.05; at 1 the chains have clearly not converged.")
assert by_difference[0.0] < 1.01 < by_difference[0.5] < 1.05 < 1.1 < by_difference[1.0] < by_difference[2.0]

# %% [markdown]
# **2.** A wall stands in one of two cells, and both are equally probable. Give the marginals of the two cells. If maps
# are drawn cell by cell from the marginals, which share of the maps has exactly one wall?

# %% Answer 2 tags=["hide-cell"]
by_cell = np.random.default_rng(1).random((10_000, 2)) < 0.5
print(f"each marginal is 0.5; {(by_cell.sum(axis=1) == 1).mean():.2f} of the maps have exactly one wall")
assert abs((by_cell.sum(axis=1) == 1).mean() - 0.5) < 0.03

# %% [markdown]
# **3.** We called a cell certain if its entropy is below 0.1 bits. Which probabilities of a wall does this mean?

# %% Answer 3 tags=["hide-cell"]
p = np.linspace(1e-4, 0.5, 5_000)
bits = -p * np.log2(p) - (1 - p) * np.log2(1 - p)
limit = p[bits < 0.1].max()
print(f"below {limit:.3f}, or above {1 - limit:.3f}")
assert np.isclose(limit, 0.013, atol=5e-4)

# %% [markdown]
# ## Where to go from here
#
# - [Where is the robot?](localization.md) The map is known, and the pose is not.
# - [Neither is known](both.md): poses and walls together.
# - Your own log: `bayesmap infer my.log.gz -o runs/mine`; the [README](../../README.md) has the commands.
# - Your own sensor, prior or sampler: [CONTRIBUTING.md](../../CONTRIBUTING.md).
# - How the kernels avoid most of the work: [inference.md](../inference.md) and [beam-table.md](../beam-table.md).
# - `bayesmap.gen` for models of your own: [coming-from-genjax.md](../coming-from-genjax.md).
