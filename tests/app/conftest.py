"""A browser, a server, and a page that begins with the tutorial's map; skipped where there is no Chromium."""

import pytest
from building_log import room_run
from page_driver import ARGUMENTS, CHROMIUM, DESKTOP, NO_WALLS, document, fragment, listen, served, until

import bayesmap as bm


def pytest_collection_modifyitems(items):
    """A test in a real browser gets a second try: browser, server and worker share a machine that may be busy.

    The summary of the run names the tests that needed it.
    """
    for item in items:
        if "browser" in item.fixturenames:
            item.add_marker(pytest.mark.flaky(reruns=1))


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium without a head."""
    if CHROMIUM is None:
        pytest.skip("no Chromium on this machine")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as started:
        launched = started.chromium.launch(executable_path=CHROMIUM, args=list(ARGUMENTS))
        yield launched
        launched.close()


@pytest.fixture(scope="session")
def server(browser):
    """The address of a server that the tests share."""
    with served() as (address, _):
        yield address


@pytest.fixture
def open_page(browser):
    """Opens addresses in contexts of their own; a page must cause no errors and leave the machine for nothing."""
    contexts, troubles = [], []

    def opened(address, json_document=None, *, quiet=True, heard=None, **options):
        context = browser.new_context(**{**DESKTOP, **options})
        contexts.append(context)
        page = context.new_page()
        if heard is not None:
            listen(page, heard)
        if quiet:
            page.on("console", lambda message: troubles.append(message.text) if trouble(message) else None)
            page.on("pageerror", lambda error: troubles.append(str(error)))
            page.on("request", lambda request: None if local(request.url) else troubles.append(request.url))
        # by way of another map, so that nothing of the test before is left
        page.goto(address + ("" if json_document is None else fragment(document(angles=10, walls=NO_WALLS))))
        if json_document is not None:
            until(page, "s.painted && s.document.angles === 10")
            page.evaluate("(hash) => { location.hash = hash; }", fragment(json_document))
            until(page, "s.document.angles === argument", json_document["angles"])
        until(page, "s.painted?.generation === s.generation && s.seq.confirmed === s.seq.sent")
        if not address.startswith("file:"):  # of a run's draws the server tells after its picture
            until(page, "s.document.source.kind !== 'run' || s.draws.count > 0")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert troubles == []


@pytest.fixture(scope="session")
def room(tmp_path_factory, browser):
    """A run of surfaces of a small room, two chains of ten draws, and the address of a server that shows it."""
    run = room_run(bm.Surface(), draws=10)
    path = tmp_path_factory.mktemp("room") / "run.nc"
    run.save(path)
    with served(path) as (address, _):
        yield run, address


def trouble(message):
    """Whether the console was told of an error; that a server has ended before its page is none."""
    return message.type == "error" and "ERR_CONNECTION_REFUSED" not in message.text


def local(url):
    return url.startswith(("http://127.0.0.1:", "ws://127.0.0.1:", "blob:", "data:", "file:", "about:"))


@pytest.fixture
def page(open_page, server):
    """The page of the shared server, with the tutorial's map, its mean, and live."""
    opened = open_page(server, document())
    opened.get_by_role("radio", name="Mean").check()
    opened.get_by_role("checkbox", name="Live").check()
    return opened
