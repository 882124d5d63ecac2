"""Runs, draws, cancelling; and that the numbers are those of the posterior."""

import numpy as np
import pytest
from page_driver import NO_WALLS, centre, document, settled, snapshot, until, watch
from page_hands import choose, press, run, show_draw, show_layer


def test_draws_are_valid_and_average_to_the_mean_and_are_played_one_after_another(open_page):
    page = open_page(document(sweeps=5, burn_in=0))
    run(page, 10)  # five of Live, and five more
    shown = snapshot(page)
    show_layer(page, "One draw")
    draws = [show_draw(page, draw, chain) for chain in range(shown["draws"]["chains"]) for draw in range(10)]
    assert set(np.unique(draws)) <= {0, 255}
    assert page.get_by_role("slider", name="Draw number").get_attribute("max") == "9"
    seen = shown["observed"] > 0  # where no beam is, the mean is the prior
    assert np.abs(np.mean(draws, axis=0) - shown["probability"])[seen].max() <= 0.5 + 1e-9
    show_layer(page, "Mean")
    until(page, "s.painted.layer === 'mean'")
    watch(page, "s.painted.layer === 'draw' ? s.painted.draw : -1")
    press(page, "Play the draws")
    until(page, "s.painted.layer === 'draw' && s.painted.draw === 9 && window.seen.includes(2)")
    page.get_by_role("button", name="Play the draws").wait_for()  # it stops at the last


def test_cancel_keeps_the_partial_chain(open_page):
    page = open_page(document(sweeps=100_000, angles=1000))
    run(page)
    until(page, "s.running && s.painted.method === 'gibbs' && s.painted.generation === s.generation")
    page.get_by_text(" of 200000 sweeps").wait_for()
    page.get_by_text("s left").wait_for()
    assert page.get_by_role("progressbar").evaluate("(bar) => bar.value") < 1
    press(page, "Cancel")
    until(page, "!s.running && s.draws.count > 0 && s.draws.count === s.painted.sweeps")
    partial = snapshot(page)
    assert 0 < partial["painted"]["sweeps"] < 100_000
    page.wait_for_timeout(300)
    assert snapshot(page)["painted"]["sweeps"] == partial["painted"]["sweeps"]


@pytest.mark.full
def test_editing_during_inference_paints_no_old_generation(open_page):
    page = open_page(document(sweeps=100_000, angles=400, walls=NO_WALLS))
    run(page)
    until(page, "s.running && s.painted.sweeps > 0")
    watch(page, "s.painted.generation")
    choose(page, "Draw")
    page.mouse.move(*centre(page, 2, 2))
    page.mouse.down()
    for x in range(3, 18):
        page.mouse.move(*centre(page, x, 2))
    page.mouse.up()
    until(page, "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation")
    shown, seen = snapshot(page), page.evaluate("window.seen")
    assert seen == sorted(seen)
    assert shown["walls"].sum() == 16
    assert not shown["running"]  # an edit ends the run; what follows is live
    press(page, "Cancel")


@pytest.mark.full
def test_entropy_is_highest_where_nothing_is_known(page):
    shown = settled(page)
    choose(page, "Entropy")
    until(page, "s.painted.layer === 'entropy'")
    assert np.array_equal(snapshot(page)["probability"], shown["probability"])
    assert page.get_by_role("list", name="Legend").get_by_text("entropy (bit)").is_visible()
