"""What the site has beside the files of docs/ (a hook of MkDocs, see mkdocs.yml).

README.md and CONTRIBUTING.md become its pages, with their links turned; the tutorial's first page shows the live page's
static export, which `docs/tutorial/interactive.py` makes. The story that is built in is one file of the site. It stands
on the front page, and its steps stand in the tutorial in place of pictures.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

ROOT = Path(__file__).resolve().parents[1]
PAGES = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md"}
TUTORIAL = "tutorial/README.md"
FRAME = """
<figure markdown="0" style="width: 100%">
<iframe src="interactive.html" title="The tutorial's posterior: draws, mean and beams" loading="lazy"
  style="width: 100%; height: 860px; border: 1px solid var(--md-default-fg-color--lightest)"></iframe>
<figcaption>The posterior over the tutorial's map, as <code>bayesmap app</code> shows and exports it: step through its
draws, look at single beams. Run the command for one that answers to the pen.</figcaption>
</figure>
"""
STEPS = {
    ("index.md", None): 1,
    ("tutorial/mapping.md", "importance.png"): 3,
    ("tutorial/gibbs.md", "orders.png"): 4,
    ("tutorial/gibbs.md", "blocks.png"): 5,
    ("tutorial/kernels.md", "poses.png"): 6,
}
"""The steps of the story, by the page and the picture in whose place they stand; the front page has one."""


def story_frame(step: int, up: str) -> str:
    """Return a frame with a step of the story, for a page that is so far below the site's root."""
    return f"""<figure markdown="0" style="width: 100%">
<iframe src="{up}story.html#step={step}" title="A story in steps, which samples in the page" loading="lazy"
  style="width: 100%; height: 860px; border: 1px solid var(--md-default-fg-color--lightest)"></iframe>
<figcaption>It samples in this page: draw walls, drag the robot, do what the step asks for.
<a href="{up}story.html#step={step}">The figure alone</a></figcaption>
</figure>
"""


def story() -> str:
    """Return the story that is built in, as a page in one file."""
    from bayesmap.app.edits import tutorial_document
    from bayesmap.app.figures import BUILT_IN_STORY, figure_page, read_story

    told = read_story(BUILT_IN_STORY, tutorial_document())
    return figure_page(told.steps[0].document, told)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are not in docs/."""
    for source, target in PAGES.items():
        text = site_links((ROOT / source).read_text(encoding="utf-8"))
        files.append(File.generated(config, target, content=text))
    files.append(File.generated(config, "story.html", content=story()))
    return files


def on_page_markdown(markdown: str, *, page: Any, **_: Any) -> str:
    """Turn links to README and CONTRIBUTING, show export and story, and render what is folded away."""
    source = page.file.src_uri
    up = "../" * source.count("/")
    for name, target in PAGES.items():
        markdown = markdown.replace(f"]({up}../{name}", f"]({up}{target}")
    if source == TUTORIAL:
        markdown += FRAME
    for (name, picture), step in STEPS.items():
        if name == source:
            place = r"^## Install$" if picture is None else rf"^!\[.*\]\(figures/{picture}\)$"
            kept = "\n## Install" if picture is None else ""
            markdown = re.sub(place, story_frame(step, up) + kept, markdown, count=1, flags=re.MULTILINE)
    return markdown.replace("<details>", '<details markdown="1">')


def on_post_build(config: MkDocsConfig) -> None:
    """The site works without a network.

    Raises:
        PluginError: a page or a style sheet loads something from elsewhere.
    """
    site = Path(config.site_dir)
    found = {
        f"{path.relative_to(site)}: {address}"
        for path in (*site.rglob("*.html"), *site.rglob("*.css"))
        for address in loaded_from_elsewhere(path.read_text(encoding="utf-8"))
    }
    if found:
        raise PluginError("loaded from the internet: " + "; ".join(sorted(found)))


def loaded_from_elsewhere(text: str) -> list[str]:
    """Addresses of scripts, pictures, fonts, styles and frames of other hosts; what a reader may follow is no such."""
    tags = re.findall(r"<(?:script|img|iframe|source|link|object|embed)\b[^>]*>", text)
    loads = [tag for tag in tags if not re.search(r'rel="?(?:canonical|next|prev|alternate)', tag)]
    found = [a for tag in loads for a in re.findall(r'\b(?:src|href|data)="?((?:https?:)?//[^">\s]+)', tag)]
    return found + re.findall(r"(?:url\(|@import\s)[\s\"']*((?:https?:)?//[^\"')\s]+)", text)


def site_links(markdown: str) -> str:
    """Links of a file beside docs/, as they are inside it."""
    markdown = re.sub(r"\]\(docs/tutorial\)", f"]({TUTORIAL})", markdown)
    for source, target in PAGES.items():
        markdown = markdown.replace(f"]({source}", f"]({target}")
    return markdown.replace("](docs/", "](")
