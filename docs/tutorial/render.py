"""Makes README.md of tutorial.py: its prose, its code, what each cell prints, and its figures.

Run `python docs/tutorial/render.py` from the repository's root. Measured times differ from run to run, so in lines that
begin with `time:` numbers are rounded to powers of ten.
"""

import contextlib
import io
import math
import re
from pathlib import Path
from typing import Any, NamedTuple

HERE = Path(__file__).parent
SOURCE, PAGE = HERE / "tutorial.py", HERE / "README.md"
NOTE = "<!-- Made by render.py from tutorial.py: change that, not this. -->\n"


class Cell(NamedTuple):
    """A cell of the notebook: Markdown, or code and the line of the file on which it begins."""

    is_code: bool
    text: str
    line: int


def cells(source: str) -> list[Cell]:
    """The cells of a notebook in jupytext's percent format; what stands before the first is its header."""
    found: list[Cell] = []
    lines = source.splitlines()
    starts = [n for n, line in enumerate(lines) if line.startswith("# %%")]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        body = lines[start + 1 : end]
        is_code = "[markdown]" not in lines[start]
        if not is_code:
            body = [line.removeprefix("#").removeprefix(" ") for line in body]
        text = "\n".join(body).strip("\n")
        skipped = next((n for n, line in enumerate(body) if line), 0)
        found.append(Cell(is_code, text, start + 2 + skipped))
    return found


def masked(line: str) -> str:
    """The line, with measured numbers as powers of ten."""
    if not line.startswith("time:"):
        return line
    return re.sub(r"\d+(\.\d+)?", lambda number: f"10^{round(math.log10(max(float(number[0]), 1e-9)))}", line)


def page(source: str, outputs: list[str]) -> str:
    """The page in Markdown.

    Args:
        source: the notebook.
        outputs: what each of its code cells printed.
    """
    parts = []
    printed = iter(outputs)
    for cell in cells(source):
        if not cell.is_code:
            parts.append(cell.text)
            continue
        parts.append(f"```python\n{cell.text}\n```")
        text: list[str] = []
        for line in next(printed).splitlines():
            figure = re.fullmatch(r"figure: (\S+\.png): (.+)", line)
            if figure is None:
                text.append(masked(line))
                continue
            parts += [_block(text), f"![{figure[2]}](figures/{figure[1]})\n\n*{figure[2]}*"]
            text = []
        parts.append(_block(text))
    return NOTE + "\n" + "\n\n".join(part for part in parts if part) + "\n"


def execute(source: str) -> list[str]:
    """Run the code cells in order, in one namespace, and return what each prints."""
    namespace: dict[str, Any] = {"__name__": "tutorial", "__file__": str(SOURCE)}
    outputs = []
    for cell in cells(source):
        if cell.is_code:
            code = compile("\n" * (cell.line - 1) + cell.text, str(SOURCE), "exec")
            with contextlib.redirect_stdout(io.StringIO()) as captured:
                exec(code, namespace)
            outputs.append(captured.getvalue())
    return outputs


def _block(lines: list[str]) -> str:
    return "```text\n" + "\n".join(lines) + "\n```" if lines else ""


if __name__ == "__main__":
    notebook = SOURCE.read_text(encoding="utf-8")
    PAGE.write_text(page(notebook, execute(notebook)), encoding="utf-8")
