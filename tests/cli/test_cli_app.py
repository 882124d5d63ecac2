"""`bayesmap app`: a log read by the settings with which other commands read one, and a figure in one file."""

import gzip
import json
import signal

import pytest
from shell import PATIENCE_S, Listener, call, start, succeed

from bayesmap.app.edits import tutorial_document
from bayesmap.app.sources import open_file
from bayesmap.errors import BadInput


@pytest.fixture
def cut(office, tmp_path):
    """A packed log that ends too early, in the middle of a line."""
    path = tmp_path / "cut.log.gz"
    packed = gzip.compress(office.read_bytes())
    path.write_bytes(packed[: len(packed) // 2])
    return path


@pytest.mark.parametrize("command", ["infer", "slam", "localize", "score", "render", "app"])
def test_whoever_reads_a_log_has_the_option_that_refusals_name(command):
    assert "--skip-bad-lines" in call(command, "--help").stdout


def test_a_cut_log_is_refused_and_shown_as_far_as_it_goes_with_the_option_that_is_named(cut):
    with pytest.raises(BadInput, match="--skip-bad-lines"):
        open_file(str(cut))
    process = start("app", "--no-browser -q", cut, "--skip-bad-lines")
    try:
        assert Listener(process).line().startswith("http://127.0.0.1:")
    finally:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, errors) == (0, "")


def test_settings_of_reading_reach_the_log(office):
    whole = open_file(str(office)).document.source.scans
    assert open_file(str(office), thin_m=1.0).document.source.scans < whole
    printed = json.loads(json.dumps({"no_return": float("inf")}))  # as the worker is told
    assert open_file(str(office), **printed).document.source.scans == whole


def test_the_command_writes_a_figure_of_a_document_in_one_small_file(tmp_path):
    document, target = tmp_path / "document.json", tmp_path / "figure.html"
    document.write_text(json.dumps({**tutorial_document().to_json(), "prior": 0.1}))
    assert succeed("app", document, "--export", target).stdout.strip() == str(target)
    assert 50_000 < target.stat().st_size < 400_000
    assert "http" not in target.read_text().split("data-module>")[0]


@pytest.mark.parametrize(("changes", "target", "why"), [
    ({"pose_sigma": 0.1}, "figure.html", "known poses alone"),
    ({"method": "propagate"}, "figure.html", "choose another method"),
    ({}, "figure.pdf", "end its name in one of .html"), ({}, "missing/figure.html", "make it first"),
])  # fmt: skip
def test_what_cannot_be_exported_is_refused_with_the_remedy(tmp_path, changes, target, why):
    document = tmp_path / "document.json"
    document.write_text(json.dumps({**tutorial_document().to_json(), **changes}))
    refused = call("app", document, "--export", tmp_path / target)
    assert refused.exit_code == 3
    assert why in refused.stderr
    assert not (tmp_path / target).exists()


def test_a_log_is_no_figure(office, tmp_path):
    refused = call("app", office, "--export", tmp_path / "figure.html")
    assert refused.exit_code == 3
    assert "is no drawn world" in refused.stderr
