"""A log with raw odometry in the page: Run bends the trajectory and sharpens the map, stage by stage."""

import os
import signal

import numpy as np
import playwright.sync_api as playwright
import pytest
from click.testing import CliRunner
from page_driver import fragment, serious, served, snapshot, until, watch
from page_hands import enter, press, run

from bayesmap.cli.group import cli
from bayesmap.space.planar import between

WORDS = {
    "front end": "Matching scan to scan", "loops": "Closing loops", "aligned": "Aligning the key scans",
    "placing": "Placing the other scans",
}  # fmt: skip


def raw_log(folder, size, scans, angles):
    """Scans of a small building, with raw odometry that drifts."""
    path = folder / "raw.log"
    size = ["--size", size, "--scans", str(scans), "--angles", str(angles), "--max-range", "10"]
    raw = ["--odometry", "typical,drift_rad_per_m=0.04"]
    done = CliRunner().invoke(cli, ["simulate", "--world", "building", *size, *raw, "-o", str(path)])
    assert done.exit_code == 0, done.output
    return path


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A log whose trajectory takes long enough to be met on the way."""
    return raw_log(tmp_path_factory.mktemp("page"), "14x10", 110, 120)


@pytest.fixture
def heard():
    """What the page is sent: a slow one does not paint all of it."""
    return []


@pytest.fixture
def raw(open_page, log, heard):
    """The page of such a log, and the server's process."""
    with served(log) as (address, server):
        yield open_page(address, heard=heard), server, address


def stages(heard):
    """Names of the stages, one after the other."""
    names = [message["name"] for message in heard if message["type"] == "stage"]
    return [name for i, name in enumerate(names) if i == 0 or names[i - 1] != name]


def done(page):
    until(page, "s.painted.method === 'gibbs' && !s.running && s.painted.sweeps >= s.document.sweeps")
    return snapshot(page)


def off_m(page, log):
    """How far the pose of the last scan is from the truth, as seen from the first scan's."""
    poses = []
    last = snapshot(page)["document"]["source"]["scans"] - 1
    for number in ("0", str(last)):
        page.get_by_role("slider", name="Scan number").fill(number)
        until(page, "s.scan.index === argument", int(number))
        poses.append(snapshot(page)["scan"]["pose"][:3])
    rows = np.loadtxt(log.with_name("raw-truth.tum"))[[0, -1]]
    truth = np.column_stack([rows[:, 1:3], 2 * np.arctan2(rows[:, 6], rows[:, 7])])
    (seen,), (true,) = between(*map(np.atleast_2d, poses)), between(truth[:1], truth[1:])
    return np.hypot(seen[0] - true[0], seen[1] - true[1])


def test_run_shows_every_stage_and_ends_where_the_robot_was(open_page, tmp_path, heard):
    log = raw_log(tmp_path, "12x8", 70, 90)
    with served(log) as (address, _):
        page = open_page(address, heard=heard)
        poses = page.get_by_label("Poses", exact=True)
        assert poses.input_value() == "odometry"
        playwright.expect(page.get_by_text("Run infers where the robot was.")).to_be_visible()
        enter(page, "Sweeps", 5)
        before = snapshot(page)
        assert off_m(page, log) > 0.5
        assert before["painted"]["method"] == "counts"
        assert before["overlay"]["trajectory"] == 70
        watch(page, "[s.stage?.name ?? '', s.layers.overlay]")
        heard.clear()
        run(page)
        after = done(page)
        found = stages(heard)
        assert sorted(WORDS, key=found.index) == list(WORDS)
        said = {message["text"].lower() for message in heard if message["type"] == "status"}
        assert {words.lower() for words in WORDS.values()} <= said
        seen = page.evaluate("window.seen")
        assert {stage for stage, _ in seen} & set(WORDS)  # some of it was seen on the page
        assert seen[-1][1] > seen[0][1] + 1
        # the page was sent more of them than it may have had time to paint
        assert sum(message["type"] == "overlay" for message in heard) > 5
        assert after["status"]["text"].startswith("Trajectory inferred: odometry was off by up to")
        assert off_m(page, log) < 0.1
        assert after["draws"]["count"] == 5
        # Once more: what was inferred is known.
        heard.clear()
        run(page)
        again = done(page)
        assert set(stages(heard)) <= {"placing"}
        assert np.array_equal(again["probability"], after["probability"])


@pytest.mark.full
def test_cancel_is_prompt_and_what_there_is_stays(raw):
    page, _, _ = raw
    enter(page, "Sweeps", 5)
    run(page)
    until(page, "s.stage")
    press(page, "Cancel")
    until(page, "!s.running && s.seq.confirmed === s.seq.sent")
    shown = snapshot(page)
    assert shown["painted"]["method"] == "counts"
    page.wait_for_timeout(500)
    assert snapshot(page)["layers"]["overlay"] == shown["layers"]["overlay"]  # and nothing moves on
    run(page)
    assert done(page)["status"]["text"].startswith("Trajectory inferred")


@pytest.mark.full
def test_a_worker_that_is_killed_on_the_way_begins_anew(raw, heard):
    page, server, _ = raw
    enter(page, "Sweeps", 5)
    run(page)
    until(page, "s.stage")
    os.kill(server.worker, signal.SIGKILL)
    page.get_by_role("alert").get_by_text("The worker stopped").wait_for()
    first = done(page)
    # Killed afterwards, the next one knows the trajectory.
    heard.clear()
    os.kill(server.worker, signal.SIGKILL)
    page.get_by_role("alert").get_by_text("The worker stopped").wait_for()
    until(page, "s.worker === 'ready' && s.generation > argument", first["generation"])
    until(page, "s.painted.method === 'gibbs' && s.painted.generation === s.generation")
    assert "front end" not in stages(heard)
    assert snapshot(page)["document"]["grid"] == first["document"]["grid"]


CONFIRMED = "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation"


@pytest.mark.full
def test_the_choice_is_undone_and_travels_in_links(raw):
    page, _, _ = raw
    enter(page, "Sweeps", 5)
    run(page)
    inferred = done(page)
    poses = page.get_by_label("Poses", exact=True)
    poses.select_option("logged")
    until(page, f"s.document.poses === 'logged' && {CONFIRMED}")
    logged = snapshot(page)
    assert logged["document"]["grid"] != inferred["document"]["grid"]
    assert logged["probability"].shape == tuple(logged["document"]["grid"]["shape"])
    press(page, "Undo")
    until(page, f"s.document.poses === 'odometry' && {CONFIRMED}")
    assert snapshot(page)["document"]["grid"] == inferred["document"]["grid"]
    poses.select_option("logged")
    until(page, f"s.document.poses === 'logged' && {CONFIRMED}")
    link = fragment({**inferred["document"], "walls": "", "sweeps": 9})
    page.evaluate("(hash) => { location.hash = hash; }", link)
    until(page, f"s.document.sweeps === 9 && s.document.poses === 'odometry' && {CONFIRMED}")
    assert snapshot(page)["document"]["grid"] == inferred["document"]["grid"]


@pytest.mark.full
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_can_be_read_in_light_and_dark(open_page, log, scheme):
    with served(log) as (address, _):
        page = open_page(address, color_scheme=scheme, bypass_csp=True)
        run(page)
        until(page, "s.stage")
        assert serious(page) == []
