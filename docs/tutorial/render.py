"""Makes the pages of the tutorial of their notebooks: prose, code, what each cell prints, and figures.

Run `python docs/tutorial/render.py` from the repository's root for all pages, or name some:
`python docs/tutorial/render.py localization`. Measured times differ from run to run, so in lines that begin with
`time:` numbers are rounded.
"""

import contextlib
import io
import math
import re
import sys
from pathlib import Path
from typing import Any, NamedTuple

HERE = Path(__file__).parent
PAGES = ("mapping", "gibbs", "kernels", "localization", "both", "odometry")
"""In the order in which they are read: each `NAME.py` makes `NAME.md`."""
FOLDED = 'tags=["hide-input"]'
"""On the line that begins a cell: its code is folded away, as Jupyter Book does it; what it prints is shown."""
FOLDED_WHOLE = 'tags=["hide-cell"]'
"""On the line that begins a cell: its code and what it prints are folded away, as the answer of an exercise."""


class Cell(NamedTuple):
    """A cell of a notebook.

    Attributes:
        is_code: else it is Markdown.
        text: without the line that begins the cell.
        line: of the file, on which the text begins.
        folded: the title of code that is folded away, else the empty string.
        whole: whether what the code prints is folded away, too.
    """

    is_code: bool
    text: str
    line: int
    folded: str = ""
    whole: bool = False


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
        title = lines[start].removeprefix("# %%").replace(FOLDED, "").replace(FOLDED_WHOLE, "").strip()
        whole = FOLDED_WHOLE in lines[start]
        folded = (title or "Code of the figure and the checks") if whole or FOLDED in lines[start] else ""
        found.append(Cell(is_code, text, start + 2 + skipped, folded, whole))
    return found


def rounded(line: str) -> str:
    """The line; if it is of measured times, its numbers as 1, 2 or 5 times a power of ten."""
    return re.sub(r"\d+(\.\d+)?", _near, line) if line.startswith("time:") else line


def _near(number: re.Match[str]) -> str:
    value = max(float(number[0]), 1e-6)
    power = 10.0 ** math.floor(math.log10(value))
    nearest = min((power, 2 * power, 5 * power, 10 * power), key=lambda near: abs(math.log(near / value)))
    return f"{nearest:,.0f}" if nearest >= 1 else f"{nearest:.6f}".rstrip("0")


def page(name: str, source: str, outputs: list[str]) -> str:
    """The page in Markdown.

    Args:
        name: of the notebook.
        source: the notebook.
        outputs: what each of its code cells printed.
    """
    parts = [f"<!-- Made by render.py from {name}.py: change that, not this. -->"]
    printed = iter(outputs)
    for cell in cells(source):
        if not cell.is_code:
            parts.append(cell.text)
            continue
        code = f"```python\n{cell.text}\n```"
        if cell.whole:
            code += "\n\n" + _block([rounded(line) for line in next(printed).splitlines()])
        if cell.folded:
            code = f"<details><summary>{cell.folded}</summary>\n\n{code}\n\n</details>"
        parts.append(code)
        if cell.whole:
            continue
        text: list[str] = []
        for line in next(printed).splitlines():
            figure = re.fullmatch(r"figure: (\S+\.png): (.+)", line)
            if figure is None:
                text.append(rounded(line))
                continue
            parts += [_block(text), f"![{figure[2]}](figures/{figure[1]})\n\n*{figure[2]}*"]
            text = []
        parts.append(_block(text))
    return "\n\n".join(part for part in parts if part) + "\n"


def execute(source: str, path: Path) -> list[str]:
    """Run the code cells in order, in one namespace, and return what each prints."""
    namespace: dict[str, Any] = {"__name__": path.stem, "__file__": str(path)}
    outputs = []
    for cell in cells(source):
        if cell.is_code:
            code = compile("\n" * (cell.line - 1) + cell.text, str(path), "exec")
            with contextlib.redirect_stdout(io.StringIO()) as captured:
                exec(code, namespace)
            outputs.append(captured.getvalue())
    return outputs


def _block(lines: list[str]) -> str:
    return "```text\n" + "\n".join(lines) + "\n```" if lines else ""


if __name__ == "__main__":
    for name in sys.argv[1:] or PAGES:
        notebook = HERE / f"{name}.py"
        source = notebook.read_text(encoding="utf-8")
        notebook.with_suffix(".md").write_text(page(name, source, execute(source, notebook)), encoding="utf-8")
