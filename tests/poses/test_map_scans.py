"""The map of a long log is made from the scans that see walls which others have not shown well."""

import numpy as np
from simulated import path_around, ring, scans_of

import bayesmap as bm
from bayesmap import api
from bayesmap.poses import map_scans
from bayesmap.poses.map_scans import for_map
from bayesmap.space.scans import Scans


def driven(laps, beams=720):
    poses = path_around(laps, step_m=0.4)
    angles, ranges = scans_of(ring(), poses, beams=beams)
    return Scans(poses, angles, ranges, max_range_m=12.0)


def test_few_beams_are_used_whole():
    scans = driven(1.0)
    assert for_map(scans, 0.1) is scans


def test_the_cost_of_the_map_follows_the_area_seen(monkeypatch):
    """Three rounds more take hardly more beams, and every wall has been seen. The twin: no number of hits is enough."""
    monkeypatch.setattr(map_scans, "MANY_BEAMS", 10_000)
    monkeypatch.setattr(map_scans, "ENOUGH", 5)
    once, often = (for_map(driven(laps), 0.1) for laps in (1.0, 4.0))
    assert len(often.angles_rad) == 180  # a degree apart
    assert once.ranges_m.size <= often.ranges_m.size < 1.2 * once.ranges_m.size
    seen, all_seen = (
        np.unique(np.floor(s.hit_points_world() / 0.1), axis=0, return_counts=True) for s in (often, driven(4.0))
    )
    shown = {tuple(cell) for cell in seen[0]}
    walls = [tuple(cell) for cell, hits in zip(*all_seen, strict=True) if hits >= 30]
    assert np.mean([cell in shown for cell in walls]) > 0.99
    monkeypatch.setattr(map_scans, "ENOUGH", 10**9)
    assert len(for_map(driven(4.0), 0.1)) == len(driven(4.0))


def test_poses_of_many_key_scans_are_sampled_on_request_alone(monkeypatch):
    monkeypatch.setattr(api, "SAMPLED", 3)
    log = driven(0.3, beams=90)
    short = bm.Schedule(chains=1, warmup=5, draws=2)
    kinds = [
        bm.slam(log, resolution=0.2, fast=fast, schedule=short).posterior.settings["poses"]["kind"]
        for fast in (None, False)
    ]
    assert kinds[0] == "known" != kinds[1]
