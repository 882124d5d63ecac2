# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # Where is the robot?
#
# On the pages before, the robot knew its place and did not know the walls. Here the robot knows the walls and does not
# know its place. The robot wakes up somewhere in the room, and measures a few distances. Where is the robot, and in
# which direction does it look? This question is called *localization*.
#
# The unknown is now a *pose*: x, y and the heading, three numbers instead of 441 cells. So the simplest method,
# importance sampling, works if we choose well from where we draw. Then the robot drives, and we follow its pose with a
# particle filter. In the end we infer the whole way from all readings.
#
# **After this page you will be able to**
#
# - find a pose by importance sampling with a proposal, and compare proposals by their effective sample size;
# - follow a moving robot with a particle filter: move, weigh, resample, rejuvenate;
# - draw whole trajectories, given all readings, backwards through the particles;
# - check such trajectories with Metropolis-Hastings on one trace.
#
# Reading time: about 30 minutes, without the exercises.
#
# The programs use `bayesmap.gen` as introduced on the [first page](mapping.md). Code that only draws a figure or checks
# what the text says is folded away.

# %%
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
# ## The map and the sensor
#
# The map is that of the first page, and now this map is known. So only the 54 wall cells matter: the range of a beam is
# the distance to the first of these cells. The formula for one cell is that of the first page. The beams turn with the
# robot: an angle of zero is straight ahead.
#
# The noise of the sensor is 0.2 m, as before. But the sensor has only six beams, 60 degrees apart. So more than one
# pose explains a scan.

# %%
SIGMA_M, N_BEAMS, MAX_RANGE_M = 0.2, 6, 42.0
true_walls, _ = bm.worlds.tutorial()
grid = bm.Grid(shape=(21, 21), resolution=1.0, origin=(-0.5, -0.5))
wall_centres = jnp.argwhere(jnp.asarray(true_walls)).astype(float)  # (54, 2)
ANGLES = jnp.arange(N_BEAMS) / N_BEAMS * 2 * jnp.pi


def exact_range(pose, angle_rad):
    """The distance in metres from a pose (x, y, heading) to the first wall along a beam."""
    direction = jnp.stack([jnp.cos(pose[2] + angle_rad), jnp.sin(pose[2] + angle_rad)])
    one, other = (wall_centres - 0.5 - pose[:2]) / direction, (wall_centres + 0.5 - pose[:2]) / direction
    enter, leave = jnp.minimum(one, other).max(axis=-1), jnp.maximum(one, other).min(axis=-1)
    ahead = jnp.where(enter >= 0, enter, leave)  # from inside a wall, its far side
    return jnp.minimum(jnp.where((enter <= leave) & (leave >= 0), ahead, jnp.inf).min(), MAX_RANGE_M)


@gen.gen
def beam(pose, angle_rad):
    """One noisy reading."""
    return gen.normal(exact_range(pose, angle_rad), SIGMA_M) @ ()


scan = beam.vmap(in_axes=(None, 0))

# %% A check against the library's ray casting tags=["hide-input"]
somewhere = np.array([7.3, 8.1, 0.4])
ours = jax.vmap(exact_range, in_axes=(None, 0))(jnp.asarray(somewhere), ANGLES)
theirs = bm.ranges(true_walls, grid, somewhere, np.asarray(ANGLES), max_range_m=MAX_RANGE_M)
assert np.allclose(ours, theirs, atol=1e-3)

# %% [markdown]
# ## The model
#
# The prior of the pose is uniform: every place on the map and every heading is equally probable. The readings are a
# scan from this pose.

# %%
LOW, HIGH = jnp.array([-0.5, -0.5, -jnp.pi]), jnp.array([20.5, 20.5, jnp.pi])


@gen.gen
def pose_prior():
    """A pose (x, y, heading), in metres and radians, anywhere on the map."""
    return gen.uniform.vmap()(LOW, HIGH) @ ()


@gen.gen
def model():
    """A pose, and a scan from there."""
    pose = pose_prior() @ "pose"
    readings = scan(pose, ANGLES) @ "readings"
    return pose, readings


true_pose = jnp.array([8.0, 14.0, 2.0])
readings = scan.simulate(jrand.key(0), (true_pose, ANGLES)).get_retval()
print(f"the robot is at x = {true_pose[0]:.1f} m, y = {true_pose[1]:.1f} m, heading {true_pose[2]:.1f} rad")
print("its readings in metres:", np.round(np.asarray(readings), 1))

# %% Code of the figure tags=["hide-input"]


def draw_poses(ax, poses, color=CHAINS[0], size=1.5):
    """Poses (n, 3) as points."""
    ax.plot(poses[:, 0], poses[:, 1], ".", color=color, markersize=size, alpha=0.5, zorder=4)


def on_the_map(*titles, size_in=3.1):
    """Panels that show the map."""
    figure, axes = panels(*titles, size_in=size_in)
    for ax in axes:
        viz.plot_sample(ax, grid, true_walls)
        ax.set(xlim=(-0.5, 20.5), ylim=(-0.5, 20.5))
    return figure, axes


figure, (left, right) = on_the_map("the robot and its scan", "what it knows", size_in=3.4)
seen = {"angles_rad": np.asarray(ANGLES), "ranges_m": np.asarray(readings)[None], "max_range_m": MAX_RANGE_M}
viz.plot_rays(left, bm.Scans(poses=np.asarray(true_pose), **seen))
viz.plot_sensor(left, np.asarray(true_pose))
words = [f"at {60 * k} degrees: {r:.1f} m" for k, r in enumerate(readings)]
right.text(7, 9, "\n".join(words), ha="center", va="center", color=TRUTH, fontsize=8)
show(figure, "pose-scan.png", "A scan of six beams, and what the robot has: the map and six numbers.")

# %% [markdown]
# ## Importance sampling from the prior
#
# As on the first page: draw poses from the prior and weigh each by p(readings | pose).

# %%
N_PRIOR = 100_000
observed = C["readings"].set(readings)
log_weights = jax.jit(jax.vmap(lambda key: model.importance(key, observed, ())[1]))(jrand.split(jrand.key(1), N_PRIOR))


def effective_sample_size(log_weights):
    """How many equally weighted samples these are worth."""
    return float(1 / jnp.sum(jax.nn.softmax(log_weights) ** 2))


print(f"{N_PRIOR} poses from the prior: effective sample size {effective_sample_size(log_weights):.1f}")

# %% [markdown]
# On the first page a million maps had an effective sample size of one. Here a hundred thousand poses have little more,
# because the readings rule out nearly all of them. But a pose is three numbers, and three numbers can be searched.
#
# ## A grid of poses
#
# We lay a grid over all poses, with squares of 0.25 m and headings 5 degrees apart. For each cell of the grid, we fix
# the pose to the cell's centre. Then `importance` has nothing to draw, and its log weight is the log joint of the pose
# and the readings.

# %%
SIDE = jnp.array([0.25, 0.25, 2 * jnp.pi / 72])
along = [LOW[k] + SIDE[k] * (jnp.arange(n) + 0.5) for k, n in enumerate((84, 84, 72))]
centres = jnp.stack(jnp.meshgrid(*along, indexing="ij"), axis=-1).reshape(-1, 3)


@jax.jit
@jax.vmap
def log_joint(pose):
    """Log p(pose, readings), for many poses."""
    return model.importance(jrand.key(0), observed | C["pose"].set(pose), ())[1]


on_grid = log_joint(centres)
best = centres[on_grid.argmax()]
print(f"{len(centres)} poses on a grid: effective sample size {effective_sample_size(on_grid):.1f}")
print(f"the best is at {best[0]:.2f} m, {best[1]:.2f} m, {best[2]:.2f} rad")

# %% [markdown]
# A few of these half a million poses have most of the weight: even this grid is coarse. The centre of a cell may
# explain the readings badly, although other poses in the cell explain them well.
#
# So the grid only tells us where to draw from. First we draw a cell. Its probability is a mixture: 90 % of a flattened
# posterior of the centres, and 10 % of the uniform distribution over all cells. Then we draw a pose uniformly in this
# cell. The log weight of the pose is its log joint minus the log density with which the pose was drawn. This is
# importance sampling with a *proposal*. The result is right for a coarse grid, too, since every pose can be proposed.

# %%


def proposed(key, n):
    """Poses from the proposal (n, 3), and their log weights (n,)."""
    cell_key, pose_key = jrand.split(key)
    p_cell = 0.9 * jax.nn.softmax(on_grid / 8) + 0.1 / len(centres)
    cells = jrand.choice(cell_key, len(centres), (n,), p=p_cell)
    poses = centres[cells] + SIDE * jrand.uniform(pose_key, (n, 3), minval=-0.5, maxval=0.5)
    return poses, log_joint(poses) - jnp.log(p_cell[cells] / jnp.prod(SIDE))


poses, weights = proposed(jrand.key(2), 40_000)
print(f"{len(poses)} poses from the proposal: effective sample size {effective_sample_size(weights):.0f}")
evidence = [jax.scipy.special.logsumexp(w) - jnp.log(len(w)) for w in (weights, proposed(jrand.key(20), 40_000)[1])]
print(f"log p(readings), from the mean weight: {evidence[0]:.2f}, and {evidence[1]:.2f} with other random numbers")

# %% [markdown]
# We drew fewer than half as many poses as from the prior. But their effective sample size is more than a thousand times
# as large. Poses that are resampled by weight are draws from the posterior:

# %%
N = 2_000
first_poses = poses[jrand.categorical(jrand.key(3), weights, shape=(N,))]


def near(poses, place):
    """Which poses are within 1.5 m of a place and look in its direction to half a radian."""
    turned = jnp.abs((poses[..., 2] - place[2] + jnp.pi) % (2 * jnp.pi) - jnp.pi)
    return (jnp.hypot(*jnp.moveaxis(poses[..., :2] - place[:2], -1, 0)) < 1.5) & (turned < 0.5)


share_right = float(near(first_poses, true_pose).mean())
other = first_poses[~near(first_poses, true_pose)].mean(axis=0)
share_other = float(near(first_poses, other).mean())
print(f"poses near the true one: {share_right:.0%}")
print(f"near another place, {other[0]:.1f} m, {other[1]:.1f} m, {other[2]:.1f} rad: {share_other:.0%}")

# %% tags=["hide-input"]
assert effective_sample_size(weights) > 1000 * effective_sample_size(log_weights)
assert effective_sample_size(on_grid) < 100
assert abs(evidence[0] - evidence[1]) < 0.2
assert share_right > 0.2
assert share_other > 0.2
assert share_right + share_other > 0.95
figure, axes = on_the_map("grid: probability of each place", "weighted poses, resampled", size_in=3.4)
by_place = np.asarray(jax.nn.softmax(on_grid).reshape(84, 84, 72).sum(axis=-1))
axes[0].imshow(
    np.ma.masked_less(by_place, 1e-4).T,
    origin="lower",
    extent=(-0.5, 20.5, -0.5, 20.5),
    cmap="Blues",
    vmin=-0.02,
    vmax=0.02,
    zorder=4,
)
draw_poses(axes[1], first_poses)
for ax in axes:
    viz.plot_sensor(ax, np.asarray(true_pose))
show(figure, "pose-posterior.png", "Where the robot may be after one scan. The arrow is where it is.")

# %% [markdown]
# Two places explain the scan, and the posterior shows both. The wrong place even explains the scan a little better, so
# a method that returns a single best pose would be wrong here.
#
# ## The robot moves
#
# Now the robot turns on the spot, and then drives along a bend. The robot knows the commands that it gave its wheels, a
# distance and a turn. But the wheels slip: the new pose is normally distributed around the commanded pose. After each
# move the robot measures again. The generative function `step` takes a pose and a command, and returns the new pose.
# `step.scan()` repeats the step: each step begins at the pose at which the step before ended.

# %%
N_STEPS, SLIP = 15, jnp.array([0.1, 0.1, 0.05])
commands = jnp.tile(jnp.array([0.8, 0.25]), (N_STEPS, 1))  # metres ahead, then radians to the left
commands = commands.at[0].set(jnp.array([0.0, 1.5]))


def driven(pose, command):
    """The pose after a command, without slip."""
    ahead = command[0] * jnp.stack([jnp.cos(pose[2]), jnp.sin(pose[2])])
    return jnp.concatenate([pose[:2] + ahead, pose[2:] + command[1]])


@gen.gen
def step(pose, command):
    """A move, and a scan at its end."""
    pose = gen.mv_normal_diag(driven(pose, command), SLIP) @ "pose"
    readings = scan(pose, ANGLES) @ "readings"
    return pose, (pose, readings)


journey = step.scan()
_, (true_path, path_readings) = journey.simulate(jrand.key(4), (true_pose, commands)).get_retval()
_, dead_reckoning = jax.lax.scan(lambda pose, command: (driven(pose, command),) * 2, true_pose, commands)


def distance_m(path):
    """Distance from the true places, (..., steps)."""
    return jnp.linalg.norm(path[..., :2] - true_path[:, :2], axis=-1)


print(f"had it known where it began, its commands alone would put it {distance_m(dead_reckoning)[-1]:.2f} m off")

# %% [markdown]
# ## A particle filter
#
# A particle filter keeps two thousand poses, the *particles*. At first they are the draws from the posterior after the
# first scan. Each step has three parts:
#
# 1. *Move and weigh*: `importance` of `step` draws a new pose for each particle, and weighs the pose by how well it
#    explains the new readings.
# 2. *Resample*: draw particles by weight. Good particles are copied, and bad ones are dropped.
# 3. *Rejuvenate*: two equal particles are worth no more than one, so each particle moves a little. Metropolis-Hastings
#    proposes a pose nearby, and accepts it with a probability chosen so that draws of the posterior stay draws of it.
#    `Rejuvenate` makes the proposal, and `metropolis_hastings` accepts or rejects the edited trace.

# %%


@gen.gen
def nearby(pose):
    """A pose close to another."""
    return gen.mv_normal_diag(pose, jnp.array([0.05, 0.05, 0.02])) @ "pose"


wander = gen.metropolis_hastings(gen.Rejuvenate(nearby, lambda choices: (choices["pose"],)))


def particle_filter(key, poses, moves=3):
    """Particles after each step, (steps, n, 3), and how many of them are distinct, (steps,)."""

    def one_step(poses, now):
        key, command, readings = now
        keys = jrand.split(key, (3, len(poses)))

        def move_and_weigh(key, pose):
            return step.importance(key, C["readings"].set(readings), (pose, command))

        def rejuvenate(key, trace):
            return gen.run_chain(key, trace, wander, moves, collect=lambda trace: ()).last

        particles = gen.ParticleCollection(*jax.vmap(move_and_weigh)(keys[0], poses))
        traces = particles.resample(keys[1, 0]).get_particles()
        if moves:
            traces = jax.vmap(rejuvenate)(keys[2], traces)
        poses = traces.get_retval()[0]
        distinct = 1 + (jnp.diff(jnp.sort(poses[:, 0])) > 0).sum()
        return poses, (poses, distinct)

    return jax.lax.scan(one_step, poses, (jrand.split(key, N_STEPS), commands, path_readings))[1]


run_filter = jax.jit(particle_filter, static_argnames="moves")
filtered, _ = run_filter(jrand.key(5), first_poses)
for t in (0, 4, N_STEPS - 1):
    right = float(near(filtered[t], true_path[t]).mean())
    off = float(distance_m(filtered.mean(axis=1))[t])
    print(f"after step {t + 1:2d}: {right:6.1%} of the particles near the true pose; their mean is {off:.2f} m off")

# %% tags=["hide-input"]
assert near(filtered[-1], true_path[-1]).mean() > 0.99
assert distance_m(filtered.mean(axis=1))[-1] < 0.25
figure, axes = on_the_map("before it moves", *(f"after step {t}" for t in (1, 5, N_STEPS)))
for ax, t in zip(axes, (0, 1, 5, N_STEPS), strict=True):
    draw_poses(ax, filtered[t - 1] if t else first_poses)
    way = np.concatenate([true_pose[None], true_path[:t]])
    ax.plot(*way[:, :2].T, color=TRUTH, linewidth=1)
    viz.plot_sensor(ax, way[-1])
show(
    figure,
    "filter.png",
    "The particles after some steps. Line and arrow: the way that the robot took, and where it is.",
)

# %% [markdown]
# One step rules out the wrong place: the readings after the step do not fit there.
#
# How much does rejuvenation help? With two thousand particles the results hardly change; with few particles they do. We
# run the filter a hundred times with ten particles, with and without rejuvenation.

# %%
off_m = {}
for name, moves in (("without rejuvenation", 0), ("with rejuvenation", 10)):
    few = jax.vmap(lambda key, moves=moves: run_filter(key, jrand.choice(key, first_poses, (10,)), moves=moves))
    paths, distinct = few(jrand.split(jrand.key(6), 100))
    off_m[name] = np.asarray(distance_m(paths.mean(axis=2)))
    lost = (off_m[name][:, -1] > 0.5).sum()
    print(f"{name}: {distinct.mean():.1f} distinct particles of 10 on average;")
    print(f"  the mean pose is {off_m[name][:, 5:].mean():.2f} m off on average, and {lost} of 100 runs lose the robot")

# %% tags=["hide-input"]
late = {name: off[:, 5:].mean() for name, off in off_m.items()}
assert late["with rejuvenation"] < 0.9 * late["without rejuvenation"]

# %% [markdown]
# ## Looking back: the whole trajectory
#
# A filter says where the robot is now, given the readings so far. But later readings also say something about earlier
# poses. So after the drive we want the *smoothed* trajectory, p(all poses | all readings).
#
# Trajectories are drawn backwards, from the last step to the first (Godsill, Doucet and West 2004). Suppose that the
# pose at step t + 1 has been drawn. The weight of a particle of step t is then the density of the move from this
# particle to the drawn pose. One particle is drawn by weight. No later reading is needed: given the pose at step
# t + 1, later readings say nothing more about step t. The density of a move is that of the choice `"pose"` of `step`.

# %%
move = gen.mv_normal_diag


def backwards(key, filtered):
    """A trajectory from the smoothed posterior, the first pose included, (steps + 1, 3)."""

    def one_step(later, now):
        key, poses, command = now

        def log_density(pose):
            return move.assess(C.v(later), (driven(pose, command), SLIP))[0]

        pose = poses[jrand.categorical(key, jax.vmap(log_density)(poses))]
        return pose, pose

    last_key, key = jrand.split(key)
    last = jrand.choice(last_key, filtered[-1])
    before = jnp.concatenate([first_poses[None], filtered[:-1]])
    _, path = jax.lax.scan(one_step, last, (jrand.split(key, N_STEPS), before, commands), reverse=True)
    return jnp.concatenate([path, last[None]])


smoothed = jax.jit(jax.vmap(backwards, in_axes=(0, None)))(jrand.split(jrand.key(7), 500), filtered)
print(f"the first pose is near the true one: {share_right:.0%} by its own scan,")
print(f"  {near(smoothed[:, 0], true_pose).mean():.0%} by all scans")
spread = {"filtered": filtered[..., :2].std(axis=1), "smoothed": smoothed[:, 1:, :2].std(axis=0)}
for name, mean in (("filtered", filtered.mean(axis=1)), ("smoothed", smoothed[:, 1:].mean(axis=0))):
    error = jnp.sqrt((distance_m(mean)[3:-1] ** 2).mean())
    claimed = jnp.sqrt((spread[name][3:-1] ** 2).sum(axis=-1).mean())
    print(f"{name}: {error:.3f} m off from step 4 on (root mean square); its own spread says {claimed:.3f} m")

# %% [markdown]
# The first scan alone could not tell the two places apart. All scans together leave no doubt.
#
# ## The same by editing one trace
#
# Is the smoothed trajectory right? We check the trajectory with a quite different method. A trace of `journey` holds
# the whole trajectory with all readings. Metropolis-Hastings on this trace changes one pose at a time. `IndexRequest(t,
# ...)` edits step t. Such an edit recomputes only the readings at t, the move to t and the move from t. The first pose
# is an argument of `journey` and not a choice. So the program `whole_drive` draws the first pose, too.

# %%


@gen.gen
def whole_drive(commands):
    """A first pose and scan, and the drive from there."""
    start = pose_prior() @ "start"
    scan(start, ANGLES) @ "first readings"
    return journey(start, commands) @ "steps"


@gen.gen
def near_start(pose):
    """A first pose close to another."""
    return gen.mv_normal_diag(pose, jnp.array([0.05, 0.05, 0.02])) @ "start"


def sweep(key, trace):
    """Propose to change each pose once."""
    keys = jrand.split(key, N_STEPS + 1)

    def change(t, trace):
        pose = gen.Rejuvenate(nearby, lambda choices: (choices["pose"],))
        request = gen.StaticRequest({"steps": gen.IndexRequest(t, pose)})
        return gen.metropolis_hastings(request)(keys[t], trace)[0]

    trace = jax.lax.fori_loop(0, N_STEPS, change, trace)
    start = gen.Rejuvenate(near_start, lambda choices: (choices["start"],))
    trace, _ = gen.metropolis_hastings(start)(keys[-1], trace)
    return trace, True


@jax.jit
@jax.vmap
def chain(key, path):
    """Trajectories (draws, steps + 1, 3) from a chain that begins at one."""
    known = C["first readings"].set(readings) | C["steps", "readings"].set(path_readings)
    begin = C["start"].set(path[0]) | C["steps", "pose"].set(path[1:])
    trace, _ = whole_drive.importance(key, known | begin, (commands,))

    def collect(trace):
        choices = trace.get_choices()
        return jnp.concatenate([choices["start"][None], choices["steps", "pose"]])

    return gen.run_chain(key, trace, sweep, 400, collect).draws


begin = jnp.concatenate([true_pose[None], true_path])
begin += 0.2 * jrand.normal(jrand.key(8), (8, *begin.shape)) * jnp.array([1.0, 1.0, 0.3])
by_edits = chain(jrand.split(jrand.key(9), 8), begin)[:, 100:]
apart = jnp.linalg.norm(by_edits.mean(axis=(0, 1))[:, :2] - smoothed.mean(axis=0)[:, :2], axis=-1)
print(f"mean places by particles and by edits are {apart.mean():.3f} m apart on average, {apart.max():.3f} m at most")
spreads = smoothed[..., :2].std(axis=0).mean(), by_edits[..., :2].std(axis=(0, 1)).mean()
print(f"their spreads along one axis: {spreads[0]:.3f} m and {spreads[1]:.3f} m")

# %% tags=["hide-input"]
assert near(smoothed[:, 0], true_pose).mean() > 0.99
assert apart.max() < 0.08
assert abs(spreads[0] - spreads[1]) < 0.015
assert (spread["smoothed"][:-1] ** 2).sum() < 0.9 * (spread["filtered"][:-1] ** 2).sum()
figure, axes = on_the_map("filtered: step by step", "smoothed: 40 trajectories", size_in=4.0)
for t in range(N_STEPS):
    draw_poses(axes[0], filtered[t, ::10], size=1)
for path in smoothed[:40]:
    axes[1].plot(*path[:, :2].T, color=CHAINS[0], linewidth=0.5, alpha=0.5)
for ax in axes:
    ax.plot(*np.concatenate([true_pose[None], true_path])[:, :2].T, color=TRUTH, linewidth=1.2, label="true")
    ax.plot(*dead_reckoning[:, :2].T, color=SENSOR, linewidth=1, linestyle="--", label="commands alone")
    ax.set(xlim=(2, 12), ylim=(5.5, 15.5))
axes[1].legend(fontsize=8, loc="lower left")
show(figure, "smoothed.png", "Poses by the readings up to each step, and trajectories by all readings.")

# %% [markdown]
# Particles drawn backwards and Metropolis-Hastings on one trace share only the model, and they agree to a few
# centimetres. But the chains began near the truth. A chain that begins at the other place would stay there for a long
# time: a change of one pose cannot move the whole trajectory across the room. The particle filter needed no such start
# to find the right place.
#
# ## Exercises
#
# **1.** The six beams are 60 degrees apart. If the robot turns by 60 degrees on the spot, its readings are the same six
# numbers. Why does the scan tell the robot its heading nevertheless?

# %% Answer 1 tags=["hide-cell"]
before, after = (
    bm.ranges(true_walls, grid, np.array([8.0, 14.0, yaw]), np.asarray(ANGLES), max_range_m=MAX_RANGE_M)
    for yaw in (2.0, 2.0 + np.pi / 3)
)
print("before the turn:", np.round(before, 1))
print("after the turn: ", np.round(after, 1))
print("The numbers are the same, but each comes from another beam, and the robot knows which beam gave which reading.")
assert np.allclose(after, np.roll(before, -1), atol=1e-3)
assert not np.allclose(after, before, atol=1.0)

# %% [markdown]
# **2.** A hundred thousand poses from the prior had an effective sample size of about 1.4, in three dimensions. Suppose
# that each further dimension divides the effective sample size by the same factor as each of these three. How many
# draws from the prior does a problem with six dimensions need for an effective sample size of 100?

# %% Answer 2 tags=["hide-cell"]
factor = (N_PRIOR / 1.4) ** (1 / 3)
needed = 100 * factor**6
print(f"each dimension divides by about {factor:.0f}: six dimensions need {needed:.0e} draws")
assert 35 < factor < 50
assert 1e11 < needed < 1e12

# %% [markdown]
# **3.** One of ten particles has the weight 0.1. With what probability does resampling drop this particle? And how
# many of ten equally weighted particles are still there, on average, after one resampling?

# %% Answer 3 tags=["hide-cell"]
dropped = 0.9**10
kept = np.mean([len(set(row)) for row in np.random.default_rng(0).integers(10, size=(2_000, 10))])
print(f"dropped with probability 0.9^10 = {dropped:.2f}; {10 * (1 - dropped):.1f} of ten stay, {kept:.1f} in a trial")
assert abs(kept - 10 * (1 - dropped)) < 0.1

# %% [markdown]
# Next: [neither is known](both.md), poses and walls in one model.
