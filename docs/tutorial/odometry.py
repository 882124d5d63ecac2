# ---
# jupyter:
#   jupytext:
#     formats: py:percent
# ---
# ruff: noqa: D100

# %% [markdown]
# # A building, from odometry to map
#
# On the page before, poses and walls were inferred together from eight scans. Here a robot drives through a whole floor
# with its wheels and its laser. From the log of both we infer the trajectory with its uncertainty, and the map. Then we
# find in this map the places at which other scans were taken.
#
# The programs of this page are compiled. [poses.md](../poses.md) and [localization.md](../localization.md) describe
# their methods. Code that only draws a figure or checks what the text says is folded away.
#
# **After this page you will be able to**
#
# - infer a trajectory and a map from raw odometry and scans, with one call;
# - check whether the covariances of the poses fit their errors;
# - find the pose of the robot that you can trust least;
# - find where a single scan was taken, and follow a robot through a known map.
#
# Reading time: about 15 minutes, without the exercises.

# %%
import numpy as np
from drawing import panels, show

import bayesmap as bm
from bayesmap import viz
from bayesmap.sim.building import building
from bayesmap.sim.robot import patrol
from bayesmap.space.planar import between, compose, wrap_angle
from bayesmap.viz.trajectory import INFERRED_COLOR, ODOMETRY_COLOR, plot_ellipses

# %% [markdown]
# ## The robot's log
#
# We simulate an office, and a robot's round through its rooms. The laser has 180 beams over half a circle, and noise of
# one centimetre. The wheels have the errors of a real robot's wheels: reported distances are 3.5 % too long, each metre
# straight ahead turns the reported heading by three degrees, and both have noise.

# %%
office = building(3, (16.0, 11.0))
true_poses = patrol(office, 260, 3)
angles_rad = np.radians(np.linspace(-90, 90, 180))
laser = {"sensor": bm.BeamMixture(bm.Gaussian(0.01), p_random=0.002), "max_range_m": 12.0}
seen = bm.simulate(office.walls, office.grid, true_poses, angles_rad, seed=1, typed=True, **laser)
raw_poses = bm.simulate_odometry(true_poses, bm.OdometryNoise(), seed=1)
log = seen.at(raw_poses)
way_m = np.hypot(*np.diff(true_poses[:, :2], axis=0).T).sum()
print(f"{len(log)} scans on a way of {way_m:.0f} m through {len(office.rooms)} rooms and corridors")


def in_frame_of_first(poses):
    """Return the poses in the frame of the first pose."""
    return between(poses[0], poses)


def off_m(poses, truth):
    """Return the distance of each pose from the truth, in metres, if both begin at the same pose."""
    return np.hypot(*(in_frame_of_first(poses) - in_frame_of_first(truth))[:, :2].T)


print(f"raw odometry is {off_m(raw_poses, true_poses)[-1]:.1f} m off in the end")

# %% tags=["hide-input"]
assert off_m(raw_poses, true_poses).max() > 1.5


def ends_of(scans, poses):
    """Where the readings of all scans end, seen from some poses, (N, 2)."""
    ranges_m = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, np.nan)
    x, y = ranges_m * np.cos(scans.angles_rad), ranges_m * np.sin(scans.angles_rad)
    turn = np.stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])], axis=-1)[:, None]
    found = np.stack([turn[..., 0] * x - turn[..., 1] * y, turn[..., 1] * x + turn[..., 0] * y], axis=-1)
    return (found + poses[:, None, :2])[np.isfinite(scans.ranges_m)]


def draw_path(ax, poses, color, label=None):
    """A way, and where it begins."""
    ax.plot(*poses[:, :2].T, color=color, linewidth=0.9, label=label)
    ax.plot(*poses[0, :2], "o", color=color, markersize=4)
    ax.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")


def on_the_building(ax):
    """Show what lies within the building, and half a metre around."""
    x_min, x_max, y_min, y_max = office.grid.extent_m
    ax.set(xlim=(x_min, x_max), ylim=(y_min, y_max))


figure, axes = panels("the building and the robot's way", "as wheels and laser report it", size_in=4.6, height_in=3.8)
viz.plot_sample(axes[0], office.grid, office.walls)
draw_path(axes[0], true_poses, INFERRED_COLOR)
axes[1].plot(*ends_of(log, raw_poses).T, ",", color="#8a8a8a", zorder=1)
draw_path(axes[1], raw_poses, ODOMETRY_COLOR)
show(
    figure,
    "odometry-raw.png",
    "Left, what we want to know; right, what the robot has: readings drawn from where its wheels say that it was.",
)

# %% [markdown]
# ## The trajectory
#
# `bm.slam` takes the log as recorded. The trajectory comes first, in three steps. Each scan is matched to the scans
# before. Places that the robot came back to are recognised, and close loops. Then every scan is aligned with all other
# scans that see the same walls. Beside the poses, `bm.slam` estimates the errors of the wheels and the covariance of
# each pose. Then chains draw the map. With `fast=False` they draw the poses, too, from the joint posterior of poses and
# map.

# %%
stages = []
run = bm.slam(
    log,
    resolution=0.1,
    fast=False,
    schedule=bm.Schedule(chains=2, warmup=5, draws=5),
    seed=1,
    on_progress=lambda event: stages.append(event.stage),
)
found = run.trajectory
print("stages:", ", ".join(dict.fromkeys(stages)))
print(
    f"{len(found.keys)} key scans, {(found.closures.weights > 0.5).sum()} loop closures, {found.flagged.sum()} flagged"
)
error_m = off_m(found.poses, true_poses)
print(f"the trajectory is {1e3 * np.sqrt((error_m**2).mean()):.0f} mm off, at most {1e3 * error_m.max():.0f} mm")
slope = found.calibration.odometry.slope
print(f"the wheels report a metre as {1 / (1 + slope[0, 0]):.3f} m")

# %% [markdown]
# Are the errors as large as the covariances say? Take the error of each pose in the frame of the first pose. Its
# squared Mahalanobis distance is the squared error, in units of the covariance. This number should be 3 on average,
# because a pose has three components.

# %%
covariances = found.covariances()
error = in_frame_of_first(found.poses) - in_frame_of_first(true_poses)
error[:, 2] = wrap_angle(error[:, 2])
widening = found.gaussian.dof / (found.gaussian.dof - 2)  # from the scale matrix of Student's t to its covariance
relative = widening * found.relative_scales(np.zeros(len(found), int), np.arange(len(found)))
squares = np.einsum("si,sij,sj->s", error[1:], np.linalg.inv(relative[1:]), error[1:])
print(f"squared errors by their covariance: {squares.mean():.1f} on average")
sigma_mm = 1e3 * np.sqrt(np.linalg.eigvalsh(covariances[:, :2, :2])[:, 1])
print(f"standard deviations: {np.median(sigma_mm):.1f} mm, at most {sigma_mm.max():.1f} mm")

# %% tags=["hide-input"]
assert error_m.max() < 0.05
assert 0.3 < squares.mean() < 6.0
figure, axes = panels("raw and inferred", "95 % regions, 20 times as large", size_in=4.6, height_in=3.8)
draw_path(axes[0], compose(found.poses[0], in_frame_of_first(raw_poses)), ODOMETRY_COLOR, "raw odometry")
draw_path(axes[0], found.poses, INFERRED_COLOR, "inferred")
axes[0].legend(fontsize=8, frameon=False)
viz.plot_probability(axes[1], run.grid, run.occupancy, run.observed)
draw_path(axes[1], found.poses, INFERRED_COLOR)
on_the_building(axes[1])
some = np.arange(0, len(found), 4)
plot_ellipses(axes[1], found.poses[some, :2], covariances[some, :2, :2], 20.0)
show(
    figure,
    "odometry-trajectory.png",
    "95 % regions of positions in the frame of the first pose: they grow along the way and shrink at known places.",
)

# %% [markdown]
# ## The map
#
# The value of a cell is the probability that the cell stops a beam. Glass, legs of chairs and edges of things stop some
# beams and let others pass, so their cells have values between 0 and 1. Cells that no beam reached are not observed.

# %%
print(f"map of {run.grid.shape[0]} x {run.grid.shape[1]} cells, {run.observed.mean():.0%} of them seen")
x, y = np.meshgrid(*run.grid.centers_m(), indexing="ij")
cell = np.floor(office.grid.to_cells(np.stack([x, y], axis=-1))).astype(int)
inside = ((cell >= 0) & (cell < office.grid.shape)).all(axis=-1)
wall = np.zeros(run.grid.shape, bool)
wall[inside] = office.walls[tuple(cell[inside].T)]
for name, where in (("walls", wall), ("free floor", ~wall)):
    values = run.occupancy[run.observed & where]
    print(
        f"{name}: stops {values.mean():.0%} of the beams on average; {(values > 0.5).mean():.0%} of the cells over half"
    )

# %% tags=["hide-input"]
assert (run.occupancy[run.observed & ~wall] > 0.5).mean() < 0.1
figure, axes = panels("chance that a cell stops a beam", "how far draws differ", size_in=4.6, height_in=3.8)
viz.plot_probability(axes[0], run.grid, run.occupancy, run.observed)
deviation = run.draws.reshape(-1, *run.grid.shape).std(axis=0)
viz.plot_deviation(axes[1], run.grid, deviation, run.observed)
for ax in axes:
    on_the_building(ax)
show(figure, "odometry-map.png", "The map, and the standard deviation of its draws: bright is uncertain.")

# %% [markdown]
# ## Where map and poses are uncertain
#
# Each draw of the posterior holds a whole map and the poses of its scans. The draws differ in cells that few scans have
# observed. The poses of the draws differ most where the way back to a known place is long.

# %%
worst = found.keys[int(np.argmax(sigma_mm[found.keys]))]
key = int(np.searchsorted(found.keys, worst))
drawn = run.poses[:, :, key].reshape(-1, 3)
print(
    f"least sure of all key scans is {worst}, at x = {found.poses[worst, 0]:.1f} m, y = {found.poses[worst, 1]:.1f} m"
)
print(f"standard deviation there: {1e3 * drawn[:, :2].std(axis=0).max():.1f} mm in the chains' draws,")
print(f"  {sigma_mm[worst]:.1f} mm by the approximation that they started from")
assert 1.0 < 1e3 * drawn[:, :2].std(axis=0).max() < 20.0

# %% tags=["hide-input"]
figure, axes = panels("around the least sure pose", "its draws", size_in=4.2, height_in=3.8)
viz.plot_deviation(axes[0], run.grid, deviation, run.observed)
axes[0].plot(*true_poses[:, :2].T, color=INFERRED_COLOR, linewidth=0.7)
axes[0].plot(*found.poses[worst, :2], "s", color=ODOMETRY_COLOR, markersize=6, markerfacecolor="none")
axes[0].set(xlim=found.poses[worst, 0] + np.array([-3, 3]), ylim=found.poses[worst, 1] + np.array([-2.7, 2.7]))
for chain in range(2):
    axes[1].plot(
        *(1e3 * (run.poses[chain, :, key, :2] - true_poses[worst, :2])).T, "o", markersize=3, label=f"chain {chain}"
    )
axes[1].plot(0, 0, "+", color="black", markersize=12, label="truth")
axes[1].set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
axes[1].legend(fontsize=8, frameon=False)
show(
    figure,
    "odometry-uncertain.png",
    "Left, a part of the map above; right, where the draws put the pose in the square.",
)

# %% [markdown]
# Each chain started from a draw of the approximation, and stays near this draw. So the chains correct details only;
# [poses.md](../poses.md) says how much.
#
# ## Where am I?
#
# The next day the robot is switched on somewhere in the building, and takes one scan. The scan covers only 60 degrees,
# because something stands in front of the laser. `bm.localize` searches the whole map, and returns all places at which
# the scan may have been taken.

# %%
rng = np.random.default_rng(5)
somewhere = true_poses[rng.integers(len(true_poses), size=40)] + rng.normal(0, [0.15, 0.15, 1.0], (40, 3))
narrow_rad = angles_rad[np.abs(angles_rad) < np.radians(30)]
morning = bm.simulate(office.walls, office.grid, somewhere, narrow_rad, seed=7, typed=True, **laser)
known = bm.KnownMap.of_run(run)
alone = [bm.localize(known, morning.select([k])) for k in range(len(morning))]


def is_right(pose, truth):
    """Within half a metre and ten degrees."""
    error = between(truth, pose)
    return np.hypot(*error[:2]) < 0.5 and abs(wrap_angle(error[2])) < np.radians(10)


right = [is_right(where.mean, pose) for where, pose in zip(alone, somewhere, strict=True)]
said = [where.modes[0].probability for where in alone]
print(f"one scan: the likeliest place is right for {np.mean(right):.0%} of {len(right)} poses;")
print(f"  it says {np.mean(said):.0%} on average")
least = int(np.argmin(said))
print("the least sure of them has these places:")
for mode in alone[least].modes[:3]:
    x_m, y_m, yaw_rad = mode.mean
    print(f"  {mode.probability:.2f} at x = {x_m:.1f} m, y = {y_m:.1f} m, heading {yaw_rad:.1f} rad")

# %% [markdown]
# The stated probabilities are too high. So narrow a scan fits at many walls, and the search does not list about a third
# of the right places ([localization.md](../localization.md)).
#
# A few more scans, with the odometry between them, rule out the places that only look alike.

# %%
way = np.arange(100, 112)
drive = bm.simulate(office.walls, office.grid, true_poses[way], angles_rad, seed=9, typed=True, **laser)
drive = drive.at(bm.simulate_odometry(true_poses[way], bm.OdometryNoise(), seed=9))
tracked = bm.localize(known, drive)
off = [1e3 * np.hypot(*(belief.mean - pose)[:2]) for belief, pose in zip(tracked.beliefs, true_poses[way], strict=True)]
print("off by", ", ".join(f"{value:.0f}" for value in off), "mm")

# %% tags=["hide-input"]
assert np.mean(right) > 0.5
assert off[-1] < 100
figure, axes = panels("one scan", "twelve scans on the way", size_in=4.6, height_in=3.8)
for ax in axes:
    viz.plot_probability(ax, run.grid, run.occupancy, run.observed)
    on_the_building(ax)
for mode in alone[least].modes[:5]:
    turned = mode.mean[2]
    size = 4 + 14 * mode.probability
    axes[0].plot(*mode.mean[:2], "o", color=ODOMETRY_COLOR, markersize=size, markerfacecolor="none")
    axes[0].annotate(f"{mode.probability:.2f}", mode.mean[:2], (6, 6), textcoords="offset points", fontsize=8)
    axes[0].plot(*(mode.mean[:2, None] + np.outer([np.cos(turned), np.sin(turned)], [0, 0.7])), color=ODOMETRY_COLOR)
axes[0].plot(*somewhere[least, :2], "+", color=INFERRED_COLOR, markersize=12, markeredgewidth=2)
draw_path(axes[1], np.array([belief.mean for belief in tracked.beliefs]), INFERRED_COLOR)
plot_ellipses(
    axes[1],
    np.array([belief.mean[:2] for belief in tracked.beliefs]),
    np.array([belief.covariance[:2, :2] for belief in tracked.beliefs]),
)
axes[1].plot(*true_poses[way, :2].T, "+", color="black", markersize=6)
middle = true_poses[way, :2].mean(axis=0)
axes[1].set(xlim=middle[0] + np.array([-2, 2]), ylim=middle[1] + np.array([-1.6, 1.6]))
show(
    figure,
    "odometry-localized.png",
    "Left, places of the least sure scan with their probabilities; right, a way in 95 % regions. Crosses: the truth.",
)

# %% [markdown]
# ## With your own recording
#
# Two commands do these two steps in a shell. They also write pictures, and files for other programs:
#
#     bayesmap slam recording.bag -o runs/office
#     bayesmap localize runs/office/run.nc today.bag -o today.tum
#
# [poses.md](../poses.md) and [localization.md](../localization.md) give results on real recordings.
#
# ## Exercises
#
# **1.** A robot drives 5 m straight ahead, and its wheels have the errors of this page, without noise. How far from the
# true end is the end that the wheels report?

# %% Answer 1 tags=["hide-cell"]
ahead_m = np.linspace(0.0, 5.0, 1001)
heading_rad = np.radians(3.0) * ahead_m[:-1]
reported = 1.035 * np.diff(ahead_m) @ np.stack([np.cos(heading_rad), np.sin(heading_rad)], axis=-1)
print(f"the wheels report x = {reported[0]:.2f} m, y = {reported[1]:.2f} m instead of x = 5 m, y = 0 m")
print(f"{np.hypot(reported[0] - 5.0, reported[1]):.2f} m off: most of the error comes from the heading")
assert abs(reported[0] - 5.0) < 0.2 < 0.6 < reported[1] < 0.7

# %% [markdown]
# **2.** Suppose that all covariances are four times too small, so that each standard deviation is half as large as it
# should be. By how much does the average of the squared Mahalanobis distances change? Check your answer with the errors
# of this page.

# %% Answer 2 tags=["hide-cell"]
too_sure = np.einsum("si,sij,sj->s", error[1:], np.linalg.inv(relative[1:] / 4), error[1:])
print(
    f"the average is {too_sure.mean() / squares.mean():.0f} times as large; a right program would then give 12, not 3"
)
assert np.isclose(too_sure.mean(), 4 * squares.mean())

# %% [markdown]
# **3.** `bm.localize` stated a probability for the likeliest place of each narrow scan. How often is the place right if
# the stated probability is over 0.9, and how often if the probability is lower?

# %% Answer 3 tags=["hide-cell"]
sure = np.array(said) > 0.9
print(f"over 0.9: {np.array(right)[sure].mean():.0%} of {sure.sum()} places are right")
print(f"lower:    {np.array(right)[~sure].mean():.0%} of {(~sure).sum()} places are right")
assert np.array(right)[sure].mean() > np.array(right)[~sure].mean()
