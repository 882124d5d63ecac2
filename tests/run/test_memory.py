"""A grid whose chains do not fit into memory is refused before anything is made of it."""

import pytest

import bayesmap as bm
from bayesmap.run import checks

SCANS = bm.Scans([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [3.0, 1.0, 0.0]], [0.0], [[0.5], [0.5], [0.5]], max_range_m=5.0)
FAR = bm.Scans([*SCANS.poses[:2], [900.0, 1.0, 0.0]], [0.0], SCANS.ranges_m, max_range_m=5.0)
SENSOR = bm.BeamMixture(bm.Gaussian(0.05))


def test_the_machine_says_how_much_it_has_or_the_memory_is_not_asked_for(monkeypatch):
    assert checks.memory_bytes() is None or checks.memory_bytes() > 1 << 28
    monkeypatch.setattr(checks, "memory_bytes", lambda: None)
    checks.check_memory(bm.Grid((9000, 9000), 0.1), SCANS, True, 100)


@pytest.mark.parametrize("prior", [bm.Surface(), bm.Beta()], ids=["surfaces", "reflectivities"])
@pytest.mark.parametrize("chains", [1, 4])
def test_so_many_bytes_a_cell_are_needed(monkeypatch, prior, chains):
    grid = bm.Grid((40, 50), 0.1)
    once, each = checks.OF_A_CELL[prior.has_surfaces]
    needed = grid.n_cells * (once + chains * each)

    def infer():
        return bm.infer(SCANS, grid, prior=prior, sensor=SENSOR, schedule=bm.Schedule(chains=chains, warmup=1, draws=1))

    monkeypatch.setattr(checks, "memory_bytes", lambda: needed)
    infer()
    monkeypatch.setattr(checks, "memory_bytes", lambda: needed - 1)
    with pytest.raises(bm.BadInput, match=rf"{chains} chains of 40 x 50 cells take .* use a coarser resolution"):
        infer()


def test_a_scan_that_is_far_from_all_others_is_named(monkeypatch):
    monkeypatch.setattr(checks, "memory_bytes", lambda: 1 << 20)
    with pytest.raises(bm.BadInput, match=r"scan 2 was taken at \(900, 1\) m, far from all others; correct its pose"):
        bm.infer(FAR, bm.Grid.covering(FAR, 0.5), prior=bm.Surface(), sensor=SENSOR)


def test_containers_may_take_less_than_the_machine_has(monkeypatch, tmp_path):
    limit, none = tmp_path / "limit", tmp_path / "none"
    limit.write_text("12345\n")
    none.write_text("max\n")
    monkeypatch.setattr(checks, "GROUP_LIMITS", (str(none), str(tmp_path / "missing")))
    assert checks.memory_bytes() != 12345
    monkeypatch.setattr(checks, "GROUP_LIMITS", (str(none), str(limit)))
    assert checks.memory_bytes() == 12345
