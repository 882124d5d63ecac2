"""The page answers about a place: a path, the next view, a virtual scan, where the robot is, beams of a cell."""

import re

import numpy as np
import playwright.sync_api as playwright
import pytest
from building_log import ANGLES
from page_driver import centre, colour_at, document, propagated, settled, snapshot, until
from page_hands import act, choose, click, press_and_drag

from bayesmap.app.answers.evidence import strongest_beams, sum_evidence, wall_ratios
from bayesmap.app.protocol.notices import CellFacts
from bayesmap.posterior.prediction import ScanPredictor, predictor_of
from bayesmap.sensors.model import RangeLimits

BLUE, ORANGE = (0, 114, 178), (213, 94, 0)
VIEWS = "() => { const v = bayesmap.snapshot().decisions.views; return {pose: [...v.pose], nats: [...v.nats]}; }"
HERE = "s.ghost.fan && !s.ghost.fan.coarse && ['x', 'y', 'yaw'].every((k) => s.ghost.fan[k] === s.ghost.pose[k])"


def test_two_clicks_give_a_path_and_its_probability(page):
    settled(page)
    choose(page, "Path")
    said = page.locator(".said")
    playwright.expect(said).to_contain_text("Click where the robot is")
    click(page, 6, 15)
    playwright.expect(said).to_contain_text("where it is to go")
    click(page, 10, 14)
    until(page, "s.decisions.path || s.decisions.trouble")
    path = snapshot(page)["decisions"]["path"]
    assert path["path"][0] == pytest.approx([6, 15], abs=0.5)
    assert path["path"][-1] == pytest.approx([10, 14], abs=0.5)
    assert path["probability"] == 1
    playwright.expect(said).to_contain_text(f"free in all {path['draws']} draws")
    assert "Independent cells" in said.inner_text()
    before = snapshot(page)["layers"]["decisions"]
    click(page, 3, 3)  # the start of another
    until(page, "!s.decisions.path")
    until(page, "s.layers.decisions > argument", before)


def test_looking_where_most_is_to_be_learnt_closes_the_loop(page):
    """Look, infer, choose the next view, look again: the map is known better, and less is left to learn there."""
    choose(page, "Look next")
    before = settled(page)
    until(page, "s.decisions.views && s.decisions.views.nats.length > 5")
    playwright.expect(page.locator(".said")).to_contain_text(re.compile(r"\d\.\d nats"))
    views = page.evaluate(VIEWS)
    nats, pose = np.array(views["nats"]), np.reshape(views["pose"], (-1, 3))
    cells = np.round(pose[:, :2]).astype(int)
    best = next(i for i in np.argsort(-nats) if not before["walls"][tuple(cells[i])])
    act(page, lambda: click(page, *cells[best].tolist()))
    after = settled(page)
    new = after["sensors"][-1]
    assert len(after["sensors"]) == len(before["sensors"]) + 1
    assert [new["x"], new["y"]] == pytest.approx(pose[best, :2].tolist(), abs=1e-3)
    assert after["observed"].sum() > before["observed"].sum()
    until(page, "s.decisions.views && Math.max(...s.decisions.views.nats) !== argument", float(nats.max()))


def test_a_dragged_ghost_shows_the_library_s_prediction(open_page, room):
    run, address = room
    page = open_page(address)
    choose(page, "Ghost")
    until(page, HERE)  # where the scan on show was taken
    playwright.expect(page.locator(".ghosted")).to_contain_text("hits of scan 1, taken 0 cm from here")
    playwright.expect(page.locator(".ghosted")).to_contain_text("by 20 draws")
    press_and_drag(page, [(5, 10), (9, 12), (12, 14)], steps=6)
    until(page, HERE)
    fan, scans = page.evaluate("probes.fan()"), run.posterior.scans
    pose = [fan["x"], fan["y"], fan["yaw"]]
    # taken hold of where it stood, it moved as far as the hand: 7 and 4 cells
    assert pose[:2] == pytest.approx(scans.poses[0, :2] + [1.4, 0.8], abs=0.02)
    law = ScanPredictor.of(predictor_of(run.posterior), RangeLimits(scans.min_range_m, scans.max_range_m))
    quantiles = [[float(value.replace("Infinity", "inf")) for value in values] for values in fan["quantiles"]]
    np.testing.assert_allclose(np.transpose(quantiles), law.quantiles(pose, ANGLES), atol=2e-3)
    assert snapshot(page)["seq"]["sent"] == snapshot(page)["seq"]["confirmed"]  # it changes nothing
    assert not snapshot(page)["sensors"]


def test_the_robot_of_the_tutorial_has_one_place(page):
    settled(page)
    choose(page, "Where am I?")
    until(page, "s.where.found && s.where.found.picture === s.generation")
    modes, points, weights = page.evaluate(
        "() => { const f = bayesmap.snapshot().where.found; return [f.modes, f.cloud.length, f.weight.length]; }"
    )
    robot = snapshot(page)["sensors"][0]
    assert np.hypot(modes[0]["mean"][0] - robot["x"], modes[0]["mean"][1] - robot["y"]) < 0.1
    assert (len(modes), points) == (1, 3 * weights)
    press_and_drag(page, [(10, 10), (3, 6)], steps=15)
    until(page, "s.where.found?.picture === s.generation && Math.abs(s.where.found.modes[0].mean[0] - 3) < 0.1")
    said = page.locator(".whereabouts")
    playwright.expect(said).to_contain_text("One place: ")
    playwright.expect(said).to_contain_text("The robot stands")
    choose(page, "Pan")
    until(page, "!s.where.found")


def test_the_beams_of_a_cell_are_counted_under_the_hand_and_drawn_where_it_clicks(open_page):
    asked = document(method="propagate")
    scene, preview = propagated(asked)
    p_wall = preview.mean()
    page = open_page(asked)
    settled(page)
    for label in ("True walls", "Readings"):
        page.get_by_role("checkbox", name=label).uncheck()
    choose(page, "Evidence")
    section, read_out = page.get_by_role("heading", name="Evidence of beams").locator(".."), page.locator(".readout")
    playwright.expect(section).to_contain_text("Click a cell")
    for is_wall, cells, own, other in ((True, p_wall > 0.9, BLUE, ORANGE), (False, p_wall < 0.1, ORANGE, BLUE)):
        sure = np.argwhere(preview.observed() & cells)
        x, y = sure[len(sure) // 2].tolist()
        ratios = wall_ratios(scene.problem.table, p_wall.ravel(), x * p_wall.shape[1] + y)
        known, expected = CellFacts(0, 0, True, **sum_evidence(ratios)), strongest_beams(ratios, scene.scans)
        assert (known.nats_for > known.nats_against) == is_wall
        page.mouse.move(*centre(page, x, y))
        for words in (f"Cell {x}, {y}", f"{known.beams} beam", f"for a wall {known.beams_for}, "):
            playwright.expect(read_out).to_contain_text(words)
        click(page, x, y)
        cell = "s.evidence.together.x === argument[0] && s.evidence.together.y === argument[1]"
        until(page, f"s.evidence.each && {cell}", [x, y])
        each = snapshot(page)["evidence"]["each"]
        for name, values in expected.items():
            np.testing.assert_allclose(np.ravel(each[name]), values.ravel(), atol=1e-6, err_msg=name)
        colour = colour_at(page, *(expected["start"][0] + 0.2 * (expected["end"][0] - expected["start"][0])).tolist())
        assert np.abs(colour - own).sum() < np.abs(colour - other).sum(), colour
        words = section.inner_text()
        assert f"For a wall (blue) {known.beams_for}, {known.nats_for:.1f} nats" in words
        assert f"against (orange) {known.beams_against}, {known.nats_against:.1f} nats" in words
        beam, scan = int(expected["beam"][0]), int(expected["scan"][0])
        assert f"beam {beam + 1} of sensor {scene.ids[scan]}" in words
    assert not page.locator(".stage > canvas.rays").is_visible()  # the other rays would hide them


def test_a_reading_is_told_along_its_beam_and_across_and_along_the_wall(open_page, room):
    run, address = room
    page = open_page(address)
    said, mark = page.locator(".words.reading"), page.locator("canvas.reading")
    playwright.expect(said).to_contain_text("Point at a reading")
    beam = int(np.argmin(np.abs(run.posterior.scans.poses[0, 2] + ANGLES + np.pi / 2)))
    end = page.evaluate("probes.beamEnd", beam)
    page.mouse.move(end["x"], end["y"])
    until(page, "s.reading.found && s.reading.picked.beam === argument", beam)
    told, words = snapshot(page)["reading"]["found"], said.inner_text()
    assert told["range"] == pytest.approx(run.posterior.scans.ranges_m[0, beam])
    assert f"Beam {beam + 1} of scan 1 read {told['range']:.2f} m" in words
    side = "shorter" if told["residual"] < 0 else "longer"
    assert f"{100 * abs(told['residual']):.1f} cm {side} than the predicted median" in words
    where = "behind" if told["wall"]["across_m"] < 0 else "in front of"
    assert f"{100 * abs(told['wall']['across_m']):.1f} cm {where} the wall" in words
    playwright.expect(mark).to_be_visible()  # it is marked on the map, and forgotten with the scan
    page.get_by_role("slider", name="Scan number").fill("4")
    until(page, "s.scan.index === 4 && !s.reading.picked")
    playwright.expect(mark).to_be_hidden()
    playwright.expect(said).to_contain_text("Point at a reading")
