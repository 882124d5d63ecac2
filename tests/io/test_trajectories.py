"""Trajectories, graphs and relations in the formats of other programs, and scans placed at the poses of one."""

import gzip
from types import SimpleNamespace

import numpy as np
import pytest
from oracle.trajectories import round_way
from recorded import READERS, scans
from scipy.spatial.transform import Rotation

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.io.exports import export_run, export_trajectory
from bayesmap.io.logs import describe_log, read_log
from bayesmap.io.text.g2o import Edges, chain_edges, slam_edges, write_g2o
from bayesmap.io.text.trajectories import read_trajectory, write_relations, write_trajectory
from bayesmap.poses.graph import Factors, Precision, normal_equations, quadratic, relative_covariances, solve_step
from bayesmap.space.planar import between, compose, inverse
from bayesmap.space.trajectory import RelativeLaw, Trajectory, ellipses

STAMPS = np.array([100.5, 101.25, 103.0])
POSES = np.array([[-1.4, 2.1, 0.0], [-1.0, 2.2, 0.5], [-0.5, 2.6, -3.0]])


def covariances():
    root = np.random.default_rng(0).normal(size=(3, 3, 3)) * 0.01
    return root @ np.swapaxes(root, 1, 2) + 1e-6 * np.eye(3)


def trajectory(**changed):
    return Trajectory(**{"poses": POSES, "stamps_s": STAMPS, "covariances": covariances(), **changed})


@pytest.mark.parametrize("ending", [".bag", ".mcap"])
def test_recordings_hold_the_path_and_poses_with_covariances(tmp_path, ending):
    path = tmp_path / f"walk{ending}"
    export_trajectory(path, trajectory(covariances=None))
    assert [f.topic for f in READERS[ending](path)] == ["/trajectory"]
    assert export_trajectory(path, trajectory()) == (path,)
    found = READERS[ending](path)
    assert [f.time_ns for f in found] == sorted(f.time_ns for f in found)
    (line,) = [f.message for f in found if f.topic == "/trajectory"]
    poses = [f for f in found if f.topic == "/pose"]
    assert {f.type_name.rpartition("/")[2] for f in poses} == {"PoseWithCovarianceStamped"}
    assert len(line.poses) == len(poses) == 3
    for i, one in enumerate(poses):
        assert (one.time_ns, one.message.header.frame_id) == (round(STAMPS[i] * 1e9), "map")
        for place in (line.poses[i].pose, one.message.pose.pose):
            assert (place.position.x, place.position.y) == tuple(POSES[i, :2])
            assert 2 * np.arctan2(place.orientation.z, place.orientation.w) == pytest.approx(POSES[i, 2])
        six = np.reshape(one.message.pose.covariance, (6, 6))
        np.testing.assert_allclose(six[np.ix_([0, 1, 5], [0, 1, 5])], covariances()[i])
        assert np.count_nonzero(six) == 9


def test_tum_comes_back_with_its_covariances_and_those_of_another_trajectory_are_refused(tmp_path):
    written = export_trajectory(tmp_path / "walk.tum", trajectory())
    assert [path.name for path in written] == ["walk.tum", "walk-covariances.txt"]
    back = read_trajectory(tmp_path / "walk.tum")
    np.testing.assert_allclose(back.poses, POSES, atol=1e-8)
    np.testing.assert_allclose(back.stamps_s, STAMPS)
    np.testing.assert_allclose(back.covariances, covariances(), rtol=1e-8)
    export_trajectory(tmp_path / "walk.tum", trajectory())
    export_trajectory(tmp_path / "walk.tum", trajectory(stamps_s=STAMPS + 1, covariances=None))
    with pytest.raises(BadInput, match="its stamps are not those of"):
        read_trajectory(tmp_path / "walk.tum")


def test_tum_of_others_is_sorted_and_read_whatever_its_quaternions_signs(tmp_path):
    path = tmp_path / "theirs.tum"
    path.write_text("# t x y z q\n2,1,2,0,0,0,-0.6,-0.8\n1 0 0 0.1 0 0 0 2\n")
    back = read_trajectory(path)
    np.testing.assert_allclose(back.stamps_s, [1, 2])
    np.testing.assert_allclose(back.poses[1], [1, 2, 2 * np.arctan2(0.6, 0.8)])
    np.testing.assert_allclose(back.poses[0], [0, 0, 0])


@pytest.mark.parametrize(("content", "message"), [
    ("", "there is no pose in it"), ("1 2 3\n", "line 1: a line is 8 numbers"),
    ("1 0 0 0 0.7 0 0 0.7\n", "pose 0 is tilted"), ("1 0 0 0 0 0 nan 1\n", "line 1: a line is 8 numbers"),
])  # fmt: skip
def test_files_that_are_no_tum_trajectory_are_refused(tmp_path, content, message):
    (tmp_path / "a.tum").write_text(content)
    with pytest.raises(BadInput, match=message):
        read_trajectory(tmp_path / "a.tum")


def test_a_graph_says_its_steps_and_how_sure_they_are(tmp_path):
    (path,) = export_trajectory(tmp_path / "walk.g2o", trajectory())
    lines = [line.split() for line in path.read_text().splitlines()]
    assert [line[0] for line in lines] == ["VERTEX_SE2"] * 3 + ["EDGE_SE2"] * 2
    np.testing.assert_allclose(np.array(lines[:3])[:, 2:].astype(float), POSES, atol=1e-8)
    for i, line in enumerate(lines[3:]):
        assert line[1:3] == [str(i), str(i + 1)]
        np.testing.assert_allclose(compose(POSES[i], np.array(line[3:6], float))[:2], POSES[i + 1, :2], atol=1e-7)
        information = np.zeros((3, 3))
        information[np.triu_indices(3)] = np.array(line[6:], float)
        assert np.linalg.eigvalsh(information, UPLO="U").min() > 0


def test_a_step_is_as_sure_as_the_draws_say_not_as_two_poses_alone():
    """Draws that move together know their steps exactly; independent ones do not."""
    rng = np.random.default_rng(1)
    sure = chain_edges(Trajectory.of_draws(POSES + rng.normal(size=(500, 1, 3)) * (0.1, 0.1, 0.0), STAMPS))
    alone = chain_edges(Trajectory.of_draws(POSES + rng.normal(size=(500, 3, 3)) * 0.1, STAMPS))
    assert np.linalg.eigvalsh(sure.information).min() > 1e6
    assert np.linalg.eigvalsh(alone.information).max() < 200


def test_a_graph_of_the_base_is_that_of_the_laser_moved():
    """Edges that are moved say of the moved trajectory what its own steps say."""
    mount, law = np.array([0.4, -0.2, 0.7]), RelativeLaw(lambda first, second: covariances()[first], 10.0)
    laser = trajectory(relative=law, frame="laser")
    moved, own = chain_edges(laser).of_frame(inverse(mount)), chain_edges(laser.of("base", mount))
    np.testing.assert_allclose(moved.relative, own.relative, atol=1e-12)
    np.testing.assert_allclose(moved.information, own.information, rtol=1e-5)


def test_graphs_that_cannot_be(tmp_path):
    with pytest.raises(BadInput, match="a graph needs covariances or draws"):
        export_trajectory(tmp_path / "a.g2o", trajectory(covariances=None))
    one = np.array([0])
    with pytest.raises(BadInput, match="edge 0 is not positive definite"):
        Edges(one, one + 1, np.zeros((1, 3)), np.zeros((1, 3, 3)))
    with pytest.raises(BadInput, match="an edge names pose 9, but there are 3"):
        write_g2o(tmp_path / "a.g2o", POSES, Edges(one, one + 9, np.zeros((1, 3)), np.eye(3)[None]))
    assert list(tmp_path.iterdir()) == []


def test_a_mount_swings_with_its_uncertain_heading_and_the_mean_of_draws_goes_round_the_circle():
    """The covariance of another frame is that of its draws, up to what is not linear."""
    covariance = np.diag([0.01, 0.02, 0.01]) ** 2
    pose, mount = np.array([3.0, -1.0, 2.0]), np.array([0.5, 0.2, 0.1])
    drawn = compose(np.random.default_rng(2).multivariate_normal(pose, covariance, 200_000), mount)
    moved = Trajectory(pose, covariances=covariance[None]).of_frame(mount)
    np.testing.assert_allclose(moved.covariances[0], np.cov(drawn.T), atol=4e-6)
    np.testing.assert_allclose(between(moved.poses[0], compose(pose, mount)), 0, atol=1e-12)
    found = Trajectory.of_draws(np.array([[[0.0, 0.0, np.pi - 0.1]], [[2.0, 0.0, -np.pi + 0.1]]]))
    assert abs(abs(found.poses[0, 2]) - np.pi) < 1e-9
    assert found.covariances[0, 2, 2] == pytest.approx(2 * 0.1**2)


def test_an_ellipse_holds_its_share():
    rng = np.random.default_rng(3)
    covariance = np.array([[0.04, 0.03], [0.03, 0.09]])
    (outline,) = ellipses(np.zeros((1, 2)), covariance[None], 0.8)
    np.testing.assert_allclose(outline[0], outline[-1], atol=1e-12)
    edge = np.einsum("ni,ij,nj->n", outline, np.linalg.inv(covariance), outline)
    drawn = rng.multivariate_normal(np.zeros(2), covariance, 20_000)
    inside = np.einsum("ni,ij,nj->n", drawn, np.linalg.inv(covariance), drawn) < edge.mean()
    assert np.ptp(edge) < 1e-9
    assert inside.mean() == pytest.approx(0.8, abs=0.015)  # five standard errors


def test_numpy_reads_stamps_and_scipy_turns_and_without_stamps_poses_are_numbered(tmp_path):
    poses, stamps = scans().poses, [1421098765.123456, 1421098765.25, 1421098766.0]
    path = write_trajectory(tmp_path / "poses.tum", poses, stamps)
    rows = np.loadtxt(path)  # leaves out what follows #
    assert rows.shape == (3, 8)
    np.testing.assert_allclose(rows[:, 0], stamps, rtol=0, atol=1e-6)
    np.testing.assert_allclose(rows[:, 1:4], np.column_stack([poses[:, :2], np.zeros(3)]), atol=1e-9)
    turns = Rotation.from_quat(rows[:, 4:])  # x, y, z, w
    np.testing.assert_allclose(np.linalg.norm(rows[:, 4:], axis=1), 1.0, atol=1e-11)
    np.testing.assert_allclose(turns.as_euler("xyz"), np.column_stack([np.zeros((3, 2)), poses[:, 2]]), atol=1e-9)
    path = write_trajectory(tmp_path / "poses.tum", scans().poses)
    np.testing.assert_array_equal(np.loadtxt(path)[:, 0], [0, 1, 2])
    assert path.read_text().startswith("# scan number (the scans have no stamps) tx ty tz qx qy qz qw\n")


@pytest.mark.parametrize(("poses", "stamps", "says"), [
    (np.zeros((0, 3)), None, "no pose"),
    (np.zeros((2, 3)), [1.0], r"one finite stamp a pose, \(2,\), got shape \(1,\)"),
    (np.zeros((1, 3)), [np.nan], "one finite stamp"), (np.zeros((1, 2)), None, r"expected \(S, 3\)"),
])  # fmt: skip
def test_poses_that_are_no_trajectory_leave_no_file(tmp_path, poses, stamps, says):
    with pytest.raises(BadInput, match=says):
        write_trajectory(tmp_path / "poses.tum", poses, stamps)
    assert list(tmp_path.iterdir()) == []


def written(found, path):
    """Export the graph, and read its lines: vertices, and edges as factors."""
    run = SimpleNamespace(trajectory=found, grid=None, observed=None)
    export_run(path, run, SimpleNamespace(stamps_s=None, mount=None))
    lines = [line.split() for line in path.read_text().splitlines()]
    tags = [line[0] for line in lines]
    assert tags == sorted(tags, reverse=True)  # vertices, then edges, and nothing else
    poses = np.array([line[2:] for line in lines if line[0] == "VERTEX_SE2"], float)
    edges = [line for line in lines if line[0] == "EDGE_SE2"]
    numbers = np.array([line[3:] for line in edges], float)
    information = np.zeros((len(edges), 3, 3))
    information[:, *np.triu_indices(3)] = information[:, *np.triu_indices(3)[::-1]] = numbers[:, 3:]
    first, second = np.array([line[1:3] for line in edges], int).T
    return poses, Factors(first, second, numbers[:, :3], information)


@pytest.mark.parametrize("force", [0.0, 60.0])
def test_the_graph_s_solution_and_its_covariances_are_those_of_the_run(force, tmp_path):
    """Errors that pairs have in common are in it on average: determinants are right over pairs of scans together."""
    found = round_way(force=force)
    poses, graph = written(found, tmp_path / "walk.g2o")
    assert (len(poses), len(graph)) == (len(found), len(found.gaussian.first) + 1)
    step, _ = solve_step(len(poses), [quadratic(graph, poses)])
    assert np.abs(step).max() < 1e-6
    precision = Precision(normal_equations(len(poses), [quadratic(graph, poses)])[0])
    first, second = np.triu_indices(len(found), 2)
    mine = relative_covariances(precision, poses, first, second)
    theirs = found.gaussian.dof / (found.gaussian.dof - 2.0) * found.relative_scales(first, second)
    if force == 0.0:
        spread = np.sqrt(np.diagonal(theirs, axis1=1, axis2=2))
        assert (np.abs(mine - theirs) / (spread[:, :, None] * spread[:, None, :])).max() < 1e-3
    assert abs((np.linalg.slogdet(mine)[1] - np.linalg.slogdet(theirs)[1]).mean() / 3) < (1e-3 if force == 0.0 else 0.1)


def test_an_edge_that_says_nothing_of_a_direction_can_still_be_read():
    found = round_way()
    found.gaussian.curvature[3, 0] = found.gaussian.curvature[3, :, 0] = 0.0
    assert np.linalg.eigvalsh(slam_edges(found).information).min() == pytest.approx(1e-3)


@pytest.mark.parametrize("name", ["true.relations", "true.relations.gz"])
def test_relations_are_written_with_all_their_digits(tmp_path, name):
    rng = np.random.default_rng(0)
    first, second = 976052905.0 + np.round(np.sort(rng.uniform(0, 100, (2, 7)), axis=0), 6)
    relative = rng.uniform(-3, 3, (7, 3))
    path = write_relations(tmp_path / name, first, second, relative)
    text = gzip.decompress(path.read_bytes()) if name.endswith(".gz") else path.read_bytes()
    table = np.loadtxt(text.decode().splitlines())
    np.testing.assert_allclose(table[:, :2], np.column_stack([first, second]), atol=1e-6, rtol=0)
    np.testing.assert_allclose(table[:, [2, 3, 7]], relative, atol=1e-8)
    assert not table[:, 4:7].any()
    for wrong in (([], [], np.zeros((0, 3))), ([1], [2, 3], np.zeros((1, 3))), ([1], [2], [0, 0])):
        with pytest.raises(BadInput, match="relations: stamps"):
            write_relations(tmp_path / "a.relations", *wrong)


SECONDS = np.linspace(10.0, 12.0, 11)
LASER_ON_BASE = (0.3, -0.1, 0.5)
BASE = np.column_stack([SECONDS - 10.0, 0.1 * (SECONDS - 10.0), 0.3 * (SECONDS - 10.0)])


@pytest.fixture
def log(tmp_path):
    """Scans with stamps and without poses; where the laser sits is known only from an option."""
    ranges = np.random.default_rng(0).uniform(1.0, 3.0, (len(SECONDS), 5))
    np.savez(tmp_path / "log.npz", angles_rad=np.linspace(-1, 1, 5), ranges_m=ranges, stamps_s=SECONDS)
    return tmp_path / "log.npz"


def tum(path, poses, stamps_s, frame=None):
    return write_trajectory(path / "theirs.tum", poses, stamps_s, frame)


@pytest.mark.parametrize("named", ["base", "laser", None])
@pytest.mark.parametrize("laser", [LASER_ON_BASE, None])
def test_the_frame_is_what_the_file_says_or_the_base_if_it_is_known(log, tmp_path, named, laser):
    theirs = tum(tmp_path, BASE, SECONDS, named)
    assert read_trajectory(theirs).frame == named
    if named == "base" and laser is None:
        with pytest.raises(bm.BadInput, match="it has poses of the base; those of the laser need to know where"):
            read_log(log, trajectory=theirs)
        return
    reading = describe_log(log, trajectory=theirs, laser=laser)
    of_base = named == "base" or (named is None and laser is not None)
    expected = compose(BASE, np.array(LASER_ON_BASE)) if of_base else BASE
    np.testing.assert_allclose(reading.scans.poses, expected, atol=1e-8)
    assert f"taken as poses of the {'base' if of_base else 'laser'}" in reading.notes[0]
    scans = read_log(log, trajectory=read_trajectory(theirs, frame="laser"), laser=laser)
    np.testing.assert_allclose(scans.poses, BASE, atol=1e-8)


def test_poses_between_are_interpolated_and_scans_outside_or_in_gaps_are_left_out(log, tmp_path):
    stamps = np.array([10.1, 10.3, 10.5, 11.0, 11.2, 11.5])  # none at 10; a gap of 0.5 s; ends at 11.5
    theirs = tum(tmp_path, np.column_stack([stamps, 0 * stamps, 0 * stamps]), stamps)
    reading = describe_log(log, trajectory=theirs)
    np.testing.assert_allclose(reading.scans.stamps_s, [10.2, 10.4, 11.0, 11.2, 11.4])
    np.testing.assert_allclose(reading.scans.poses[:, 0], reading.scans.stamps_s, atol=1e-9)
    assert "4 scans were left out: the trajectory reaches from 10.1 s to 11.5 s" in reading.notes
    assert "2 scans were left out: its poses are over 0.3 s apart there" in reading.notes
    assert len(read_log(log, trajectory=theirs, thin_m=0.5)) == 2


@pytest.mark.parametrize(("stamps", "message"), [
    (SECONDS + 1e6, "its scans are from 10.0 s to 12.0 s, and the trajectory reaches from 1000010.0 s to"),
    (np.linspace(0.5, 20.5, 11), "with poses more than 0.3 s apart around each scan; are both of one clock"),
])  # fmt: skip
def test_a_trajectory_of_another_time_is_refused(log, tmp_path, stamps, message):
    with pytest.raises(bm.BadInput, match=message):
        read_log(log, trajectory=tum(tmp_path, BASE, stamps))


def test_scans_or_poses_without_stamps_are_refused(log, tmp_path):
    np.savez(tmp_path / "bare.npz", angles_rad=np.zeros(1), ranges_m=np.ones((11, 1)))
    for path, trajectory in ((tmp_path / "bare.npz", tum(tmp_path, BASE, SECONDS)), (log, Trajectory(BASE))):
        with pytest.raises(bm.BadInput, match="a trajectory places scans by their time"):
            read_log(path, trajectory=trajectory)


def test_a_trajectory_changes_its_frame_and_back():
    laser = Trajectory(BASE, SECONDS, np.tile(np.diag([0.01, 0.02, 0.03]), (11, 1, 1)), frame="laser")
    back = laser.of(None, np.array(LASER_ON_BASE)).of("laser", np.array(LASER_ON_BASE))
    np.testing.assert_allclose(back.covariances, laser.covariances, atol=1e-12)
    with pytest.raises(bm.BadInput, match="frame must be one of base, laser, got 'bse'"):
        laser.of("bse", np.array(LASER_ON_BASE))
