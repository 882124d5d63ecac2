"""Makes the pictures of the live page: `python -m docs.page_images` from the repository's root; it needs Chromium.

A hand draws a wall and drags the robot about the tutorial's map; every frame is a screenshot of the real page.
"""

import io
from itertools import pairwise
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

from benchmarks.page import ARGUMENTS, CHROMIUM, served

IMAGES = Path(__file__).with_name("images")
SIZE = {"width": 1200, "height": 760}
SHOWN = (960, 608)
FRAME_MS = 90

WALL = [(4, 5), (5, 5), (6, 5), (7, 5), (8, 5), (8, 6), (8, 7), (8, 8)]
WALK = [
    (10, 10),
    (10.6, 11.2),
    (11, 12.6),
    (10.6, 14),
    (9.6, 15),
    (8.4, 14.4),
    (7.4, 13),
    (6.6, 11.4),
    (6, 9.6),
    (5.4, 8),
]
WALK += [(4.6, 7), (5.2, 8.4), (6.4, 9.6), (8, 10), (10, 10)]


def between(points: list[tuple[float, float]], parts: int) -> list[tuple[float, float]]:
    """The points, and as many between each two as make so many parts."""
    path = [points[0]]
    for (x0, y0), (x1, y1) in pairwise(points):
        path += [(x0 + (x1 - x0) * k / parts, y0 + (y1 - y0) * k / parts) for k in range(1, parts + 1)]
    return path


class Camera:
    """Takes pictures of a page."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.frames: list[Image.Image] = []

    def picture(self) -> Image.Image:
        """What the page shows now."""
        return Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")

    def keep(self, times: int = 1) -> None:
        """Add frames of the film."""
        for _ in range(times):
            self.page.wait_for_timeout(30)
            self.frames.append(self.picture().resize(SHOWN, Image.Resampling.LANCZOS))

    def settle(self) -> None:
        """Wait until the chain on show has done its sweeps."""
        done = "s.painted?.generation === s.generation && s.painted.sweeps >= s.document.sweeps && !s.running"
        while not self.page.evaluate(
            f"() => {{ const s = window.bayesmap?.snapshot(); return Boolean(s && {done}); }}"
        ):
            self.page.wait_for_timeout(20)
        self.page.wait_for_timeout(100)

    def at(self, cell: tuple[float, float]) -> tuple[float, float]:
        """A cell's place on the page."""
        point = self.page.evaluate("([x, y]) => bayesmap.cellToClient(x, y)", list(cell))
        return point["x"], point["y"]

    def drag(self, path: list[tuple[float, float]]) -> None:
        """Press at the first place, move through the others, a frame each."""
        self.page.mouse.move(*self.at(path[0]))
        self.page.mouse.down()
        for cell in path[1:]:
            self.page.mouse.move(*self.at(cell))
            self.keep()
        self.page.mouse.up()


def film(camera: Camera) -> None:
    """Draw, drag, run, look at the entropy."""
    page = camera.page
    camera.settle()
    camera.keep(6)
    page.get_by_role("radio", name="Draw", exact=True).check()
    camera.drag(between(WALL, 2))
    camera.settle()
    camera.keep(5)
    page.get_by_role("radio", name="Sensor").check()
    camera.drag(between(WALK, 5))
    camera.settle()
    camera.keep(5)
    page.get_by_role("radio", name="Entropy").check()
    page.wait_for_timeout(200)
    camera.keep(12)
    page.get_by_role("radio", name="Mean").check()
    page.wait_for_timeout(200)


def main() -> None:
    """Write the film and the two stills."""
    with served() as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        try:
            camera = Camera(browser.new_page(viewport=SIZE, color_scheme="light"))
            camera.page.goto(url)
            film(camera)
            first, *rest = camera.frames
            film_options = {"duration": FRAME_MS, "loop": 0, "quality": 60, "method": 6, "minimize_size": True}
            first.save(IMAGES / "app.webp", save_all=True, append_images=rest, **film_options)
            for scheme in ("light", "dark"):
                still = Camera(browser.new_page(viewport=SIZE, color_scheme=scheme))
                still.page.goto(url)
                still.settle()
                still.picture().save(IMAGES / f"app-{scheme}.webp", lossless=True, method=6)
        finally:
            browser.close()


if __name__ == "__main__":
    main()
