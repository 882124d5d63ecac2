"""What leaves the page opens again as it was."""

import io
import json
import zipfile

import numpy as np
import pytest
from page_driver import document, fragment, settled, snapshot, until
from page_hands import act, choose, press, press_and_drag, run, show_draw, show_layer
from PIL import Image

import bayesmap as bm


def saved(page, name):
    page.get_by_role("button", name="Export").click()
    with page.expect_download() as waiting:
        page.get_by_role("button", name=name).click()
    return waiting.value


@pytest.fixture
def drawn(page):
    choose(page, "Draw")
    settled(page)
    act(page, lambda: press_and_drag(page, [(7, 7), (9, 8)]))
    return page


def test_a_share_link_opens_to_the_same_map_and_the_same_posterior(drawn, open_page):
    here = settled(drawn)
    press(drawn, "Share")
    link = drawn.get_by_role("textbox", name="Link").input_value()
    assert "#m=" in link
    assert "token" not in link
    assert len(link) < 1000
    drawn.keyboard.press("Escape")
    act(drawn, lambda: press(drawn, "Clear walls"))
    assert settled(drawn)["walls"].sum() == 0
    other = drawn.context.new_page()  # this browser knows the token
    other.goto(link)
    until(other, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
    there = settled(other)
    assert there["document"] == here["document"]
    assert np.array_equal(there["probability"], here["probability"])
    assert np.array_equal(settled(drawn)["walls"], here["walls"])  # pages of one server show the same


@pytest.fixture
def stranger(browser):
    """A page in a browser that knows no token."""
    context = browser.new_context()
    yield context.new_page()
    context.close()


def test_a_link_without_the_token_opens_nothing_in_another_browser(stranger, server):
    bare = server.split("?")[0]
    assert stranger.goto(bare + fragment(document())).status == 403
    stranger.get_by_text("open the address that bayesmap app printed").wait_for()
    stranger.get_by_text("open this link again").wait_for()
    assert stranger.evaluate("window.bayesmap") is None
    stranger.goto(server)
    until(stranger, "s.painted")
    stranger.goto("about:blank")
    stranger.goto(bare + fragment(document(prior=0.375)))  # now it knows it
    until(stranger, "s.document?.prior === 0.375")


@pytest.mark.full
def test_a_token_that_is_refused_is_not_tried_for_ever(stranger, server):
    bare = server.split("?")[0]
    stranger.goto(bare)
    stranger.evaluate("localStorage.setItem('bayesmap-token', 'old')")
    stranger.goto(bare)
    stranger.wait_for_url("**/?token=old")
    stranger.get_by_text("open the address that bayesmap app printed").wait_for()
    assert stranger.evaluate("localStorage.getItem('bayesmap-token')") is None


def test_what_a_run_is_exported_to_opens_again_with_all_its_draws(drawn, open_page, tmp_path):
    run(drawn, 2000)  # those of Live, and as many more
    here = snapshot(drawn)
    saved(drawn, "Saved run").save_as(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert loaded.draws.shape[-2:] == (21, 21)
    apart = np.abs(loaded.occupancy - here["probability"] / 255)
    assert apart[here["observed"] > 0].max() < 0.01
    assert apart.max() < 0.06  # where no beam is, the page has the prior itself
    with zipfile.ZipFile(io.BytesIO(saved(drawn, "Map for robots").path().read_bytes())) as archive:
        assert {name.rsplit(".")[-1] for name in archive.namelist()} == {"pgm", "yaml"}
    assert json.loads(saved(drawn, "Document").path().read_text()) == here["document"]
    saved(drawn, "Page in one file").save_as(tmp_path / "page.html")
    page = open_page((tmp_path / "page.html").as_uri())
    until(page, "s.draws.count > 0")
    there = snapshot(page)
    for name in ("walls", "probability", "observed"):
        assert np.array_equal(there[name], here[name])
    assert there["scan"]["ranges"] == pytest.approx(here["scan"]["ranges"], abs=1e-3)
    assert there["draws"]["chains"] * there["draws"]["count"] >= 1000
    show_layer(page, "One draw")
    assert set(np.unique(show_draw(page, there["draws"]["count"] - 1))) <= {0, 255}
    for name in ("Run", "Undo", "Share", "New map"):
        assert not page.get_by_role("button", name=name, exact=True).is_visible()
    assert not page.get_by_role("radio", name="Draw", exact=True).is_visible()
    assert page.evaluate("performance.getEntriesByType('resource').length") == 0


def test_a_picture_is_made_in_the_page(drawn):
    image = Image.open(saved(drawn, "Picture").path())
    assert image.format == "PNG"
    assert image.width >= 1600
    pixels = np.asarray(image.convert("RGB"), dtype=int).reshape(-1, 3)
    assert ((pixels[:, 0] > 190) & (pixels[:, 1] < 110) & (pixels[:, 2] < 40)).sum() > 1000  # true walls
    assert (pixels.sum(axis=1) < 150).sum() > 5000  # inferred ones
