"""Help, exit codes, the streams, and settings: where they come from, which wins, and what is said of mistakes."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from ast import literal_eval
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from shell import SOURCE, call, json_of, refusal_of, start

import bayesmap
from bayesmap import BeamMixture, Beta, Gaussian, Independent, Ising, StudentT, Surface
from bayesmap.cells.kinds import BUILT_IN, P_WALL
from bayesmap.cells.reflectivity import MAX_DRAWS, MIN_DRAWS
from bayesmap.cli import keys, pipeline
from bayesmap.cli.command import as_toml, merge_layers, read_file, read_pairs
from bayesmap.cli.group import COMMANDS
from bayesmap.cli.keys import SECTIONS, ExportSettings, InferSettings, keys_of
from bayesmap.cli.translation import BINARY_DRAWS, completed, prior_of, sensor_of
from bayesmap.errors import BadInput
from bayesmap.samplers import walls
from bayesmap.samplers.without_chains import ROUNDS

HELP = """
import contextlib, io, os, sys
from bayesmap.cli.main import main
assert os.environ["OPENBLAS_NUM_THREADS"] == "1"  # before NumPy is loaded, which reads it
shown = io.StringIO()
for arguments in [["--help"], ["--version"], *([name, "--help"] for name in sys.argv[1:])]:
    with contextlib.redirect_stdout(shown):
        try:
            main(arguments)
        except SystemExit as done:
            assert done.code == 0, done.code
    heavy = {"jax", "warp", "matplotlib", "scipy", "numpy", "netCDF4", "rich", "PIL"} & set(sys.modules)
    assert not heavy, (arguments, heavy)
"""


def python(code, *arguments):
    environment, command = {**os.environ, "PYTHONPATH": str(SOURCE)}, [sys.executable, "-c", code, *arguments]
    environment.pop("OPENBLAS_NUM_THREADS", None)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


def test_help_loads_nothing_heavy():
    python(HELP, *COMMANDS)


def test_a_first_picture_loads_no_matcher_and_no_matplotlib():
    """A first picture waits for every module that is loaded."""
    code = "import sys, bayesmap.api, bayesmap.poses.log_checks, bayesmap.viz.thumbnail; print(sorted(sys.modules))"
    loaded = set(literal_eval(python(code).stdout))
    assert "bayesmap.api" in loaded
    assert not loaded & {"matplotlib", "bayesmap.poses.matcher", "scipy.stats", "scipy.optimize", "scipy.sparse", "jax"}


def test_version():
    assert call("--version").stdout == f"bayesmap, version {bayesmap.__version__}\n"


def test_every_command_is_listed_and_described():
    shown = call("--help").stdout
    for name in COMMANDS:
        assert re.search(rf"^  {name} +\w", shown, re.MULTILINE)
        assert "\\b" not in call(name, "--help").stdout


USAGE = (
    "infre", "infer", "infer x.log --no-such-flag", "infer x.log --chains two", "infer x.log --method magic",
    "infer x.log --set chains", "infer x.log --set chians=2", "infer x.log --resume --force", "infer ''",
    "infer x.log -o ''", "infer x.log --scan-topic ''", "demo -o ''", "simulate -o scans.txt", "simulate --pose here",
    "simulate --pose nan,0,0",
)  # fmt: skip


@pytest.mark.parametrize("line", USAGE)
def test_usage_errors_exit_2(line):
    assert "Error" in refusal_of(*shlex.split(line), code=2)


def test_a_mistyped_command_gets_a_suggestion():
    assert "did you mean 'infer'" in call("infre").stderr


LOOSE = RuntimeError("a loose wire")


@pytest.mark.parametrize(("error", "code", "message"), [
    (LOOSE, 1, "unexpected RuntimeError: a loose wire; -v shows where"),
    (OSError(28, "No space left on device", "run.nc"), 1, "run.nc: No space left on device"),
    (PermissionError(13, "Permission denied", "x.log"), 3, "x.log: Permission denied; name another file or folder"),
    (MemoryError(), 1, "out of memory"),
    (RuntimeError("Failed to allocate 99 bytes on device 'cpu'"), 1, "out of memory"),
    (KeyboardInterrupt(), 130, "interrupted"), (bayesmap.BadInput("two\nlines"), 3, "two lines"),
])  # fmt: skip
def test_failures_are_one_line_and_verbose_shows_the_traceback(monkeypatch, office, tmp_path, error, code, message):
    def fail(*arguments, **options):
        raise error

    monkeypatch.setattr(pipeline, "sample", fail)
    told = refusal_of("infer", office, "-o", tmp_path / "run", "-q", code=code)
    assert told.startswith("bayesmap: error: " + message)
    assert told.count("\n") == 1
    if error is LOOSE:
        verbose = refusal_of("infer", office, "-o", tmp_path / "run", "-v", code=1)
        assert "Traceback" in verbose
        assert verbose.endswith("bayesmap: error: unexpected RuntimeError: a loose wire\n")


def test_a_reader_that_leaves_is_no_error():
    process = start("config")
    process.stdout.close()
    errors = process.stderr.read()
    process.stderr.close()
    assert (process.wait(), errors) == (0, "")


def test_words_of_a_library_at_the_process_s_end_are_not_on_standard_output():
    code = (
        "import atexit\nfrom bayesmap.cli.main import main\n"
        "atexit.register(lambda: print('nodes are dead'))\nmain(['config'])\n"
    )
    done = python(code)
    assert "[demo]" in done.stdout
    assert "nodes are dead" not in done.stdout
    assert "nodes are dead" in done.stderr


def test_peak_memory_is_that_of_this_process_not_of_the_one_that_started_it():
    ours = np.ones(1 << 26)  # half a gigabyte
    done = python("from bayesmap.cli.folder import peak_memory_mb; print(peak_memory_mb())")
    assert 5 < float(done.stdout) < 200 < ours.nbytes / 1e6


def test_choices_are_those_of_the_library():
    assert set(get_args(keys.Method)) == {method for kind in BUILT_IN.values() for method in kind.methods}
    assert set(get_args(keys.Cells)) == set(BUILT_IN)
    assert set(get_args(keys.Order)) == set(get_args(walls.Order))
    assert set(get_args(keys.Start)) == set(get_args(walls.Start))
    assert InferSettings().rounds == ROUNDS
    binary = completed(InferSettings(cells="binary"))
    assert prior_of(binary).describe() == Independent(P_WALL).describe()
    assert prior_of(InferSettings(cells="binary", coupling=0.5, prior=0.1)).describe() == Ising(0.1, 0.5).describe()
    assert binary.hit_depth == Independent.hit_depth
    kinds = {name: type(prior_of(completed(InferSettings(cells=name)))) for name in get_args(keys.Cells)}
    assert kinds == {"surface": Surface, "reflectivity": Beta, "binary": Independent}
    labelled = prior_of(completed(InferSettings(cells="surface", coupling=0.5)))
    assert labelled.describe() == Surface(coupling=0.5).describe()
    # The help says what settings are where the user sets none.
    unset = {key.name: key.help.unset for key in keys_of("infer")}
    assert unset["draws"] == f"{MIN_DRAWS}, to {MAX_DRAWS} for few beams; binary {BINARY_DRAWS}"
    assert unset["hit_depth"] == f"{Surface.hit_depth:g}; binary {Independent.hit_depth:g}"
    assert unset["prior"] == f"{P_WALL:g}"


ROOT = Path(__file__).resolve().parents[2]

STAND_IN = """#!/bin/sh
mkdir -p .venv
for file in $PIP_CONSTRAINT; do test -f "$file" && echo "$file" >> asked; done
"""
"""Notes which of the constraint files that pip would read, blank for blank, are there."""


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make")
@pytest.mark.skipif(not (ROOT / "Makefile").exists(), reason="not a checkout")
def test_a_checkout_may_lie_under_a_folder_with_blanks(tmp_path):
    checkout = tmp_path / "my own maps"
    (checkout / "bin").mkdir(parents=True)
    for name in ("Makefile", "pyproject.toml", "constraints.txt"):
        shutil.copy(ROOT / name, checkout)
    stand_in = checkout / "bin" / "python"
    stand_in.write_text(STAND_IN)
    stand_in.chmod(0o755)
    command = ["make", "-C", str(checkout), "PYTHON=bin/python", "BIN=bin", ".venv/core"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (checkout / "asked").read_text().split() == ["constraints.txt"]
    assert (checkout / ".venv" / "core").exists()


def write(folder, text):
    path = folder / "my.toml"
    path.write_text(text)
    return path


def test_the_printed_configuration_is_the_effective_one(tmp_path):
    first = call("config").stdout
    assert tomllib.loads(first).keys() == SECTIONS.keys()
    path = write(tmp_path, first)
    assert call("config", "-c", path).stdout == first
    assert read_file(path).keys() == SECTIONS.keys()
    for section, settings in SECTIONS.items():
        assert merge_layers(section, read_file(path)) == settings()


def test_every_kind_of_value_survives_the_round_trip(tmp_path):
    set_ = ["no_return=inf", "max_range=20", "sensor=student-t:0.1,dof=4", 'world=my "map" 🗺\x7f.txt']
    printed = call("config", *[part for pair in set_ for part in ("--set", pair)]).stdout
    assert call("config", "-c", write(tmp_path, printed)).stdout == printed
    values = tomllib.loads(printed)["infer"]
    assert (values["no_return"], values["max_range"]) == (float("inf"), 20.0)
    assert tomllib.loads(printed)["simulate"]["world"] == 'my "map" 🗺\x7f.txt'


def test_json_is_one_document():
    document = json.loads(call("config", "--json --set no_return=inf").stdout)
    assert (document["schema_version"], document["settings"]["infer"]["no_return"]) == (1, "inf")


def test_flags_win_over_set_over_file_over_defaults(office, tmp_path, short):
    path = write(tmp_path, "draws = 3\n[infer]\nchains = 1\nwarmup = 1\nthin = 2\n")
    options = "--set warmup=2 --set thin=3 --thin 1 --json --resolution 0.25 --cells binary"
    document = json_of("infer", office, "-o", tmp_path / "run", "-c", path, options)
    asked = {name: document[name] for name in ("draws", "chains", "warmup", "thin", "order")}
    assert asked == {"draws": 3, "chains": 1, "warmup": 2, "thin": 1, "order": "radial"}


def test_a_bare_key_holds_for_all_commands_that_have_it(tmp_path):
    layer = read_file(write(tmp_path, "seed = 7\n[demo]\nseed = 8\n"))
    assert [merge_layers(section, layer).seed for section in ("infer", "simulate", "demo")] == [7, 7, 8]
    assert read_pairs(["seed=3"], "infer") == {"infer": {"seed": 3}}
    assert read_pairs(["demo.seed=3"], "infer") == {"demo": {"seed": 3}}


@pytest.mark.parametrize(("text", "message"), [
    ("[infer]\nresoluton = 1\n", "did you mean 'resolution'?"),
    ("[infer]\nmax-range = 1\n", "did you mean 'max_range'?"), ("[infre]\nchains = 1\n", "did you mean 'infer'?"),
    ("chians = 1\n", "did you mean 'chains'?"),
    ("[infer]\nchains = 'two'\n", "chains must be a whole number of 1 or more, got 'two'"),
    ("[infer]\nchains = 2.5\n", "chains must be a whole number of 1 or more, got 2.5"),
    ("[infer]\nstrict = 1\n", "strict must be true or false, got 1"),
    ("[infer]\nprior = true\n", "prior must be a number from 0 to 1, got True"),
    ("[infer]\ncoupling = true\n", "coupling must be a number from 0 to 50, or fit, got True"),
    ('[infer]\ncoupling = "some"\n', "coupling must be a number from 0 to 50, or fit, got 'some'"),
    ("[infer]\nmethod = 'magic'\n", "method must be one of gibbs, block, propagate, importance, exact, got"),
    ("seed = -1\n", "--seed must be a whole number of 0 or more, got -1"), ("[infer\n", "not valid TOML"),
])  # fmt: skip
def test_mistakes_in_a_file_exit_3_and_name_it(tmp_path, text, message):
    path = write(tmp_path, text)
    refusal = refusal_of("config", "-c", path)
    assert refusal.startswith(f"bayesmap: error: {path}: ")
    assert message in refusal


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(BadInput, match=r"nothing\.toml: cannot be read"):
        read_file(tmp_path / "nothing.toml")


def test_only_one_section_is_printed_where_only_one_is_given():
    lines = as_toml({"export": ExportSettings(mode="scale")}).splitlines()
    assert [line for line in lines if line.startswith("[")] == ["[export]"]
    assert (
        'mode = "scale"       # Occupied, free and unknown; or per cent. One of trinary, scale, raw. '
        "Default: trinary for map-server, scale for recordings."
    ) in lines


@pytest.mark.parametrize(("text", "model"), [
    ("default", None), ("gaussian:0.2", Gaussian(0.2)), ("gaussian:0.02,sigma_per_m=0.005", Gaussian(0.02, 0.005)),
    ("gaussian:sigma_m=0.1", Gaussian(0.1)), ("student-t:0.1,dof=3", StudentT(0.1, 3.0)), ("mixture", BeamMixture()),
    ("mixture:0.1,p_random=0.2", BeamMixture(Gaussian(0.1), p_random=0.2)),
    ("mixture:0.1,noise=student-t,dof=2", BeamMixture(StudentT(0.1, 2.0))),
])  # fmt: skip
def test_sensor_models_as_they_are_typed(text, model):
    assert sensor_of(text) == model


@pytest.mark.parametrize(("text", "message"), [
    ("laser", "unknown kind 'laser'; known: default, fit (of infer), gaussian"),
    ("gaussian", "gaussian needs its sigma_m, as in gaussian:0.05"),
    ("gaussian:-0.2", "sigma_m must be a positive number of metres, got -0.2"),
    ("gaussian:nan", "sigma_m must be a positive number"), ("gaussian:wide", "'wide' is not a number"),
    ("gaussian:0.1,0.2", "write '0.2' as name=value"), ("gaussian:0.1,sigma=2", "no parameter 'sigma'"),
    ("mixture:0.1,noise=pink", "noise must be gaussian or student-t"),
    ("mixture:0.1,p_random=2", "p_random must lie inside"),
])  # fmt: skip
def test_mistakes_in_a_sensor_model_are_named(text, message):
    with pytest.raises(BadInput, match=re.escape(message)):
        sensor_of(text)
