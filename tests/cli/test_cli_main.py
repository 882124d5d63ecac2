"""Help, version, exit codes, and the manners of the streams."""

import os
import re
import shlex
import subprocess
import sys
from ast import literal_eval

import numpy as np
import pytest
from shell import SOURCE, call, refusal_of, start

import bayesmap
from bayesmap.cli import pipeline
from bayesmap.cli.group import COMMANDS

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
    """Run some code in a process of its own, with exit code 0."""
    environment, command = {**os.environ, "PYTHONPATH": str(SOURCE)}, [sys.executable, "-c", code, *arguments]
    environment.pop("OPENBLAS_NUM_THREADS", None)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


def test_help_loads_nothing_heavy():
    python(HELP, *COMMANDS)


def test_infer_loads_no_matcher():
    """A first picture waits for every module that is loaded."""
    loaded = set(literal_eval(python("import sys, bayesmap.api; print(sorted(sys.modules))").stdout))
    assert "bayesmap.api" in loaded
    assert not loaded & {"bayesmap.poses.front_end", "scipy.stats", "scipy.optimize", "scipy.sparse.linalg", "jax"}


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
    result = call(*shlex.split(line))
    assert result.exit_code == 2, result.stderr
    assert result.stdout == ""
    assert "Error" in result.stderr


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
    result = call("infer", office, "-o", tmp_path / "run", "-q")
    assert result.exit_code == code
    assert result.stdout == ""
    assert result.stderr.startswith("bayesmap: error: " + message)
    assert result.stderr.count("\n") == 1
    if error is LOOSE:
        verbose = refusal_of("infer", office, "-o", tmp_path / "run", "-v", code=1)
        assert "Traceback" in verbose
        assert verbose.endswith("bayesmap: error: unexpected RuntimeError: a loose wire\n")


def test_a_reader_that_leaves_is_no_error():
    process = start("config")
    process.stdout.close()
    errors = process.stderr.read()
    process.stderr.close()
    assert process.wait() == 0
    assert errors == ""


def test_what_a_library_says_while_the_process_ends_is_no_result():
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
    from typing import get_args

    from bayesmap.cells.binary import Independent, Ising
    from bayesmap.cells.kinds import BUILT_IN, P_WALL
    from bayesmap.cells.reflectivity import MAX_DRAWS, MIN_DRAWS, Beta
    from bayesmap.cells.surface import Surface
    from bayesmap.cli.keys import Cells, InferSettings, keys_of
    from bayesmap.cli.keys import Method as MethodName
    from bayesmap.cli.keys import Order as OrderName
    from bayesmap.cli.keys import Start as StartName
    from bayesmap.cli.translation import BINARY_DRAWS, completed, prior_of
    from bayesmap.samplers.walls import Order, Start
    from bayesmap.samplers.without_chains import ROUNDS

    assert set(get_args(MethodName)) == {method for kind in BUILT_IN.values() for method in kind.methods}
    assert set(get_args(Cells)) == set(BUILT_IN)
    assert set(get_args(OrderName)) == set(get_args(Order))
    assert set(get_args(StartName)) == set(get_args(Start))
    assert InferSettings().rounds == ROUNDS
    binary = completed(InferSettings(cells="binary"))
    assert prior_of(binary).describe() == Independent(P_WALL).describe()
    coupled = prior_of(InferSettings(cells="binary", coupling=0.5, prior=0.1))
    assert coupled.describe() == Ising(0.1, 0.5).describe()
    assert binary.hit_depth == Independent.hit_depth
    kinds = {name: type(prior_of(completed(InferSettings(cells=name)))) for name in get_args(Cells)}
    assert kinds == {"surface": Surface, "reflectivity": Beta, "binary": Independent}
    labelled = prior_of(completed(InferSettings(cells="surface", coupling=0.5)))
    assert labelled.describe() == Surface(coupling=0.5).describe()
    # The help says what settings are where the user sets none.
    unset = {key.name: key.help.unset for key in keys_of("infer")}
    assert unset["draws"] == f"{MIN_DRAWS}, to {MAX_DRAWS} for few beams; binary {BINARY_DRAWS}"
    assert unset["hit_depth"] == f"{Surface.hit_depth:g}; binary {Independent.hit_depth:g}"
    assert unset["prior"] == f"{P_WALL:g}"
