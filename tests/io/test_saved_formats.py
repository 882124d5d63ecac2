"""Runs that were saved by earlier versions still load, and say what they said then.

The files were written by the code of their time, from four scans of a room of 8 x 6 cells; the figures beside each are
what that code computed. A run of format 2 has no expected reflectivities, and its drawn ones take their place; before
format 5 surfaces have no stop chances, and their maps show reflectivities.
"""

from pathlib import Path

import numpy as np
import pytest

import bayesmap as bm

HERE = Path(__file__).parent / "formats"
SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.004), p_random=0.04, p_no_return=0.06, p_short=0.08, rate_short_per_m=0.7)

# finished, sum of the mean map, of the log joint, held-out nats a beam, observed cells, sum of all draws' maps
FIGURES = {
    "format1-walls": (True, 18.2, -48.17275755900936, 0.28345018204380307, 45, 182.0),
    "format1-importance": (True, 9.200000009219847, -539.0226584766918, -1.982397290567557, 46, 54.0),
    "format2-reflectivity": (True, 14.466774694621563, -833.625795351807, 0.0003494904787162689, 43, 115.7341975569725),
    "format2-surface": (True, 21.461308978497982, 3250.5112055130303, -1.159034483634181, 37, 171.69047182798386),
    "format2-unfinished": (False, 18.155806879202526, 3290.3150931224227, -1.0059873350869764, 36, 108.93484127521515),
    "format3-walls": (True, 18.2, -48.17275755900936, 0.28345018204380307, 45, 182.0),
    "format3-importance": (True, 9.200000009219847, -539.0226584766918, -1.982397290567557, 46, 54.0),
    "format3-reflectivity": (
        True,
        16.049228683114052,
        -833.6257946365513,
        -0.011185230361639995,
        43,
        115.7341975569725,
    ),
    "format3-surface": (True, 25.164758697152138, 3251.2737163743004, -0.936060269078696, 37, 171.68754214048386),
    "format4-surface": (True, 17.718304857611656, 4160.024120412869, -0.6680261264216072, 42, 142.36882489919662),
    "format3-unfinished": (False, 17.482732286055885, 3290.911123936996, -1.0436008369772045, 36, 108.93484127521515),
}


def heldout():
    """The two scans that the figures are of: drawn from a room with walls all around and a pillar."""
    walls = np.zeros((8, 6), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = walls[4, 2] = True
    grid = bm.Grid((8, 6), resolution=0.5, origin=(-1.0, 2.0))
    poses = np.array([[0.1, 2.9, 0.3], [2.2, 4.1, -2.0]]) + 0.1
    angles = np.linspace(-np.pi, np.pi, 12, endpoint=False)
    return bm.simulate(walls, grid, poses, angles, sensor=SENSOR, max_range_m=5.0, min_range_m=0.1, seed=9)


@pytest.mark.parametrize("name", FIGURES)
def test_a_run_of_an_earlier_version_says_what_it_said(name, tmp_path):
    finished, occupancy, log_joint, nats, observed, draws = FIGURES[name]
    run = bm.load(HERE / f"{name}.nc")
    assert run.posterior.kind == {"w": "binary", "i": "binary", "r": "reflectivity"}.get(name[8], "surface")
    assert run.finished == finished
    assert run.occupancy.sum() == pytest.approx(occupancy, rel=1e-9)
    assert run.log_joint.sum() == pytest.approx(log_joint, rel=1e-12)
    assert run.observed.sum() == observed
    assert run.draws.astype(float).sum() == pytest.approx(draws, rel=1e-6)
    # Surfaces of cells in which no reading ended are drawn anew, by now from other numbers and inside their cells; and
    # since format 2 a beam's direction is known up to an angle only.
    close = {"surface": 0.2, "reflectivity": 1e-3, "binary": 1e-3}[run.posterior.kind]
    assert run.log_score(heldout()) == pytest.approx(nats, abs=0.3 if name == "format2-surface" else close)
    assert len(run.posterior.scans.stamps_s) == 4
    assert run.summary().finished == finished
    run.save(tmp_path / "again.nc")
    again = bm.load(tmp_path / "again.nc")
    np.testing.assert_array_equal(again.draws, run.draws)
    np.testing.assert_array_equal(again.occupancy, run.occupancy)
    if again.posterior.kind != "binary":
        lower, upper = again.interval(0.9)
        assert (lower <= upper).all()
    if again.posterior.kind == "surface":
        assert len(again.surfaces()[0]) == len(again.posterior.draws.index["surface_cell"]) > 10


def test_what_only_some_runs_have_is_there():
    assert len(bm.load(HERE / "format1-importance.nc").log_weights) == 50
    assert bm.load(HERE / "format1-importance.nc").posterior.log_evidence < 0
    assert len(bm.load(HERE / "format3-walls.nc").posterior.statistics["belief_changes"]) > 0
    assert bm.load(HERE / "format3-unfinished.nc").posterior.scans.beam_poses.shape == (4, 12, 3)


@pytest.mark.parametrize("name", ["format3-unfinished", "format2-unfinished", "format4-surface"])
def test_chains_of_an_earlier_version_are_not_gone_on_with(name):
    """Their random numbers were dealt out otherwise."""
    run = bm.load(HERE / f"{name}.nc")
    settings, grid = run.posterior.settings, run.grid
    asked = {key: settings[key] for key in ("seed", "chains", "warmup", "draws", "hit_depth")}
    with pytest.raises(bm.BadInput, match=r"resume: .*start again"):
        bm.infer(run.posterior.scans, grid, prior=run.posterior.prior, sensor=SENSOR, resume=run, **asked)


@pytest.mark.parametrize("name", ["format1-walls", "format2-surface", "format3-reflectivity"])
def test_a_number_that_was_changed_is_noticed_in_old_files_too(name, tmp_path):
    import netCDF4

    path = tmp_path / "changed.nc"
    path.write_bytes((HERE / f"{name}.nc").read_bytes())
    with netCDF4.Dataset(path, "a") as file:
        file["sample_stats"]["log_prior"][0, 0] += 1.0
    with pytest.raises(bm.BadInput, match=r"changed\.nc: the saved run is damaged"):
        bm.load(path)
