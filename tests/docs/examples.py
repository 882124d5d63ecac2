"""Examples as they stand in a page: Python blocks, and lines for the shell.

A comment above a Python block says what it needs; it does not show on the page:

    <!-- example: needs intel-corrected.log.gz -->   run where $BAYESMAP_DATA has that file, which then lies beside it
    <!-- example: needs xarray_einstats -->          run where this module is installed
    <!-- example: not run, because REASON -->        compiled only
"""

import importlib.util
import re
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
TUTORIAL = ROOT / "docs" / "tutorial"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]

FENCE = re.compile(
    r"^(?P<indent> *)```(?P<language>\w*)[^\n]*\n(?P<text>.*?)^(?P=indent)```\s*$", re.DOTALL | re.MULTILINE
)
MARK = re.compile(r"<!-- example: (?:needs (?P<file>\S+)|not run, because (?P<reason>[^>]+?)) -->\s*\Z")
MISTAKEN_MARK = re.compile(r"<!--\s*example(?!: (?:needs \S+|not run, because [^>]+) -->\n+ *```python)")
INDENTED = re.compile(r"^    (?! )(.+)$", re.MULTILINE)
INLINE = re.compile(r"`([^`\n]+)`")


@dataclass(frozen=True)
class Example:
    """A Python block of a page."""

    line: int  # of its first line in the page, from 1
    text: str
    needs: str = ""  # a file that it reads, or a module
    not_run: str = ""  # why it is compiled only


def script(path: Path) -> Any:
    """Return a script of docs/, which lies in no package, as a module."""
    spec = importlib.util.spec_from_file_location(f"{path.parent.name}_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def python_examples(page: str) -> list[Example]:
    """The Python blocks of a page; ValueError for a mark that is not understood or stands above no Python block."""
    if mistaken := MISTAKEN_MARK.search(page):
        raise ValueError(
            f"line {_line(page, mistaken.start())}: not a mark of a Python block (see tests/docs/examples.py)"
        )
    found = []
    for block in FENCE.finditer(page):
        if block["language"] in ("python", "py"):
            mark = MARK.search(page[: block.start()])
            needs, reason = (mark["file"] or "", mark["reason"] or "") if mark else ("", "")
            text = re.sub(f"^{block['indent']}", "", block["text"], flags=re.MULTILINE)
            found.append(Example(_line(page, block.start("text")), text, needs, reason))
    return found


def shell_words(page: str) -> list[tuple[int, list[str]]]:
    """Lines for the shell, wherever they stand (indented, fenced, between backquotes): line number, and words."""
    prose, found = FENCE.sub(lambda block: re.sub(r"[^\n]", "", block[0]), page), []
    for block in FENCE.finditer(page):
        if block["language"] not in ("python", "py"):
            start = _line(page, block.start("text"))
            found += [(start + number, text.strip()) for number, text in enumerate(block["text"].splitlines())]
    for pattern in (INDENTED, INLINE):
        found += [(_line(prose, match.start()), match[1]) for match in pattern.finditer(prose)]
    return [(line, words) for line, text in sorted(found) if (words := _words(text))]


def _words(text: str) -> list[str]:
    """Split a line that calls bayesmap or make as a shell does; any other line has no words."""
    text = re.sub(r"^(?:\$ )?(?:[A-Z_]+=(?:\"[^\"]*\"|\S+) )*(?:\.venv/bin/)?", "", text)
    return shlex.split(text, comments=True) if re.match(r"(?:bayesmap|make) [a-z]", text) else []


def _line(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1
