"""What leaves the page opens again as it was."""

import io
import json
import zipfile

import numpy as np
import pytest
from page_driver import act, document, fragment, press_and_drag, settled, show_layer, snapshot, until
from PIL import Image

import bayesmap as bm


def saved(page, name):
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as waiting:
        page.get_by_role("button", name=name).click()
    return waiting.value


@pytest.fixture
def drawn(page):
    page.get_by_role("radio", name="Draw", exact=True).check()
    settled(page)
    act(page, lambda: press_and_drag(page, [(7, 7), (9, 8)]))
    return page


def test_a_share_link_opens_to_the_same_map_and_the_same_posterior(drawn, open_page):
    here = settled(drawn)
    drawn.get_by_role("button", name="Share").click()
    link = drawn.get_by_role("textbox", name="Link").input_value()
    assert "#m=" in link
    assert "token" not in link
    assert len(link) < 1000
    drawn.keyboard.press("Escape")
    act(drawn, lambda: drawn.get_by_role("button", name="Clear walls").click())
    other = drawn.context.new_page()  # this browser knows the token
    other.goto(link)
    until(other, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
    there = settled(other)
    assert there["document"] == here["document"]
    assert np.array_equal(there["probability"], here["probability"])
    assert np.array_equal(settled(drawn)["walls"], here["walls"])  # pages of one server show the same


def test_a_link_without_the_token_opens_nothing_in_another_browser(browser, server):
    context = browser.new_context()
    try:
        page = context.new_page()
        assert page.goto(server.split("?")[0] + fragment(document())).status == 403
        page.get_by_text("open the address that bayesmap app printed").wait_for()
        page.get_by_text("open this link again").wait_for()
        assert page.evaluate("window.bayesmap") is None
        page.goto(server)
        until(page, "s.painted")
        page.goto("about:blank")
        page.goto(server.split("?")[0] + fragment(document(prior=0.375)))  # now it knows it
        until(page, "s.document?.prior === 0.375")
    finally:
        context.close()


@pytest.mark.full
def test_a_token_that_is_refused_is_not_tried_for_ever(browser, server):
    context = browser.new_context()
    try:
        page = context.new_page()
        page.goto(server.split("?")[0])
        page.evaluate("localStorage.setItem('bayesmap-token', 'old')")
        page.goto(server.split("?")[0])
        page.wait_for_url("**/?token=old")
        page.get_by_text("open the address that bayesmap app printed").wait_for()
        assert page.evaluate("localStorage.getItem('bayesmap-token')") is None
    finally:
        context.close()


@pytest.mark.full
@pytest.mark.parametrize("damage", ["nonsense", None])
def test_a_damaged_link_says_so_and_the_page_works(open_page, server, damage):
    damaged = fragment({"version": 1, "grid": "none"}) if damage is None else f"#m={damage}"
    page = open_page(server + damaged)
    page.get_by_role("status").get_by_text("cannot be read" if damage else "Grid: not an object").wait_for()
    assert snapshot(page)["document"]["version"] == 1
    other = 0.25 if snapshot(page)["document"]["prior"] != 0.25 else 0.3
    act(page, lambda: page.get_by_label("Prior P(wall), number").fill(str(other)) or page.keyboard.press("Tab"))
    until(page, "s.status.text === 'Ready'")


def test_the_html_file_opens_from_disk_with_all_its_draws(drawn, open_page, tmp_path):
    drawn.get_by_role("button", name="Run", exact=True).click()
    until(
        drawn,
        "!s.running && s.draws.count === 1000 && s.painted.sweeps === 1000 && s.painted.generation === s.generation",
    )
    here = snapshot(drawn)
    file = tmp_path / "page.html"
    saved(drawn, "Page with its draws").save_as(file)
    page = open_page(file.as_uri())
    until(page, "s.draws.count > 0")
    there = snapshot(page)
    assert np.array_equal(there["walls"], here["walls"])
    assert np.array_equal(there["probability"], here["probability"])
    assert np.array_equal(there["observed"], here["observed"])
    assert there["scan"]["ranges"] == pytest.approx(here["scan"]["ranges"], abs=1e-3)
    assert there["draws"]["chains"] * there["draws"]["count"] >= 1000
    show_layer(page, "One draw")
    last = there["draws"]["count"] - 1
    page.get_by_role("slider", name="Draw number").fill(str(last))
    until(page, f"s.painted.layer === 'draw' && s.painted.draw === {last}")
    assert set(np.unique(snapshot(page)["probability"])) <= {0, 255}
    for name in ("Run", "Undo", "Share", "New map"):
        assert not page.get_by_role("button", name=name, exact=True).is_visible()
    assert not page.get_by_role("radio", name="Draw", exact=True).is_visible()
    assert page.evaluate("performance.getEntriesByType('resource').length") == 0


def test_a_picture_is_made_in_the_page(drawn, tmp_path):
    download = saved(drawn, "Picture")
    image = Image.open(download.path())
    assert image.format == "PNG"
    assert image.width >= 1600
    pixels = np.asarray(image.convert("RGB"), dtype=int).reshape(-1, 3)
    assert ((pixels[:, 0] > 190) & (pixels[:, 1] < 110) & (pixels[:, 2] < 40)).sum() > 1000  # true walls
    assert (pixels.sum(axis=1) < 150).sum() > 5000  # inferred ones


def test_the_run_the_map_and_the_document_are_what_the_library_reads(drawn, tmp_path):
    drawn.get_by_role("button", name="Run", exact=True).click()
    until(
        drawn,
        "!s.running && s.draws.count === 1000 && s.painted.generation === s.generation && s.painted.sweeps === 1000",
    )
    here = snapshot(drawn)
    saved(drawn, "Saved run").save_as(tmp_path / "run.nc")
    run = bm.load(tmp_path / "run.nc")
    assert run.draws.shape[-2:] == (21, 21)
    assert np.abs(run.occupancy - here["probability"] / 255).max() < 0.01
    packed = saved(drawn, "Map for robots")
    with zipfile.ZipFile(io.BytesIO(packed.path().read_bytes())) as archive:
        assert {name.rsplit(".")[-1] for name in archive.namelist()} == {"pgm", "yaml"}
    assert json.loads(saved(drawn, "Document").path().read_text()) == here["document"]
