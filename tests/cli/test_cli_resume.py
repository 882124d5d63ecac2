"""Stopped runs: Ctrl-C, SIGKILL, and going on bit for bit."""

import json
import signal

import numpy as np
import pytest
from shell import call, interrupt_at_checkpoint, interrupt_at_once, json_of, refusal_of, start, succeed, wait_for
from tiers import full_but

import bayesmap as bm
from bayesmap.cli.folder import Folder

LONG = "--resolution 0.25 --chains 2 --warmup 20 --draws 30 --no-progress --checkpoint-every 0"
"""Options of a run of some seconds, but for the thinning."""
THIN = {"binary": 400, "reflectivity": 4, "surface": 4}
FIRST = {"binary": 16, "reflectivity": 1, "surface": 1}
"""Sweeps after which there is a first checkpoint: a step of binary walls is as many sweeps as take some time."""

ARRAYS = ("log_likelihood", "log_prior", "warmup_log_joint", "occupancy", "observed")


def same(one, other):
    """Equal draws, traces and ends of the chains, and the same fitted sensor and prior."""
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(one.posterior, name), getattr(other.posterior, name), err_msg=name)
    for what in ("draws", "snapshot"):
        arrays, others = (getattr(run.posterior, what).arrays for run in (one, other))
        assert arrays.keys() == others.keys()
        assert len(arrays) > 0
        for name, values in arrays.items():
            np.testing.assert_array_equal(values, others[name], err_msg=f"{what}: {name}")
    for name, cells in one.posterior.draws.index.items():
        np.testing.assert_array_equal(cells, other.posterior.draws.index[name], err_msg=name)
    assert one.posterior.prior.describe() == other.posterior.prior.describe()
    for name in ("sensor", "sweep", "settings"):
        assert getattr(one.posterior, name) == getattr(other.posterior, name)


def long(cells):
    """Options of a run of some seconds, of this kind of cells."""
    return (LONG, "--cells", cells, "--thin", THIN[cells])


@pytest.fixture(scope="module", params=full_but(["surface", "reflectivity", "binary"], "surface"))
def uninterrupted(request, office, tmp_path_factory):
    """A kind of cells, and the run over them that nothing stopped."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    succeed("infer", office, "-o", folder, *long(request.param), "--checkpoint-every 30")
    return request.param, bm.load(folder / "run.nc")


BOTH = pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))
OTHER_CELLS = {
    "surface": "the saved run is one over reflectivities and surfaces",
    "binary": "the saved run is one over walls",
}


def infer_until_checkpoint(monkeypatch, *arguments):
    """Infer, and press Ctrl-C there."""
    with monkeypatch.context() as patch:
        interrupt_at_checkpoint(patch)
        refusal_of("infer", *arguments, code=130)


@pytest.mark.parametrize("stop", [signal.SIGINT, pytest.param(signal.SIGKILL, marks=pytest.mark.full)])
def test_a_process_that_is_stopped_leaves_a_whole_checkpoint_and_resume_goes_on_bit_for_bit(
    office, tmp_path, uninterrupted, stop
):
    (cells, whole), folder = uninterrupted, tmp_path / "run"
    process = start("infer", office, "-o", folder, *long(cells), "--json")
    wait_for(folder / "run.nc", process)
    process.send_signal(stop)
    out, errors = process.communicate()
    stopped = bm.load(folder / "run.nc")
    assert stopped.posterior.sweep >= FIRST[cells]
    if stop == signal.SIGKILL:
        assert process.returncode == -signal.SIGKILL
    else:
        assert process.returncode == 130, errors
        assert f"bayesmap infer {office} -o {folder} --resume" in errors
        document = json.loads(out)
        assert document["finished"] is stopped.finished is False
        kept = ["map.pgm", "map.yaml", "posterior.png", "run.nc"] if stopped.n_draws else ["run.nc"]
        assert sorted(document["outputs"]) == kept
        assert stopped.posterior.sweep < whole.posterior.sweep
        names, of_map = {path.name for path in folder.iterdir()}, {"map.pgm", "map.yaml", "posterior.png"}
        assert {"config.toml", *kept} <= names <= {"config.toml", "run.nc"} | of_map  # a rough one, if it takes long
    # The settings need not be said again.
    assert json_of("infer", office, "-o", folder, "--resume --json")["finished"] is True
    same(bm.load(folder / "run.nc"), whole)


@BOTH
def test_other_settings_or_another_log_are_refused_and_nothing_is_lost(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    infer_until_checkpoint(monkeypatch, office, "-o", folder, *short, "--cells", cells)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    other = tmp_path / "other.log"
    other.write_text("\n".join(office.read_text().splitlines()[:-1]))
    for arguments, message in (
        ([office, "--seed", "4"], "seed (0, now 4)"),
        ([office, "--draws", "9", "--thin", "2"], "draws (8, now 9); thin (1, now 2)"),
        ([office, "--resolution", "0.5"], "the saved run was made with other"),
        ([office, "--sensor", "mixture:0.03"], "the saved run was made with other sensor ("),
        ([office, "--cells", "reflectivity"], OTHER_CELLS[cells]),
        ([other], "scans or on another grid"),
    ):
        result = call("infer", *arguments, "-o", folder, "--resume")
        assert result.exit_code == 3, result.stderr
        assert message in result.stderr
        assert result.stdout == ""
        assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_resume_where_nothing_was_saved_starts_from_the_beginning(office, tmp_path, short):
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--resume")
    assert "no draws yet; the chains start from the beginning" in result.stderr


@BOTH
def test_resume_of_a_finished_run_changes_nothing(office, tmp_path, short, cells):
    folder = tmp_path / "run"
    succeed("infer", office, "-o", folder, *short, "--cells", cells)
    before = bm.load(folder / "run.nc")
    succeed("infer", office, "-o", folder, "--resume")
    same(bm.load(folder / "run.nc"), before)


@BOTH
def test_an_impatient_ctrl_c_keeps_the_last_checkpoint(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    save = Folder.checkpoint

    def checkpoint(self, run, *told):
        save(self, run)
        raise KeyboardInterrupt

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)
    assert f"the last checkpoint is kept; go on with:\n  bayesmap infer {office}" in refusal_of(
        "infer", office, "-o", folder, *short, "--cells", cells, code=130
    )
    assert bm.load(folder / "run.nc").posterior.sweep == 5


@BOTH
def test_interrupted_among_its_draws_a_run_leaves_its_map_so_far(office, tmp_path, short, monkeypatch, cells):
    folder, save = tmp_path / "run", Folder.checkpoint

    def checkpoint(self, run, *told):
        save(self, run, *told)
        if run.n_draws:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)
    stopped = call("infer", office, "-o", folder, *short, "--cells", cells, "--checkpoint-every", "0", "--draws", "90")
    assert stopped.exit_code == 130
    for name in ("posterior.png", "map.pgm", "map.yaml"):
        assert (folder / name).stat().st_size > 0
    assert 0 < bm.load(folder / "run.nc").n_draws < 90


@BOTH
def test_a_run_interrupted_in_its_warm_up_has_no_draws_yet(office, tmp_path, monkeypatch, cells):
    folder = tmp_path / "run"
    never = "--resolution 0.25 --warmup 20000 --draws 2 --checkpoint-every 0 --chains 1"
    interrupt_at_checkpoint(monkeypatch)
    refusal_of("infer", office, "-o", folder, never, "--cells", cells, code=130)
    run = bm.load(folder / "run.nc")
    assert 0 < run.posterior.sweep < 20000
    for what in ("figure", "mean", "draw", "animation", *(("width", "surfaces") if cells == "surface" else ())):
        assert "the run has no draws yet" in refusal_of("render", folder / "run.nc", "--what", what)
    assert "the run has no draws yet" in refusal_of("export", folder / "run.nc", "-o", tmp_path / "map.yaml")
    with pytest.raises(bm.BadInput, match="stopped before its first draw"):
        run.plot()
    assert json.loads(call("info", folder / "run.nc", "--json").stdout)["run"]["draws"] == 0


@BOTH
def test_interrupted_before_its_first_sweep_nothing_is_kept_but_the_settings(
    office, tmp_path, short, monkeypatch, cells
):
    folder = tmp_path / "run"

    interrupt_at_once(monkeypatch)
    result = call("infer", office, "-o", folder, *short, "--cells", cells, "--json")
    assert result.exit_code == 130
    assert "interrupted before there was anything to save; start again with:" in result.stderr
    document = json.loads(result.stdout)
    assert (document["sweeps"], document["draws"], document["outputs"]) == (0, 0, {})
    assert [path.name for path in folder.iterdir()] == ["config.toml"]


@BOTH
def test_interrupted_as_soon_as_it_is_resumed_a_run_is_what_it_was(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    infer_until_checkpoint(monkeypatch, office, "-o", folder, *short, "--cells", cells)
    before = bm.load(folder / "run.nc")
    go_on = f"go on with:\n  bayesmap infer {office} -o {folder} --resume\n"

    def pressed(*given, **options):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:  # before there are chains that could be stopped in order
        patch.setattr("bayesmap.api.infer", pressed)
        result = call("infer", office, "-o", folder, "--resume")
    assert result.exit_code == 130
    assert f"the last checkpoint is kept; {go_on}" in result.stderr

    with monkeypatch.context() as patch:  # and when there are
        interrupt_at_once(patch)
        result = call("infer", office, "-o", folder, "--resume")
    assert result.exit_code == 130
    assert f"interrupted after 5 sweeps, saved in {folder / 'run.nc'}; {go_on}" in result.stderr
    same(bm.load(folder / "run.nc"), before)


def test_resumed_from_a_file_without_a_sweep_there_is_still_that_file(office, tmp_path, short, monkeypatch):
    folder = tmp_path / "run"
    interrupt_at_once(monkeypatch)
    options = ("--cells binary --start prior", *short)
    scans = bm.read_log(office)
    grid = bm.Grid.covering(scans, 0.25)
    schedule = bm.Schedule(chains=2, warmup=5, draws=8)
    empty = bm.infer(scans, grid, prior=bm.Independent(0.2), sensor=bm.Gaussian(0.1), schedule=schedule)
    folder.mkdir()
    empty.save(folder / "run.nc")
    options = (*options, "--sensor", "gaussian:0.1", "--hit-depth", "0")
    assert f"interrupted before the first sweep; {folder / 'run.nc'} is as it was; go on with:" in refusal_of(
        "infer", office, "-o", folder, *options, "--resume", code=130
    )


@BOTH
def test_a_full_disk_at_a_checkpoint_is_a_warning(office, tmp_path, short, monkeypatch, cells):
    save = bm.Run.save
    calls = []

    def full(self, path, *told):
        calls.append(path)
        if len(calls) == 1:
            raise OSError(28, "No space left on device")
        save(self, path)

    monkeypatch.setattr(bm.Run, "save", full)
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--cells", cells)
    assert "checkpoint could not be written: No space left on device" in result.stderr
