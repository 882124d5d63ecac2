"""One pass of OctoMap over scans: what robots do to have a map, timed.

Every scan is inserted once, as a cloud of points in the plane z = 0, with the defaults of OctoMap: a hit adds the
log-odds of 0.7, a miss those of 0.4, clamped to [0.1192, 0.971]; a cell is updated at most once a scan. Readings
without return are points beyond the largest range, so that their beams clear cells as they do for us. The clouds are
made beforehand: only the insertion is timed.

Run it with an interpreter that has pyoctomap (`python -m benchmarks.environments pyoctomap` makes one):
`python pyoctomap_pass.py --scans scans.npz --resolution 0.1 --case pass --repeats 5 --json`. The archive has `poses`
(S, 3), `angles_rad` (A,), `ranges_m` (S, A) and `max_range_m`, coded as in `bayesmap.Scans`.
"""

import argparse
import contextlib
import json
import platform
import sys
from importlib.metadata import version
from pathlib import Path

import harness
import numpy as np
import pyoctomap


def clouds(scans: dict[str, np.ndarray]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Points and origin of every scan, (n, 3) and (3,), in metres in the world frame."""
    max_range_m, found = float(scans["max_range_m"]), []
    for pose, ranges_m in zip(scans["poses"], scans["ranges_m"], strict=True):
        reading = np.where(np.isposinf(ranges_m), 1.5 * max_range_m, ranges_m)
        some = np.isfinite(reading)
        angle = pose[2] + scans["angles_rad"][some]
        x, y = pose[0] + reading[some] * np.cos(angle), pose[1] + reading[some] * np.sin(angle)
        points = np.ascontiguousarray(np.stack([x, y, np.zeros_like(x)], axis=-1))
        found.append((points, np.array([pose[0], pose[1], 0.0])))
    return found


def prepare(scans: dict[str, np.ndarray], resolution_m: float) -> harness.Ready:
    """A pass over all scans into an empty tree."""
    everything, max_range_m, last = clouds(scans), float(scans["max_range_m"]), []

    def advance() -> None:
        tree = pyoctomap.OcTree(resolution_m)
        for points, origin in everything:
            tree.insertPointCloud(points, origin, max_range=max_range_m)
        last[:] = [tree]

    def occupied() -> int:
        return sum(bool(last[0].isNodeOccupied(leaf)) for leaf in last[0].begin_leafs())

    return harness.Ready(advance, 1, occupied)


def main() -> None:
    """Time it; one JSON document on standard output."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--case", choices=["pass"], default="pass")
    parser.add_argument("--scans", type=Path, required=True)
    parser.add_argument("--resolution", type=float, required=True, help="edge of a cell in metres")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--in-turn", action="store_true", help="time one call for every line of standard input")
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    options = parser.parse_args()
    with np.load(options.scans) as archive:
        scans = dict(archive)
    case = harness.Case(lambda prior: prepare(scans, options.resolution), float("nan"), "pass over all scans")
    stream = sys.stdout
    with contextlib.redirect_stdout(sys.stderr):
        ready, about = harness.set_up("pyoctomap", options.case, case, case.prior)
        about["log_joint_of_truth"] = float("nan")
        about["versions"] = {"python": platform.python_version(), "pyoctomap": version("pyoctomap")}
        if options.in_turn:
            harness.in_turn(ready, about, stream)
            return
        report = harness.at_once(ready, about, options.repeats)
    print(json.dumps(report, indent=2) if options.json else report)


if __name__ == "__main__":
    main()
