"""A browser, a server, and a page that begins with the tutorial's map; skipped where there is no Chromium."""

import contextlib

import pytest
from acted import Acted, Heard
from building_log import room_run
from page_driver import ARGUMENTS, CHROMIUM, WAIT_SECONDS, document, new_context, served, until, watch_for_trouble
from warm_worker import FORKS, Forked

import bayesmap as bm
from bayesmap.app import worker
from bayesmap.app.protocol.wire import parse_document


@pytest.fixture(scope="session", autouse=True)
def warm_workers():
    """Supervisors start workers that are warm; processes of their own, commands and notebooks, start cold ones."""
    with pytest.MonkeyPatch.context() as changed:
        if FORKS:
            changed.setattr(worker, "start_worker", Forked)
        yield


@pytest.fixture
def acted():
    return Acted()


@pytest.fixture
def heard():
    return Heard()


@pytest.fixture(scope="session")
def browser():
    if CHROMIUM is None:
        pytest.skip("no Chromium on this machine")
    playwright = pytest.importorskip("playwright.sync_api")
    playwright.expect.set_options(timeout=1000 * WAIT_SECONDS)
    with playwright.sync_playwright() as started:
        launched = started.chromium.launch(executable_path=CHROMIUM, args=list(ARGUMENTS), timeout=1000 * WAIT_SECONDS)
        yield launched
        launched.close()


@pytest.fixture
def server(browser):
    with served() as (address, _):
        yield address


@pytest.fixture
def open_page(browser):
    """Opens an address, or a document in its own server, in its own context; errors and requests elsewhere fail."""
    troubles = []
    with contextlib.ExitStack() as opened:

        def open_(where, *, quiet=True, **options):
            if isinstance(where, dict):
                where, _ = opened.enter_context(served(started=parse_document(where)))
            page = opened.enter_context(contextlib.closing(new_context(browser, **options))).new_page()
            if quiet:
                watch_for_trouble(page, troubles)
            page.goto(where)
            until(page, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
            if not where.startswith("file:"):  # of a run's draws the server tells after its picture
                until(page, "s.document.source.kind !== 'run' || s.draws.count > 0")
            return page

        yield open_
    assert troubles == []


@pytest.fixture(scope="session")
def room(tmp_path_factory, browser):
    """A run of surfaces of a small room, two chains of ten draws, and the address of a server that shows it."""
    run, path = room_run(bm.Surface()), tmp_path_factory.mktemp("room") / "run.nc"
    run.save(path)
    with served(path) as (address, _):
        yield run, address


@pytest.fixture
def page(open_page):
    return open_page(document())
