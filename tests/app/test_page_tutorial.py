"""The page with draws in one file that the tutorial links to opens from a disk, without a server."""

from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "tutorial" / "interactive.html"


def test_the_interactive_page_opens_from_a_disk(browser):
    page, requests = browser.new_page(), []
    page.on("request", lambda request: requests.append(request.url))
    page.goto(PAGE.as_uri())
    page.wait_for_function("() => window.bayesmap?.snapshot().painted?.sweeps === 1000")
    page.get_by_role("radio", name="One draw").check()
    page.wait_for_function("() => window.bayesmap.snapshot().painted.layer === 'draw'")
    page.close()
    assert [url for url in requests if not url.startswith(("file:", "blob:", "data:"))] == []
