"""``bayesmap app``: serve the interactive page, or write it as one file that needs no server.

The page shows a drawn world (`Document`), a story in steps, a saved run, or a log.
"""

from typing import TYPE_CHECKING

import click

from bayesmap.cli.command import Call, command
from bayesmap.cli.console import write_out
from bayesmap.cli.keys import LogSettings
from bayesmap.cli.translation import LOG, log_options_of, need_file
from bayesmap.errors import BadInput
from bayesmap.files import check_ending, write_file

if TYPE_CHECKING:
    from bayesmap.app.protocol.document import Document
    from bayesmap.app.protocol.notices import Story


@command("app")
@click.argument("file", metavar="[RUN.nc | LOG | DOCUMENT.json]", required=False)
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to listen on.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port to listen on. [default: any free one]")
@click.option("--no-browser", is_flag=True, help="Only print the address.")
@click.option("--export", metavar="FILE.html", help="Write a page that samples by itself, and start no server.")
@click.option("--story", "story_file", metavar="FILE.json", help="Tell a story beside the map; 'tutorial' is built in.")
@click.option("--seed", type=click.IntRange(0, 2**31 - 1), default=0, show_default=True, help="Seed of random numbers.")
def app(
    call: Call[LogSettings], file: str | None, host: str, port: int, no_browser: bool, export: str | None,
    story_file: str | None, seed: int,
) -> None:  # fmt: skip
    r"""Draw walls, drag the robot, and watch the posterior live in the browser.

    The page starts with the tutorial's map, or with a document that the page has exported. With a saved run (.nc) it
    shows the run's draws and scans. With a log it infers the map while you watch. The command prints the address of the
    page when it is ready; Ctrl-C ends the server, with exit code 0. The page loads nothing from the network, and opens
    only with the token in the address.

    With --export it writes one file with the drawn world, in which a reader draws walls, drags the robot and changes
    every setting, and the posterior follows: the samplers run in the reader's browser, without a server.

    With --story the page tells a story in steps beside the map: in each step a state, what is seen, and one thing to
    do. docs/stories.md describes the file. A step can be linked to: the address ends in #step=3.

    \b
    bayesmap app
    bayesmap app runs/office/run.nc --no-browser --port 8000
    bayesmap app office.log.gz --skip-bad-lines
    bayesmap app document.json
    bayesmap app document.json --export figure.html
    bayesmap app --story tutorial --export story.html
    """
    log_options = log_options_of(call.settings())
    if file is not None:
        need_file(file, f"a saved run (.nc), a document of the page (.json), or {LOG}", runs=True)

    from bayesmap.app.edits import tutorial_document
    from bayesmap.app.figures import read_story
    from bayesmap.app.server import serve
    from bayesmap.app.sources import read_document

    # Read what the page shows. The server opens a run or a log.
    document_file, opened_file = (file, None) if file is not None and file.endswith(".json") else (None, file)
    document = tutorial_document(seed) if document_file is None else read_document(document_file)
    story = None
    if story_file is not None:
        if opened_file is not None:
            raise BadInput(f"--story: a story has its own maps, and {opened_file} is a file; leave one of the two out")
        story = read_story(story_file, document)
        document = story.steps[0].document
    if export is not None:
        if opened_file is not None:
            remedy = "open it with bayesmap app, and choose Export there, which writes a page with its draws"
            raise BadInput(f"--export: {opened_file} is no drawn world; {remedy}")
        _export_page(call, document, story, export)
        return
    call.console.say("starting the worker ..." if opened_file is None else f"opening {opened_file} ...")

    def show_address(address: str) -> None:
        if call.console.as_json:
            call.console.result({"url": address}, ())
        else:
            write_out(f"{address}\n")
        call.console.say("Ctrl-C ends the server")
        if not no_browser:
            import webbrowser

            webbrowser.open(address)

    serve(document, path=opened_file, log_options=log_options, story=story, host=host, port=port, on_ready=show_address)


def _export_page(call: Call[LogSettings], document: "Document", story: "Story | None", file: str) -> None:
    """Write a page that samples in the reader's browser, and needs no server."""
    from bayesmap.app.figures import figure_page

    target, _ = check_ending(file, ("html",), "--export")
    page = figure_page(document, story).encode()
    write_file(target, page)
    call.console.result({"path": str(target), "bytes": len(page)}, [target])
