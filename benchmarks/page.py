"""How fast the page answers, measured in headless Chromium against a real server: `python -m benchmarks.page`.

Prints one line a figure. Nothing is asserted; a noisy machine gives noisy figures, so each says how it was taken.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.page_hand import EVENTS_PER_SECOND, by_hand
from benchmarks.processor import processor_ms

CHROMIUM = shutil.which("chromium-headless-shell") or shutil.which("chromium")
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update"]

SETTLED_MS = 2000
"""A new window loads scripts of the browser's own for so long, on the cores that are to paint the page."""

SHARES = ("worker", "server", "page", "browser")

DRAG = by_hand(
    """
    const s = bayesmap.snapshot();
    const at = placeOf([s.sensors[0].x, s.sensors[0].y]);
    const reach = 1.5 * s.transform.scale * Math.max(1, s.document.grid.shape[0] / 60);
    const generations = new Set();
    point("pointerdown", at);
    const found = await steadily(given[0], given[1],
      (t) => point("pointermove", { x: at.x + reach * Math.sin(2 * t), y: at.y + reach * Math.sin(3 * t) / 2 }),
      () => generations.add(bayesmap.snapshot().painted.generation));
    point("pointerup", at);
    const painted = generations.size - 1;
    await new Promise((done) => setTimeout(done, 600));
    return { ...found, painted, times: [...bayesmap.snapshot().events.eventToPaint_ms] };
    """
)


@contextlib.contextmanager
def served(*arguments: str) -> Iterator[str]:
    command = [sys.executable, "-m", "bayesmap", "app", "--no-browser", "--port", "0", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        try:
            assert process.stdout is not None
            yield process.stdout.readline().strip()
        finally:
            process.terminate()


def until(page: Any, condition: str) -> None:
    while not page.evaluate(f"() => {{ const s = window.bayesmap?.snapshot(); return Boolean(s && ({condition})); }}"):
        page.wait_for_timeout(5)


def timed(page: Any, click: str, condition: str) -> float:
    """Milliseconds in the page from a click on a button to the frame in which a condition holds."""
    return float(
        page.evaluate(
            f"""() => new Promise((done) => {{
              const root = document.querySelector("[data-bayesmap]").shadowRoot;
              const button = [...root.querySelectorAll("button")].find((b) => b.textContent === "{click}");
              const start = performance.now();
              const look = () => {{
                const s = bayesmap.snapshot();
                if ({condition}) done(performance.now() - start);
                else requestAnimationFrame(look);
              }};
              button.click();
              look();
            }})"""
        )
    )


def report(name: str, value: str) -> None:
    print(f"{name:<58} {value}", flush=True)


def spread(values: Any) -> str:
    found = np.asarray(values)
    if found.size == 0:
        return "none"
    return f"median {np.median(found):.0f} ms, p95 {np.percentile(found, 95):.0f} ms, worst {found.max():.0f} ms"


def first_paint(browser: Any, url: str) -> None:
    times = []
    for _ in range(5):
        context = browser.new_context(viewport={"width": 1280, "height": 860})
        page = context.new_page()
        page.add_init_script(
            """const look = () => { if (window.bayesmap?.snapshot().painted) window.first = performance.now();
               else requestAnimationFrame(look); }; look();"""
        )
        page.wait_for_timeout(SETTLED_MS)
        page.goto(url)
        until(page, "window.first")
        times.append(page.evaluate("window.first"))
        context.close()
    report("first posterior painted, from navigation (5 times)", spread(times))


def drag(page: Any, seconds: float, name: str) -> None:
    """Drags the robot to and fro about where it stands, at 30 pointer events a second of the page's own clock."""
    until(page, "s.painted?.generation === s.generation")
    page.evaluate("bayesmap.snapshot().events.eventToPaint_ms.length = 0")
    before = processor_ms()
    found = page.evaluate(DRAG, [seconds, EVENTS_PER_SECOND])
    used = processor_ms() - before
    painted, sent = found["painted"] / found["seconds"], found["sent"] / found["seconds"]
    rate = f"{painted:.1f} posteriors/s painted of {sent:.1f} events/s"
    report(f"{name}: drag for {seconds:.0f} s", rate)
    report(f"{name}: event to paint", f"{spread(found['times'])} ({len(found['times'])} events)")
    shares = ", ".join(f"{part} {used[part] / max(1, found['painted']):.0f} ms" for part in SHARES)
    report(f"{name}: processor time a picture", shares)


def figure(browser: Any, seconds: float) -> None:
    """Drags the robot in a figure that samples without a server."""
    from bayesmap.app.edits import tutorial_document
    from bayesmap.app.figures import figure_page

    page = browser.new_page(viewport={"width": 1280, "height": 860})
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "figure.html")
        file.write_text(figure_page(tutorial_document()), encoding="utf-8")
        page.goto(file.as_uri())
        until(page, "s.painted?.sweeps === 1000")
    drag(page, seconds, "figure without a server, 21 x 21, 100 beams")
    page.close()


def new_building(page: Any, width: int, height: int) -> None:
    page.get_by_role("button", name="New map").click()
    page.get_by_label("World").select_option("building")
    page.get_by_role("spinbutton", name="Width").fill(str(width))
    page.get_by_role("spinbutton", name="Height").fill(str(height))
    page.get_by_role("button", name="Create").click()
    until(page, f"s.document.grid.shape[0] === {width} && s.painted?.generation === s.generation")
    page.wait_for_timeout(1500)


def many_beams(page: Any, sensors: int, angles: int) -> None:
    """Sensors and beams on the map that there is."""
    for count in range(page.evaluate("bayesmap.snapshot().sensors.length") + 1, sensors + 1):
        page.get_by_role("button", name="Add a sensor").click()
        until(page, f"s.sensors.length === {count} && s.seq.confirmed === s.seq.sent")
    page.get_by_role("spinbutton", name="Angles").fill(str(angles))
    page.get_by_role("spinbutton", name="Angles").press("Tab")
    until(page, f"s.document.angles === {angles} && s.seq.confirmed === s.seq.sent")
    page.wait_for_timeout(1500)


def export_size(page: Any) -> None:
    timed(page, "Run", "!s.running && s.draws.count === 1000 && s.seq.confirmed === s.seq.sent")
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as waiting, tempfile.TemporaryDirectory() as folder:
        page.get_by_role("button", name="Page with its draws").click()
        file = Path(folder, "page.html")
        waiting.value.save_as(file)
        counts = re.search(r'"draws": ?\{[^}]*?"chains": ?(\d+)[^}]*?"count": ?(\d+)', file.read_text())
        draws = "" if counts is None else f" with {int(counts[1]) * int(counts[2])} draws"
        report(f"exported page{draws}", f"{file.stat().st_size / 1000:.0f} kB")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=6.0, help="of every drag")
    options = parser.parse_args()
    from playwright.sync_api import sync_playwright

    report("load average before", " ".join(f"{load:.1f}" for load in os.getloadavg()) + f" on {os.cpu_count()} cores")
    with served() as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        first_paint(browser, url)
        figure(browser, options.seconds)
        page = browser.new_page(viewport={"width": 1280, "height": 860})
        page.goto(url)
        until(page, "s.painted?.sweeps === 1000")
        drag(page, options.seconds, "21 x 21, 100 beams")
        page.wait_for_timeout(500)
        kept = (
            "s.generation === s.painted.generation && !s.running && s.painted.sweeps === 1000 && s.draws.count === 1000"
        )
        times = []
        for _ in range(7):
            before = page.evaluate("bayesmap.snapshot().generation")
            times += [timed(page, "Run", f"{kept} && s.generation > {before}")]
        report("1000 Gibbs sweeps, two chains: click to last picture", spread(times))
        export_size(page)
        new_building(page, 120, 80)
        many_beams(page, 8, 1000)
        drag(page, options.seconds, "120 x 80, 8 x 1000 beams")
        many_beams(page, 8, 100)
        new_building(page, 500, 500)
        drag(page, options.seconds, "500 x 500, 100 beams")
        page.get_by_role("spinbutton", name="Sweeps").fill("100000")
        page.get_by_role("spinbutton", name="Sweeps").press("Tab")
        times = []
        for _ in range(5):
            page.get_by_role("button", name="Run", exact=True).click()
            until(page, "s.running && s.painted.generation === s.generation && s.painted.sweeps > 0")
            times.append(timed(page, "Cancel", "!s.running"))
        report("500 x 500: cancel, click to the kept chain", spread(times))
        from benchmarks.page_building import building

        building(browser, options.seconds)
        browser.close()
    time.sleep(0.1)


if __name__ == "__main__":
    main()
