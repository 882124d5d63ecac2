"""Localization in maps of other programs: simulated buildings with wrong maps, and how often answers are right.

`python -m benchmarks.external_maps FOLDER FIRST:LAST` simulates buildings of these numbers, writes what was found of
each into the folder, and prints tables. A building's map lacks its furniture, and is shifted in parts by 5 to 20 cm,
inflated, blurred, partly unknown, and written in one of nav2's modes; people stand and walk about the robot. It is
located along its log, from anywhere; from ten scans with odometry; and from single scans.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from itertools import pairwise
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

import bayesmap as bm
from bayesmap.io.ros.maps import read_map, write_map
from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.external_map import ASSUMED, MapLaw, external_map, fit_law
from bayesmap.localization.known_map import KnownMap, Trust
from bayesmap.localization.localize import follow, localize
from bayesmap.space.planar import wrap_angle
from benchmarks.located import is_right

Floats = NDArray[np.float64]

CELL_M = 0.05
SURE, NOT_LOST = 0.99, 0.01
LEVELS = (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.01)
ENDS = 10
"""Scans with odometry that a start from anywhere is given."""


@dataclass(frozen=True)
class Case:
    """A building, its map's errors, its people, and the robot.

    Attributes:
        seed: of all.
        size_m: of the building.
        shift_m: how far parts of the map are off, at most and at least a quarter of it.
        inflated: cells by which walls are thicker.
        blur_m: standard deviation of the blur; 0: none.
        mode: of nav2.
        people: about the robot, on average.
        clutter: of furniture that the map lacks.
        field_deg: the laser's field of view.
        beams: of the laser.
        reach_m: its largest range.
        step_m: from scan to scan.
    """

    seed: int
    size_m: tuple[float, float]
    shift_m: float
    inflated: int
    blur_m: float
    mode: str
    people: float
    clutter: float
    field_deg: float
    beams: int
    reach_m: float
    step_m: float


def case_of(seed: int) -> Case:
    """A case by its number: all is drawn."""
    rng = np.random.default_rng([seed, 36])
    sizes = ((16.0, 10.0), (24.0, 16.0), (32.0, 20.0), (50.0, 11.0), (60.0, 14.0))
    field, beams = ((180.0, 181), (240.0, 241), (270.0, 271), (360.0, 180))[rng.integers(4)]
    return Case(
        seed=seed, size_m=sizes[seed % len(sizes)], shift_m=float(rng.choice([0.05, 0.1, 0.2])),
        inflated=int(rng.integers(0, 3)), blur_m=float(rng.choice([0.0, 0.0, 0.05, 0.1])),
        mode=str(rng.choice(["trinary", "scale", "raw"])), people=float(rng.choice([0.0, 1.0, 3.0, 6.0])),
        clutter=float(rng.choice([0.5, 1.0, 1.5])), field_deg=field, beams=beams,
        reach_m=float(rng.choice([8.0, 12.0, 25.0])), step_m=float(rng.choice([0.1, 0.25, 0.4])),
    )  # fmt: skip


def wrong_map(walls: NDArray[np.bool_], case: Case, rng: np.random.Generator) -> Floats:
    """The map that somebody else made of these walls: occupancy, NaN where unknown, (nx, ny)."""
    nx, ny = walls.shape
    # Parts some metres wide are off, each its own way, with seams half a metre wide.
    middles = np.argwhere(np.ones((nx // 100 + 2, ny // 100 + 2))) * 100 + rng.uniform(-40, 40, (1, 2))
    angle = rng.uniform(-np.pi, np.pi, len(middles))
    off = rng.uniform(0.25, 1.0, len(middles)) * case.shift_m / CELL_M
    cells = np.stack(np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"), axis=-1)
    part = ((cells[:, :, None] - middles) ** 2).sum(axis=-1).argmin(axis=-1)
    at = [
        cells[..., k] + ndimage.gaussian_filter((off * turn(angle))[part], 0.25 / CELL_M)
        for k, turn in enumerate((np.cos, np.sin))
    ]
    drawn = ndimage.map_coordinates(walls.astype(np.float64), at, order=1, mode="nearest") > 0.5
    if case.inflated:
        drawn = ndimage.binary_dilation(drawn, iterations=case.inflated)
    occupancy = drawn.astype(np.float64)
    if case.blur_m:
        occupancy = ndimage.gaussian_filter(occupancy, case.blur_m / CELL_M)
        occupancy = np.minimum(1.0, occupancy / max(0.5, float(occupancy.max())) * 1.3)
    rooms, _ = ndimage.label(~walls)
    inside = (rooms > 0) & (rooms != rooms[0, 0])
    known = ndimage.binary_dilation(inside, iterations=4)
    for x, y in rng.uniform(0, 1, (int(nx * ny * CELL_M**2 / 200), 2)) * (nx, ny):
        known &= ((cells - (x, y)) ** 2).sum(axis=-1) > (rng.uniform(0.3, 1.0) / CELL_M) ** 2
    return np.where(known, occupancy, np.nan)


def with_people(
    scans: bm.Scans, free: NDArray[np.bool_], grid: bm.Grid, case: Case, rng: np.random.Generator
) -> bm.Scans:
    """The scans with people before the walls: legs of 8 cm, who come, stand or walk along, and go."""
    readings = scans.ranges_m.copy()
    people = np.empty((0, 2))
    for k, (x, y, yaw) in enumerate(scans.poses):
        near = np.hypot(*(people - (x, y)).T) < 6.0
        people = people[near & (rng.random(len(people)) > 0.1 * case.step_m / 0.25)]
        while len(people) < case.people and rng.random() < 0.8:
            way = rng.uniform(-np.pi, np.pi)
            spot = np.array([x, y]) + rng.uniform(0.7, 4.0) * np.array([np.cos(way), np.sin(way)])
            people = np.concatenate([people, spot[None]])
        walked = people + rng.normal(size=people.shape) * 0.1
        cell = grid.to_cells(walked).astype(int)
        stands = (cell >= 0).all(axis=1) & (cell < free.shape).all(axis=1)
        stands[stands] = free[tuple(cell[stands].T)]
        people = np.where(stands[:, None], walked, people)
        cells = np.clip(grid.to_cells(people).astype(int), 0, np.array(free.shape) - 1)
        people = people[free[tuple(cells.T)] & (np.hypot(*(people - (x, y)).T) > 0.5)]
        for person in people:
            facing = rng.uniform(-np.pi, np.pi)
            for side in (-0.14, 0.14):
                leg = person + side * np.array([np.cos(facing), np.sin(facing)]) - (x, y)
                away = np.hypot(*leg)
                beam = scans.angles_rad + yaw - np.arctan2(leg[1], leg[0])
                across = away * np.sin(beam)
                met = (np.abs(across) < 0.08) & (np.cos(beam) > 0)
                depth = away * np.cos(beam) - np.sqrt(np.maximum(0.08**2 - across**2, 0.0))
                nearer = met & ((readings[k] > depth) | np.isinf(readings[k]))
                readings[k, nearer] = np.maximum(0.05, depth[nearer] + rng.normal(size=nearer.sum()) * 0.01)
    return bm.Scans(scans.poses, scans.angles_rad, readings, max_range_m=scans.max_range_m)


def simulated(case: Case, most: int) -> tuple[Floats, bm.Grid, bm.Scans, Floats]:
    """The map as read from its files, its grid, the scans at odometry's poses, and the true poses."""
    rng = np.random.default_rng([case.seed, 1])
    truth = bm.worlds.building(case.seed, case.size_m, CELL_M, clutter=case.clutter)
    bare = bm.worlds.building(case.seed, case.size_m, CELL_M, clutter=0.0)
    route = bm.worlds.patrol(truth, 2000, case.seed)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(route[:, :2], axis=0).T))])
    count = min(most, int(way[-1] / case.step_m))
    begin = rng.uniform(0.0, way[-1] - count * case.step_m)
    route = route[np.searchsorted(way, begin + np.arange(count) * case.step_m)]
    angles = np.radians(
        -0.5 * case.field_deg + np.arange(case.beams) * case.field_deg / (case.beams - (case.field_deg < 360))
    )
    laser = bm.BeamMixture(bm.Gaussian(0.015), p_random=0.005, p_no_return=0.01, p_short=0.001)
    scans = bm.simulate(truth.walls, truth.grid, route, angles, sensor=laser, max_range_m=case.reach_m, typed=True,
                        seed=case.seed, opacity=truth.opacity)  # fmt: skip
    scans = with_people(scans, ~truth.walls, truth.grid, case, rng)
    moved = scans.at(bm.simulate_odometry(route, seed=case.seed))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "map.yaml"
        write_map(path, wrong_map(bare.walls, case, rng), truth.grid, mode=case.mode)
        occupancy, grid = read_map(path)
    return occupancy, grid, moved, route


def kept(belief: PoseBelief, truth: Floats) -> dict[str, Any]:
    """What is kept of an answer: whether right, how far off, how sure, and places with whether they are right."""
    error = belief.mean - truth
    error[2] = wrap_angle(error[2])
    return {
        "right": is_right(belief.mean, truth),
        "off_m": float(np.hypot(error[0], error[1])),
        "square": float(error @ np.linalg.solve(belief.covariance, error)),
        "lost": belief.p_lost,
        "modes": [((1.0 - belief.p_lost) * mode.probability, is_right(mode.mean, truth)) for mode in belief.modes[:12]],
    }


def answers(known: KnownMap, moved: bm.Scans, route: Floats, seed: int) -> dict[str, list[dict[str, Any]]]:
    """Along the log from anywhere, after ten scans from anywhere, and of single scans."""
    along = [kept(b, pose) for b, pose in zip(follow(known, moved, seed=seed), route, strict=True)]
    ten = []
    for begin in range(0, len(route) - ENDS + 1, 2 * ENDS):
        last = localize(known, moved.select(slice(begin, begin + ENDS)), seed=seed).last
        ten.append(kept(last, route[begin + ENDS - 1]))
    single = localize(known, moved.select(slice(None, None, 5)), independent=True, seed=seed).beliefs
    return {"along": along, "ten": ten, "one": [kept(b, pose) for b, pose in zip(single, route[::5], strict=True)]}


def asked(seed: int, laws: tuple[str, ...], scans: int, target: Path) -> None:
    """Write all answers in one building, under the fitted law and perhaps others."""
    case = case_of(seed)
    occupancy, grid, moved, route = simulated(case, scans)
    found: dict[str, Any] = {"case": asdict(case), "scans": len(route)}
    for name in laws:
        begin = time.process_time()
        if name == "fitted":
            law = fit_law(occupancy, grid, moved, seed)
        else:
            law = MapLaw(ASSUMED) if name == "assumed" else MapLaw(ASSUMED, Trust())
        fitting_s = time.process_time() - begin
        known = external_map(occupancy, grid, moved, law)
        found[name] = answers(known, moved, route, seed) | {"words": law.words(), "fitting_s": fitting_s}
        found[name]["law"] = {k: float(v) for k, v in law.values.items()} | asdict(law.trust)
        found[name]["fit"] = None if law.reference_fit is None else asdict(law.reference_fit)
        found[name]["seconds"] = time.process_time() - begin
    target.write_text(json.dumps(found))


def summary(found: list[dict[str, Any]], law: str) -> str:
    """The tables of docs/lab/localization.md."""
    lines = [f"{len(found)} buildings, {law} law"]
    for name in ("one", "ten", "along"):
        one = [answer for f in found for answer in f[law][name]]
        right = np.array([a["right"] for a in one])
        says = np.array([a["modes"][0][0] if a["modes"] else 0.0 for a in one])
        lost = np.array([a["lost"] for a in one])
        off = np.array([a["off_m"] for a in one])[right]
        squares = np.array([a["square"] for a in one])[right]
        wrong = ~right & (says > SURE) & (lost < NOT_LOST)
        lines.append(
            f"{name}: {len(one)} asked, right {100 * right.mean():.1f} %, says {100 * says.mean():.1f} %, "
            f"sure {100 * (says > SURE).mean():.1f} %, sure and wrong {100 * wrong.mean():.2f} %, "
            f"lost {100 * (lost > 0.5).mean():.1f} %, off {np.median(off):.3f} m, "
            f"squared error mean {squares.mean():.1f}, median {np.median(squares):.1f}"
        )
        modes = np.array([mode for a in one for mode in a["modes"]], dtype=np.float64)
        for least, most in pairwise(LEVELS):
            own = modes[(modes[:, 0] >= least) & (modes[:, 0] < most)]
            if len(own):
                told, is_so = 100 * own.mean(axis=0)
                lines.append(f"  {least} to {min(1.0, most)} | {len(own)} | {told:.0f} % | {is_so:.0f} %")
    return "\n".join(lines)


def main() -> None:
    """Ask in the buildings that the folder lacks, and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("buildings", nargs="?", default="0:30", help="FIRST:LAST")
    parser.add_argument("--laws", default="fitted", help="of fitted, assumed, own (as maps of our own are trusted)")
    parser.add_argument("--scans", type=int, default=100, help="of each building, at most")
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    first, last = map(int, options.buildings.split(":"))
    laws = tuple(options.laws.split(","))
    options.folder.mkdir(parents=True, exist_ok=True)
    left = [k for k in range(first, last) if not (options.folder / f"{k}.json").exists()]
    with ProcessPoolExecutor(options.workers, mp_context=get_context("spawn")) as pool:
        tasks = [pool.submit(asked, k, laws, options.scans, options.folder / f"{k}.json") for k in left]
    for task in tasks:
        task.result()
    found = [json.loads((options.folder / f"{k}.json").read_text()) for k in range(first, last)]
    for law in laws:
        print(summary(found, law), flush=True)


if __name__ == "__main__":
    main()
