"""The picture of the architecture is the one that its script draws, and what it names is there."""

import importlib.util
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "bayesmap"
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("architecture_picture", ROOT / "docs" / "architecture.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_picture_is_up_to_date(script):
    """A change of the steps needs `python docs/architecture.py`."""
    assert script.PICTURE.read_text(encoding="utf-8") == script.svg()


def test_files_and_folders_of_the_picture_are_there(script):
    named = {path for step in script.STEPS for path in (*step.where, *step.beside) if path.endswith((".py", "/"))}
    assert len(named) > 15
    assert sorted(path for path in named if not (SOURCE / path).exists()) == []


def test_files_and_folders_of_the_page_are_there():
    named = {path for path in re.findall(r"`([\w/]+(?:\.py|/))`", PAGE) if not path.startswith("tests/")}
    assert len(named) > 20
    assert sorted(path for path in named if not (SOURCE / path).exists()) == []


def test_every_room_is_in_the_page():
    rooms = {path.name for path in SOURCE.iterdir() if path.is_dir() and not path.name.startswith("_")}
    table = PAGE[PAGE.index("## The rooms") :]
    assert sorted(room for room in rooms if f"`{room}/`" not in table) == []


def test_a_step_fits_its_box_and_nothing_is_loaded(script):
    tree = ElementTree.fromstring(script.svg())
    assert {element.tag.rpartition("}")[2] for element in tree.iter()} == {
        "svg", "title", "defs", "marker", "path", "rect", "text",
    }  # fmt: skip
    for step in script.STEPS:
        for lines, (_, width) in zip((step.is_, step.does, step.beside), script.COLUMNS, strict=True):
            assert len(lines) <= 4
            assert max(map(len, lines)) * 7.5 < width - 12  # a letter's mean width in pixels
