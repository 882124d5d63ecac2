"""What a Ray cluster costs beside threads, for docs/lab/maps.md: ``python -m benchmarks.cluster [LOG]``.

The same chains on the threads of this process and on a Ray cluster that it starts, with as many CPUs as the machine
has, in turn; the fastest repeats count. Also how large the things are that travel: the model, what the sampler prepares
of it, a draw, where a chain stands, and what is computed at a checkpoint.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

import bayesmap as bm
from bayesmap.kernels.device import available_cores
from bayesmap.run import ray_executor

CHAINS, REPEATS = 4, 3


def jobs(log: str | None) -> Iterator[tuple[str, dict[str, Any]]]:
    """Names and arguments of `bm.infer`, from a second of work to minutes."""
    walls, pose = bm.worlds.tutorial()
    grid, noise = bm.worlds.TUTORIAL_GRID, bm.Gaussian(0.2)
    angles = np.linspace(0, 2 * np.pi, 100, endpoint=False)
    scans = bm.simulate(walls, grid, pose, angles, sensor=noise, max_range_m=42.0, seed=0)
    yield "tutorial, walls", {
        "scans": scans, "grid": grid, "prior": bm.Independent(0.5), "sensor": noise,
        "schedule": bm.Schedule(CHAINS, 5000, 5000, 5),
    }  # fmt: skip
    if log is None:
        return
    scans = bm.read_log(log)
    mixture = bm.BeamMixture(bm.Gaussian(0.03))
    for name, some, sweeps in (("a tenth of Intel", scans.select(slice(0, None, 10)), 20), ("Intel", scans, 8)):
        grid = bm.Grid.covering(scans, 0.1)
        options = {"scans": some, "grid": grid, "sensor": mixture, "hit_depth": 0.5}
        short, long = bm.Schedule(CHAINS, sweeps, sweeps), bm.Schedule(CHAINS, 50, 50)
        zeros = bm.Gibbs(start="zeros")
        yield f"{name}, surfaces", {**options, "prior": bm.Surface(), "schedule": short}
        yield f"{name}, walls", {**options, "prior": bm.Independent(0.2), "schedule": long, "method": zeros}


def size_of(ray: Any, thing: Any) -> float:
    """Megabytes of something in the object store."""
    context = ray._private.worker.global_worker.get_serialization_context()
    return context.serialize(thing).total_bytes / 1e6


class Spy:
    """What the process that is started gives to workers and gets back, in megabytes."""

    def __init__(self, ray: Any) -> None:
        self.ray, self.sizes = ray, {}
        share, note, remote = (getattr(ray_executor._RayRun, name) for name in ("_share", "_note", "remote"))
        spy = self

        def spied_share(run: Any) -> None:
            share(run)
            spy.sizes["model"] = size_of(ray, ray.get(run.shared[0]))
            spy.sizes["problem"] = size_of(ray, ray.get(run.shared[1][0]))

        def spied_note(run: Any, group: Any, segment: Any) -> None:
            chains = len(group.chain_ids)
            spy.sizes["where a chain stands"] = size_of(ray, segment.snapshot) / chains
            if segment.draws.count > 1:
                spy.sizes["draw"] = sum(a.nbytes for a in segment.draws.arrays.values()) / segment.draws.size / 1e6
            note(run, group, segment)

        def spied_remote(run: Any, function: Any, **options: Any) -> Any:
            submit = remote(run, function, **options)
            if function is not ray_executor.observed_counts:
                return submit

            def spied(*given: Any) -> Any:
                spy.sizes["checkpoint, there, a chain"] = (size_of(ray, given[-1]) + size_of(ray, given[-2])) / len(
                    given[-3]
                )
                ref = submit(*given)
                spy.sizes["checkpoint, back, a group"] = size_of(ray, ray.get(ref))
                return ref

            return spied

        for name, function in (("_share", spied_share), ("_note", spied_note), ("remote", spied_remote)):
            setattr(ray_executor._RayRun, name, function)


def main(arguments: list[str]) -> None:
    """Measure, and print a line a job."""
    import ray

    log = arguments[0] if arguments else None
    os.environ["RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO"] = "0"
    began = time.perf_counter()
    ray.init(num_cpus=available_cores(), include_dashboard=False, logging_level="ERROR", log_to_driver=False)
    print(f"cluster of {available_cores()} CPUs up after {time.perf_counter() - began:.1f} s", flush=True)
    plain = {name: getattr(ray_executor._RayRun, name) for name in ("_share", "_note", "remote")}
    for name, options in jobs(log):
        spy = Spy(ray)
        bm.infer(**options, where=bm.Where(executor=bm.RayExecutor()))
        for attribute, function in plain.items():
            setattr(ray_executor._RayRun, attribute, function)
        executors = {"threads": None, "ray": bm.RayExecutor()}
        seconds: dict[str, list[float]] = {where: [] for where in executors}
        for _ in range(REPEATS):
            for where, executor in executors.items():
                began = time.perf_counter()
                bm.infer(**options, where=bm.Where(executor=executor))
                seconds[where].append(time.perf_counter() - began)
        threads, on_ray = min(seconds["threads"]), min(seconds["ray"])
        print(f"{name}: threads {threads:.2f} s, Ray {on_ray:.2f} s, {(on_ray - threads) / CHAINS:+.2f} s a chain")
        print(f"  all: { {k: [round(s, 2) for s in v] for k, v in seconds.items()} }")
        print("  MB: " + ", ".join(f"{what} {size:.3f}" for what, size in spy.sizes.items()), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
