"""The graph of a slam run, as other programs solve it."""

from types import SimpleNamespace

import numpy as np
import pytest
from oracle.trajectories import round_way

from bayesmap.io.exports import export_run
from bayesmap.io.text.g2o import slam_edges
from bayesmap.poses.graph import Factors, normal_equations, quadratic, solve_step
from bayesmap.poses.precision import Precision, relative_covariances


def written(found, path):
    """The graph as a file's lines say it: vertices, and edges as factors."""
    run = SimpleNamespace(trajectory=found, grid=None, observed=None)
    export_run(path, run, SimpleNamespace(stamps_s=None))
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
    assert len(poses) == len(found)
    assert len(graph) == len(found.gaussian.first) + 1
    step, _ = solve_step(len(poses), [quadratic(graph, poses)])
    assert np.abs(step).max() < 1e-6
    precision = Precision(normal_equations(len(poses), [quadratic(graph, poses)])[0])
    first, second = np.triu_indices(len(found), 2)
    mine = relative_covariances(precision, poses, first, second)
    theirs = found.gaussian.dof / (found.gaussian.dof - 2.0) * found.relative_covariances(first, second)
    if force == 0.0:
        np.testing.assert_allclose(mine, theirs, rtol=1e-3, atol=1e-9)
    ratio = np.linalg.slogdet(mine)[1] - np.linalg.slogdet(theirs)[1]
    assert abs(ratio.mean() / 3) < (1e-3 if force == 0.0 else 0.1)


def test_an_edge_that_says_nothing_of_a_direction_can_still_be_read():
    found = round_way()
    found.gaussian.curvature[3, 0] = found.gaussian.curvature[3, :, 0] = 0.0
    edges = slam_edges(found)
    assert np.linalg.eigvalsh(edges.information).min() == pytest.approx(1e-3)


def test_gtsam_finds_nothing_to_mend(tmp_path):
    gtsam = pytest.importorskip("gtsam")
    poses, graph = written(round_way(), tmp_path / "walk.g2o")
    read, values = gtsam.readG2o(str(tmp_path / "walk.g2o"), False)
    assert (read.size(), values.size()) == (len(graph), len(poses))
    assert read.error(values) < 1e-6
