"""Runs, draws, cancelling; and that the numbers are those of the posterior."""

import numpy as np
import pytest
from page_driver import NO_WALLS, act, centre, document, settled, show_layer, snapshot, until, watch

import bayesmap as bm


def run(page):
    page.get_by_role("button", name="Run", exact=True).click()


def test_the_last_draw_is_valid_and_the_mean_is_the_draws_average(open_page):
    page = open_page(document(sweeps=5))
    run(page)
    until(page, "!s.running && s.draws.count === 5 && s.painted.sweeps === 5 && s.painted.generation === s.generation")
    shown = snapshot(page)
    mean = shown["probability"] / 255
    chains = shown["draws"]["chains"]
    show_layer(page, "One draw")
    slider = page.get_by_role("slider", name="Draw number")
    total = np.zeros((21, 21))
    for chain in range(chains):
        page.get_by_label("Chain", exact=True).select_option(str(chain))
        for draw in range(5):
            slider.fill(str(draw))
            until(page, f"s.painted.layer === 'draw' && s.painted.draw === {draw} && s.painted.chain === {chain}")
            one = snapshot(page)["probability"]
            assert set(np.unique(one)) <= {0, 255}
            total += one / 255
    assert slider.get_attribute("max") == "4"
    assert np.abs(total / (5 * chains) - mean).max() <= 0.5 / 255 + 1e-9
    show_layer(page, "Mean")
    until(page, "s.painted.layer === 'mean'")


@pytest.mark.full
def test_draws_are_played_one_after_another(open_page):
    page = open_page(document(sweeps=6))
    run(page)
    until(page, "!s.running && s.draws.count === 6")
    watch(page, "s.painted.layer === 'draw' ? s.painted.draw : -1")
    page.get_by_role("button", name="Play the draws").click()
    until(page, "s.painted.layer === 'draw' && s.painted.draw === 5 && window.seen.includes(2)")
    page.get_by_role("button", name="Play the draws").wait_for()  # it stops at the last
    show_layer(page, "Mean")


def test_cancel_keeps_the_partial_chain(open_page):
    page = open_page(document(sweeps=100_000, angles=1000))
    run(page)
    until(page, "s.running && s.painted.method === 'gibbs' && s.painted.generation === s.generation")
    page.get_by_text(" of 100000 sweeps").wait_for()
    page.get_by_text("s left").wait_for()
    assert page.get_by_role("progressbar").evaluate("(bar) => bar.value") < 1
    page.get_by_role("button", name="Cancel").click()
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
    page.evaluate("""() => {
      window.wrong = 0;
      window.last = 0;
      const view = () => {
        const s = bayesmap.snapshot();
        if (s.painted.generation < last) wrong++;
        last = Math.max(last, s.painted.generation);
        requestAnimationFrame(view);
      };
      view();
    }""")
    page.get_by_role("radio", name="Draw", exact=True).check()
    page.mouse.move(*centre(page, 2, 2))
    page.mouse.down()
    for x in range(3, 18):
        page.mouse.move(*centre(page, x, 2))
    page.mouse.up()
    until(page, "s.seq.confirmed === s.seq.sent && s.painted.generation === s.generation")
    shown = snapshot(page)
    assert page.evaluate("wrong") == 0
    assert shown["walls"].sum() == 16
    assert not shown["running"]  # an edit ends the run; what follows is live
    page.get_by_role("button", name="Cancel").click()


@pytest.mark.full
def test_three_by_three_equals_exact_enumeration(open_page):
    """Worst of 8 cells, sweeps counted as 1/4 independent: 5 standard errors, a false alarm in 200 000 runs."""
    small = document(
        grid={"shape": [3, 3], "resolution": 1.0, "origin": [-0.5, -0.5]},
        walls="AIA=",  # of the cell (2, 2)
        sensors=[{"id": 1, "x": 1.0, "y": 1.0, "yaw": 0.3}],
        angles=10,
        noise=3.0,
        max_range=6.0,
        sweeps=20_000,
    )
    page = open_page(small)
    act(page, lambda: page.get_by_role("button", name="Run", exact=True).click())
    until(page, "!s.running && s.painted.sweeps === 20000")
    shown = snapshot(page)
    scan = shown["scan"]
    readings = bm.Scans(scan["pose"].reshape(-1, 3), scan["angles"], scan["ranges"].reshape(1, -1), max_range_m=6.0)
    grid = bm.Grid(shape=(3, 3), resolution=1.0, origin=(-0.5, -0.5))
    exact = bm.infer(
        readings,
        grid,
        prior=bm.Independent(0.5),
        sensor=bm.Gaussian(3.0),
        method="exact",
        schedule=bm.Schedule(draws=10),
    ).occupancy
    error = np.sqrt(exact * (1 - exact) / (2 * 20_000 / 4))
    assert (np.abs(shown["probability"] / 255 - exact) < 5 * error + 0.5 / 255).all()
    assert ((exact > 0.02) & (exact < 0.98)).sum() >= 3  # there is something to get wrong


@pytest.mark.full
def test_entropy_is_highest_where_nothing_is_known(page):
    shown = settled(page)
    page.get_by_role("radio", name="Entropy").check()
    until(page, "s.painted.layer === 'entropy'")
    assert np.array_equal(snapshot(page)["probability"], shown["probability"])
    assert page.get_by_role("list", name="Legend").get_by_text("entropy (bit)").is_visible()
    show_layer(page, "Mean")
    until(page, "s.painted.layer === 'mean'")
