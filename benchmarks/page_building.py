"""The page on a real building: the ghost, the scrubber, and how soon a log shows its posterior.

`python -m benchmarks.page_building`, or as a part of `python -m benchmarks.page`. The log is that of the Intel Research
Lab, where `$BAYESMAP_DATA` has it.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import bayesmap as bm
from benchmarks.page import ARGUMENTS, CHROMIUM, report, served, spread, until
from benchmarks.page_hand import EVENTS_PER_SECOND, by_hand

LOG = Path(os.environ.get("BAYESMAP_DATA", Path(__file__).parents[2] / "shared" / "data"), "intel-corrected.log.gz")
MAX_RANGE_M = 20.0
SCREEN = {"width": 1280, "height": 860}

DRAG = by_hand(
    """
    const [seconds, rate, path] = given;
    // a fan shows where the ghost was when it was asked for: how long ago was that, when it is painted?
    const moved = new Map(), painted = [];
    let last = 0;
    point("pointerdown", placeOf(path[0]));
    const found = await steadily(seconds, rate,
      (t, sent) => {
        point("pointermove", placeOf(path[sent % path.length]));
        const { pose } = bayesmap.snapshot().ghost;
        moved.set(`${pose.x} ${pose.y}`, performance.now());
      },
      () => {
        const { fan, answers } = bayesmap.snapshot().ghost;
        if (answers === last || !fan) return;
        last = answers;
        const when = moved.get(`${fan.x} ${fan.y}`);
        if (when !== undefined) painted.push(performance.now() - when);
      });
    point("pointerup", placeOf(path[found.sent % path.length]));
    return { ...found, painted };
    """
)

FRAMES = """([click, seconds]) => new Promise((done) => {
  const root = document.querySelector("[data-bayesmap]").shadowRoot;
  const before = bayesmap.snapshot().generation;
  const start = performance.now();
  const frames = [];
  let last = bayesmap.snapshot().events.paints;
  const look = () => {
    const s = bayesmap.snapshot();
    const now = performance.now() - start;
    if (s.painted.generation > before && s.events.paints !== last) {
      frames.push([now, s.painted.method]);
      last = s.events.paints;
    }
    if (now > 1000 * seconds) done(frames);
    else requestAnimationFrame(look);
  };
  [...root.querySelectorAll("button")].find((b) => b.textContent === click).click();
  look();
})"""

SCRUB = by_hand(
    """
    const slider = root.querySelector("input[aria-label='Scans used']");
    const generations = new Set();
    const found = await steadily(given[0], given[1],
      (t) => {
        slider.value = Math.round(Number(slider.max) * (0.5 + 0.4 * Math.sin(t)));
        slider.dispatchEvent(new Event("input"));
      },
      () => {
        const { generation, method } = bayesmap.snapshot().painted;
        if (method === "hits") generations.add(generation);
      });
    slider.dispatchEvent(new Event("change"));
    return { ...found, painted: generations.size };
    """
)


def ghost(browser: Any, seconds: float) -> None:
    """Drags the ghost along the robot's own way through a run of surfaces."""
    scans = bm.read_log(str(LOG), max_range_m=MAX_RANGE_M)
    run = bm.infer(
        scans,
        bm.Grid.covering(scans, 0.1),
        prior=bm.Surface(),
        sensor="fit",
        schedule=bm.Schedule(chains=2, warmup=10, draws=16),
    )
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "run.nc")
        run.save(path)
        with served(path) as url:
            page = browser.new_page(viewport=SCREEN)
            page.goto(url)
            until(page, "s.painted?.generation === s.generation")
            page.get_by_role("radio", name="Ghost").check(force=True)
            until(page, "s.ghost.fan")
            way = scans.poses[200:320, :2]
            steps = np.linspace(0, len(way) - 1, int(2 * seconds * EVENTS_PER_SECOND))
            fine = [[float(np.interp(t, np.arange(len(way)), way[:, axis])) for axis in (0, 1)] for t in steps]
            found = page.evaluate(DRAG, [seconds, EVENTS_PER_SECOND, fine])
            fans, sent = len(found["painted"]) / found["seconds"], found["sent"] / found["seconds"]
            report("Intel, 10 cm, surfaces: ghost dragged", f"{fans:.1f} fans/s painted of {sent:.1f} events/s")
            report("Intel, 10 cm: ghost, event to paint", spread(found["painted"]))
            page.close()


def log(browser: Any, seconds: float) -> None:
    """Drags along the log, and presses Run on cells of 20 cm, walls and surfaces."""
    with served(str(LOG)) as url:
        page = browser.new_page(viewport=SCREEN)
        page.goto(url)
        until(page, "s.painted?.generation === s.generation")
        found = page.evaluate(SCRUB, [seconds, EVENTS_PER_SECOND])
        maps, sent = found["painted"] / found["seconds"], found["sent"] / found["seconds"]
        report("Intel, 10 cm: dragging along the log", f"{maps:.1f} maps/s painted of {sent:.1f} events/s")
        page.get_by_role("checkbox", name="Live").uncheck()
        page.get_by_role("combobox", name="Cell size").select_option("0.2")
        for cells in ("binary", "surface"):
            page.get_by_role("combobox", name="Cells").select_option(cells)
            until(page, "s.painted.generation === s.generation && s.seq.sent === s.seq.confirmed")
            page.wait_for_timeout(3000)
            frames = page.evaluate(FRAMES, ["Run", 4 * seconds])
            times = np.array([t for t, _ in frames])
            first: dict[str, float] = {}
            for t, method in frames:
                first.setdefault(method, t)
            said = ", ".join(f"{method} {t / 1000:.2f} s" for method, t in first.items())
            report(f"Intel, 20 cm, {cells}: Run to first picture", said)
            gaps = np.diff(times)
            gap = f"{len(times) / (times[-1] - times[0]) * 1000:.1f} pictures/s, longest wait {gaps.max() / 1000:.2f} s"
            report(f"Intel, 20 cm, {cells}: refreshed", gap)
            if (cancel := page.get_by_role("button", name="Cancel")).is_enabled():
                cancel.click()
        page.close()


def building(browser: Any, seconds: float) -> None:
    """All figures, where the log is there."""
    if not LOG.exists():
        report("a real building", f"skipped: {LOG.name} is not there")
        return
    ghost(browser, seconds)
    log(browser, seconds)


def main() -> None:
    from playwright.sync_api import sync_playwright

    report("load average before", " ".join(f"{load:.1f}" for load in os.getloadavg()) + f" on {os.cpu_count()} cores")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        building(browser, 6.0)
        browser.close()


if __name__ == "__main__":
    main()
