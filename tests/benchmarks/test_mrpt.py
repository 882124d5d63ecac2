"""The peer MRPT: its files are written as its own programs write them, and it is left out with a reason."""

import gzip
import struct

import numpy as np
import pytest

import bayesmap as bm
from benchmarks.environments import Unavailable
from benchmarks.peers import mrpt_localization as mrpt


def scans(angles_rad):
    ranges = np.array([[1.5, np.inf, 2.5]] * 2)
    return bm.Scans(np.array([[1.0, 2.0, 0.5], [3.0, 4.0, -0.5]]), angles_rad, ranges, max_range_m=20.0)


def test_a_rawlog_has_odometry_and_readings_in_turn(tmp_path):
    """The layout is that of files that MRPT 2.5's carmen2rawlog writes."""
    mrpt.write_rawlog(scans(np.radians([-1.0, 0.0, 1.0])), tmp_path / "log.rawlog")
    data = gzip.decompress((tmp_path / "log.rawlog").read_bytes())
    name = b"\x9fmrpt::obs::CObservationOdometry\x02\x94mrpt::poses::CPose2D\x01"
    assert data.startswith(name + struct.pack("<3d", 1.0, 2.0, 0.5) + b"\x88\x08\x00\x00\x00ODOMETRY")
    assert [data.count(kind) for kind in (b"CObservationOdometry\x02", b"CObservation2DRangeScan\x07")] == [2, 2]
    readings = struct.pack("<I3f", 3, 1.5, 20.0, 2.5) + b"\x01\x00\x01"
    assert data.count(readings) == 2
    aperture = struct.pack("<f?f", np.radians(2.0), True, 20.0)
    assert data.count(b"CObservation2DRangeScan\x07" + aperture + b"\x94mrpt::poses::CPose3D\x03") == 2


def test_beams_that_are_not_evenly_spaced_are_refused(tmp_path):
    with pytest.raises(ValueError, match="evenly spaced"):
        mrpt.write_rawlog(scans(np.array([0.0, 0.1, 0.3])), tmp_path / "log.rawlog")


def test_where_mrpt_is_not_installed_it_is_left_out_with_a_reason(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    found = mrpt.missing()
    assert isinstance(found, Unavailable)
    assert "mrpt-apps" in found.reason


@pytest.mark.skipif(mrpt.missing() is not None, reason="MRPT's programs are not installed")
def test_it_finds_a_robot_in_a_room(tmp_path):
    walls = np.zeros((70, 50), dtype=bool)
    walls[[0, -1]], walls[:, [0, -1]] = True, True
    walls[20:24, 10:30], walls[50:, 35:38], walls[36:38, :16] = True, True, True
    grid = bm.Grid(walls.shape, 0.1, (-3.0, 1.0))
    turn = np.linspace(0.0, 2 * np.pi, 24)
    truth = np.column_stack([0.5 + 0.4 * np.sin(turn), 3.5 - 0.4 * np.cos(turn), turn])  # once round in a circle
    angles = np.radians(np.linspace(-90, 90, 181))
    seen = bm.simulate(walls, grid, truth, angles, sensor=bm.Gaussian(0.01), max_range_m=10.0, seed=0)
    off_m = []
    for n in range(3):  # its random numbers cannot be seeded, and now and then it settles beside the place
        folder = tmp_path / str(n)
        folder.mkdir()
        found = mrpt.locate(walls.astype(float), np.ones(walls.shape, bool), grid, seen, folder)
        assert found.poses.shape == (24, 3)
        assert found.seconds.shape == (24,)
        off_m.append(np.hypot(*(found.poses[-1] - truth[-1])[:2]))
    assert min(off_m) < 0.4
