"""A scan's likelihood at a pose equals what tracing the beams from there and predicting their readings says."""

from dataclasses import replace

import numpy as np
import pytest
from test_predictions import CASES, DEPTH, GRID, SENSORS, world

import bayesmap as bm
from bayesmap.kernels.predict.density import log_densities
from bayesmap.kernels.predict.scan_likelihood import ScanLikelihood
from bayesmap.kernels.rays import trace_rays


def predicted(scans, maps, sensor):
    """The same by tracing, one map after the other, (maps, S, A), invalid readings 0."""
    rays = trace_rays(scans, GRID)
    found = [log_densities(rays, [m[None, rays.touched]], sensor, DEPTH) for m in maps]
    return np.nan_to_num(np.array(found)).reshape(len(maps), *scans.ranges_m.shape)


def moved(scans, seed):
    rng = np.random.default_rng(seed)
    return replace(scans, poses=scans.poses + rng.normal(0, [0.3, 0.3, 0.5], scans.poses.shape))


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_scans_at_other_poses_have_the_likelihood_of_beams_traced_there(name, kind):
    for seed in range(4):
        scans, maps = world(seed, kind)
        there = moved(scans, seed)
        chain, scan = (a.ravel() for a in np.meshgrid(np.arange(3), np.arange(len(scans)), indexing="ij"))
        likelihood = ScanLikelihood(scans, GRID, SENSORS[name], DEPTH)
        found = likelihood.beams(maps, np.tile(there.poses, (3, 1)), scan, chain)
        expected = predicted(there, maps, SENSORS[name])
        np.testing.assert_allclose(found.reshape(expected.shape), expected, atol=1e-5, rtol=1e-5)


def test_beams_that_left_while_the_sensor_moved_move_with_their_scan():
    scans, maps = world(5)
    rng = np.random.default_rng(0)
    drift = rng.normal(0, 0.05, (*scans.ranges_m.shape, 3))
    scans = replace(scans, beam_poses=scans.poses[:, None] + drift)
    likelihood = ScanLikelihood(scans, GRID, bm.Gaussian(0.2), DEPTH)
    scan, chain = np.arange(len(scans)), np.zeros(len(scans), dtype=int)
    unmoved = likelihood.beams(maps, scans.poses, scan, chain)
    np.testing.assert_allclose(unmoved, predicted(scans, maps[:1], bm.Gaussian(0.2))[0], atol=1e-5, rtol=1e-5)
    turn, shift = 0.3, np.array([0.2, -0.1])
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])

    def rigid(poses):
        return np.concatenate([poses[..., :2] @ rotation.T + shift, poses[..., 2:] + turn], axis=-1)

    there = replace(scans, poses=rigid(scans.poses), beam_poses=rigid(scans.beam_poses))
    found = likelihood.beams(maps, there.poses, scan, chain)
    np.testing.assert_allclose(found, predicted(there, maps[:1], bm.Gaussian(0.2))[0], atol=1e-5, rtol=1e-5)


def test_threads_and_company_do_not_matter():
    scans, maps = world(3)
    likelihood = ScanLikelihood(scans, GRID, SENSORS["mixture"], DEPTH)
    scan = np.repeat(np.arange(len(scans)), 50)
    poses = np.repeat(scans.poses, 50, axis=0) + np.random.default_rng(1).normal(0, 0.2, (len(scan), 3))
    chain = np.zeros(len(scan), dtype=int)
    together = likelihood(maps, poses, scan, chain)
    alone = [likelihood(maps, poses[i : i + 1], scan[i : i + 1], chain[i : i + 1])[0] for i in range(0, len(scan), 7)]
    assert (together[::7] == alone).all()
