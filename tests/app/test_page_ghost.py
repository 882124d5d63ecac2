"""The ghost on the page: dragged, turned, moved by keys; its fan is the library's, and a real scan lies beside it."""

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import ANGLES
from page_driver import settled, snapshot, until
from page_hands import choose, enter, press, press_and_drag

from bayesmap.posterior.predictor import ScanPredictor, predictor_of
from bayesmap.sensors.model import RangeLimits

READ = """() => {
  const f = bayesmap.snapshot().ghost.fan;
  const texts = (a) => [...a].map(String);
  return {...f, low: texts(f.low), median: texts(f.median), high: texts(f.high), angles: [...f.angles],
          near: f.near && f.near.index};
}"""
HERE = "s.ghost.fan && !s.ghost.fan.coarse && ['x', 'y', 'yaw'].every((k) => s.ghost.fan[k] === s.ghost.pose[k])"


def fan(page):
    until(page, HERE)
    found = page.evaluate(READ)
    for name in ("low", "median", "high"):
        found[name] = np.array([float(v.replace("Infinity", "inf")) for v in found[name]])
    return found


def test_a_dragged_ghost_shows_the_library_s_prediction(open_page, room):
    run, address = room
    page = open_page(address)
    choose(page, "Ghost")
    until(page, HERE)  # where the scan on show was taken
    playwright.expect(page.locator(".ghosted")).to_contain_text("hits of scan 1, taken 0 cm from here")
    playwright.expect(page.locator(".ghosted")).to_contain_text("by 20 draws")
    press_and_drag(page, [(5, 10), (9, 12), (12, 14)], steps=6)
    found, scans = fan(page), run.posterior.scans
    pose = [found["x"], found["y"], found["yaw"]]
    # taken hold of where it stood, it moved as far as the hand: 7 and 4 cells
    assert pose[:2] == pytest.approx(scans.poses[0, :2] + [1.4, 0.8], abs=0.02)
    law = ScanPredictor.of(predictor_of(run.posterior), RangeLimits(scans.min_range_m, scans.max_range_m))
    expected = law.quantiles(pose, ANGLES)
    for i, name in enumerate(("low", "median", "high")):
        np.testing.assert_allclose(found[name], expected[:, i], atol=2e-3)
    assert snapshot(page)["seq"]["sent"] == snapshot(page)["seq"]["confirmed"]  # it changes nothing
    assert not snapshot(page)["sensors"]


@pytest.mark.full
def test_it_follows_a_live_posterior_and_says_where_there_is_none(page):
    settled(page)
    choose(page, "Ghost")
    assert fan(page)["draws"] == 32
    generation = snapshot(page)["generation"]
    enter(page, "Seed", 7)
    until(page, "s.ghost.fan.generation > argument && s.ghost.fan.draws > 0", generation)
    press(page, "Clear inference")
    until(page, "s.painted.method === 'none' && s.painted.generation === s.generation")
    until(page, "s.ghost.trouble")
    playwright.expect(page.locator(".ghosted")).to_contain_text("run inference first")
