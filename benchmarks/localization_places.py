"""Where was each scan of the Intel log taken, all along it? Rates, and how often right when it says so, as a table.

`python -m benchmarks.localization_places FOLDER [SECONDS]` writes maps and results into the folder as it goes, begins
nothing new after so many seconds, and goes on from there when called again. Every tenth scan begins a place. A map is
made without the 30 scans before and after those of three places at once, which lie far apart: it lacks a quarter of the
log, and is rather poorer than one made for a single place. Sensor and prior are fitted once, without one window of
scans; chains are of 16 sweeps.
"""

import json
import os
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import bayesmap as bm
from bayesmap.cells.surface import Surface
from bayesmap.localization.known_map import KnownMap
from bayesmap.localization.localize import localize
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from benchmarks.located import located
from benchmarks.suites.poses import DATA, MAX_RANGE_M, RESOLUTION_M

PLACES = range(0, 901, 10)
WINDOWS, TRIALS = 3, 300
LEVELS = (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.01)


def groups(scans: Scans) -> list[list[int]]:
    """Places whose windows are left out of one map: of some hundred random groupings the one most apart."""
    position = scans.poses[:, :2]
    windows = [position[max(0, place - 30) : place + 40] for place in PLACES]
    apart = np.array([[np.sqrt(((a[:, None] - b) ** 2).sum(axis=-1)).min() for b in windows] for a in windows])
    rng = np.random.default_rng(0)
    best, chosen = (-1.0, -1.0), []
    for _ in range(TRIALS):
        left, found = rng.permutation(len(PLACES)).tolist(), []
        while left:
            group = [left.pop(0)]
            while len(group) < WINDOWS and left:
                group.append(left.pop(int(np.argmax([apart[k, group].min() for k in left]))))
            found.append(group)
        nearest = [min(apart[a, b] for a in group for b in group if a != b) for group in found if len(group) > 1]
        if (min(nearest), float(np.mean(nearest))) > best:
            best, chosen = (min(nearest), float(np.mean(nearest))), found
    return [[PLACES[k] for k in group] for group in chosen]


def map_without(scans: Scans, places: list[int], sensor: Any, prior: Surface, path: Path) -> None:
    """Infer a map without the windows of these places, and save it whole or not at all."""
    index = np.arange(len(scans))
    kept = np.all([np.abs(index - (place + 5)) > 35 for place in places], axis=0)
    made = bm.infer(
        scans.select(kept),
        Grid.covering(scans, RESOLUTION_M),
        prior=prior,
        sensor=sensor,
        schedule=bm.Schedule(warmup=12, draws=4, chains=2),
        seed=1,
    )
    made.save(path.with_suffix(".part.nc"))
    path.with_suffix(".part.nc").rename(path)


def summary(found: list[dict[str, Any]]) -> str:
    """The figures of docs/lab/localization.md."""
    lines = [f"{len(found)} places"]
    for name, answers in (("one scan", [a for f in found for a in f["one"]]), ("ten scans", [f["ten"] for f in found])):
        right = np.array([a["right"] for a in answers])
        squares = np.array([a["square"] for a in answers])[right]
        says, off = np.mean([a["modes"][0][0] for a in answers]), np.median([a["off_m"] for a in answers])
        lines.append(
            f"{name}: right {100 * right.mean():.1f} % of {len(right)}, says {100 * says:.1f} %, off {off:.3f} m, "
            f"squared error {squares.mean():.1f} on average, median {np.median(squares):.1f}, "
            f"{np.median([a['seconds'] for a in answers]):.3f} s of processor time"
        )
    lines.append(f"following: {np.median([f['hz'] for f in found]):.0f} scans a second of processor time")
    modes = np.array([mode for f in found for a in f["one"] for mode in a["modes"]], dtype=np.float64)
    lines.append("of one scan, places with a probability | how many | says | is right")
    for least, most in pairwise(LEVELS):
        own = modes[(modes[:, 0] >= least) & (modes[:, 0] < most)]
        if len(own):
            says, right = 100 * own.mean(axis=0)
            lines.append(f"{least} to {min(1.0, most)} | {len(own)} | {says:.0f} % | {right:.0f} %")
    return "\n".join(lines)


def main() -> None:
    """Go on where the folder says, for so long."""
    folder, until = Path(sys.argv[1]), time.time() + float(sys.argv[2] if len(sys.argv) > 2 else 1e9)
    folder.mkdir(parents=True, exist_ok=True)
    scans = bm.read_log(DATA / "intel-corrected.log.gz").limited(MAX_RANGE_M)
    raw = bm.read_log(DATA / "intel-odometry.log.gz")
    results, fitted = folder / "places.jsonl", folder / "fitted.nc"
    if not fitted.exists():
        train = scans.select(np.abs(np.arange(len(scans)) - 105) > 35)
        made = bm.infer(
            train,
            Grid.covering(scans, RESOLUTION_M),
            prior=bm.Surface(),
            sensor="fit",
            schedule=bm.Schedule(warmup=4, draws=2, chains=1),
            seed=1,
        )
        made.save(fitted)
    first = bm.load(fitted).posterior
    lines = results.read_text().splitlines() if results.exists() else []
    found = list({one["place"]: one for one in map(json.loads, lines)}.values())
    for number, group in enumerate(groups(scans)):
        left = [place for place in group if place not in {f["place"] for f in found}]
        path = folder / f"map_{number:02d}.nc"
        if not left or time.time() > until:
            continue
        if not path.exists():
            map_without(scans, group, first.sensor, first.prior, path)
        known = KnownMap.of_run(bm.load(path))
        localize(known, scans.select([0]))  # compiles, and makes the map ready
        for place in left:
            found.append(located(known, scans, raw, place))
            with results.open("a") as out:
                out.write(json.dumps(found[-1]) + os.linesep)
    print(summary(found))


if __name__ == "__main__":
    main()
