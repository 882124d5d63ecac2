"""Stopped runs go on bit for bit, and a run to be replaced stays until something is in its place."""

import json
import shutil
import signal

import pytest
from samplers.stop_rooms import assert_same
from shell import (
    call,
    contents,
    interrupt_at_checkpoint,
    interrupt_at_once,
    json_of,
    refusal_of,
    start,
    succeed,
    wait_for,
)
from tiers import full_but

import bayesmap as bm

LONG = "--resolution 0.25 --chains 2 --warmup 20 --draws 30 --no-progress --checkpoint-every 0"
"""Options of a run of some seconds, but for the thinning."""
THIN = {"binary": 400, "reflectivity": 4, "surface": 4}
FIRST = {"binary": 16, "reflectivity": 1, "surface": 1}
"""Sweeps after which there is a first checkpoint: a step of binary walls is as many sweeps as take some time."""


def long(cells):
    """Return options of a run of some seconds over a kind of cells."""
    return (LONG, "--cells", cells, "--thin", THIN[cells])


@pytest.fixture(scope="module", params=full_but(["surface", "reflectivity", "binary"], "surface"))
def uninterrupted(request, office, tmp_path_factory):
    """A kind of cells, and the run over them that nothing stopped."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    succeed("infer", office, "-o", folder, *long(request.param), "--checkpoint-every 30")
    return request.param, bm.load(folder / "run.nc")


BOTH = pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))


@pytest.fixture
def finished(office_run, tmp_path):
    """A finished run of its own for each test."""
    return shutil.copytree(office_run, tmp_path / "run")


def infer_until_checkpoint(monkeypatch, *arguments):
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
        assert stopped.posterior.sweep < whole.posterior.sweep
        assert {"config.toml", "run.nc"} <= {path.name for path in folder.iterdir()} == document["outputs"].keys()
    # The settings need not be said again.
    assert json_of("infer", office, "-o", folder, "--resume --json")["finished"] is True
    resumed = bm.load(folder / "run.nc")
    assert_same(resumed, whole)
    assert resumed.posterior.settings == whole.posterior.settings


@BOTH
def test_other_settings_or_another_log_are_refused_and_nothing_is_lost(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    infer_until_checkpoint(monkeypatch, office, "-o", folder, *short, "--cells", cells)
    before, kind = contents(folder), {"surface": "reflectivities and surfaces", "binary": "walls"}[cells]
    other = tmp_path / "other.log"
    other.write_text("\n".join(office.read_text().splitlines()[:-1]))
    for arguments, message in (
        ([office, "--seed", "4"], "seed (0, now 4)"),
        ([office, "--draws", "9", "--thin", "2"], "draws (8, now 9); thin (1, now 2)"),
        ([office, "--resolution", "0.5"], "the saved run was made with other"),
        ([office, "--sensor", "mixture:0.03"], "the saved run was made with other sensor ("),
        ([office, "--cells", "reflectivity"], f"the saved run is one over {kind}"),
        ([other], "scans or on another grid"),
    ):
        assert message in refusal_of("infer", *arguments, "-o", folder, "--resume")
        assert contents(folder) == before


def test_resume_where_nothing_was_saved_starts_from_the_beginning(office, tmp_path, short):
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--resume")
    assert "not there yet, as no sweep was saved; the chains start anew" in result.stderr


def test_resume_of_a_finished_run_changes_nothing(office, finished):
    before = bm.load(finished / "run.nc")
    succeed("infer", office, "-o", finished, "--resume")
    assert_same(bm.load(finished / "run.nc"), before)


def interrupt(*_, **options):
    raise KeyboardInterrupt


def test_an_impatient_ctrl_c_keeps_the_last_checkpoint(office, tmp_path, short, monkeypatch):
    interrupt_at_checkpoint(monkeypatch, interrupt)
    refusal = refusal_of("infer", office, "-o", tmp_path / "run", *short, code=130)
    assert f"the last checkpoint is kept; go on with:\n  bayesmap infer {office}" in refusal
    assert bm.load(tmp_path / "run" / "run.nc").posterior.sweep == 5


@BOTH
def test_interrupted_among_its_draws_a_run_leaves_its_map_so_far(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    interrupt_at_checkpoint(monkeypatch, lambda run: signal.raise_signal(signal.SIGINT) if run.n_draws else None)
    refusal_of("infer", office, "-o", folder, *short, "--checkpoint-every 0 --draws 90 --cells", cells, code=130)
    for name in ("posterior.png", "map.pgm", "map.yaml"):
        assert (folder / name).stat().st_size > 0
    assert 0 < bm.load(folder / "run.nc").n_draws < 90


@BOTH
def test_a_run_interrupted_in_its_warm_up_has_no_draws_yet(office, tmp_path, monkeypatch, cells):
    folder = tmp_path / "run"
    never = "--resolution 0.25 --warmup 20000 --draws 2 --checkpoint-every 0 --chains 1"
    infer_until_checkpoint(monkeypatch, office, "-o", folder, never, "--cells", cells)
    run = bm.load(folder / "run.nc")
    assert 0 < run.posterior.sweep < 20000
    for what in ("figure", "mean", "draw", "animation", *(("width", "surfaces") if cells == "surface" else ())):
        assert "the run has no draws yet" in refusal_of("render", folder / "run.nc", "--what", what)
    assert "the run has no draws yet" in refusal_of("export", folder / "run.nc", "-o", tmp_path / "map.yaml")
    with pytest.raises(bm.BadInput, match="stopped before its first draw"):
        run.plot()
    assert json_of("info", folder / "run.nc", "--json")["run"]["draws"] == 0


def test_interrupted_before_its_first_sweep_no_run_is_kept_but_the_settings(office, tmp_path, short, monkeypatch):
    folder = tmp_path / "run"
    interrupt_at_once(monkeypatch)
    result = call("infer", office, "-o", folder, *short, "--json")
    assert result.exit_code == 130
    assert "interrupted before there was anything to save; start again with:" in result.stderr
    document = json.loads(result.stdout)
    assert (document["sweeps"], document["draws"]) == (0, 0)
    names = {"config.toml", "map.pgm", "map.yaml", "posterior.png"}
    assert {path.name for path in folder.iterdir()} == document["outputs"].keys() == names


@BOTH
def test_interrupted_as_soon_as_it_is_resumed_a_run_is_what_it_was(office, tmp_path, short, monkeypatch, cells):
    folder = tmp_path / "run"
    infer_until_checkpoint(monkeypatch, office, "-o", folder, *short, "--cells", cells)
    before = bm.load(folder / "run.nc")
    go_on = f"go on with:\n  bayesmap infer {office} -o {folder} --resume\n"

    with monkeypatch.context() as patch:  # before there are chains that could be stopped in order
        patch.setattr("bayesmap.api.infer", interrupt)
        refusal = refusal_of("infer", office, "-o", folder, "--resume", code=130)
    assert f"the last checkpoint is kept; {go_on}" in refusal
    with monkeypatch.context() as patch:  # and when there are
        interrupt_at_once(patch)
        refusal = refusal_of("infer", office, "-o", folder, "--resume", code=130)
    assert f"interrupted after 5 sweeps, saved in {folder / 'run.nc'}; {go_on}" in refusal
    assert_same(bm.load(folder / "run.nc"), before)


def test_resumed_from_a_file_without_a_sweep_there_is_still_that_file(office, tmp_path, short, monkeypatch):
    interrupt_at_once(monkeypatch)
    scans = bm.read_log(office)
    schedule = bm.Schedule(chains=2, warmup=5, draws=8)
    model = {"prior": bm.Independent(0.2), "sensor": bm.Gaussian(0.1), "schedule": schedule}
    bm.infer(scans, bm.Grid.covering(scans, 0.25), **model).save(tmp_path / "run.nc")
    options = ("--cells binary --start prior --sensor gaussian:0.1 --hit-depth 0 --resume", *short)
    refusal = refusal_of("infer", office, "-o", tmp_path, *options, code=130)
    assert f"interrupted before the first sweep; {tmp_path / 'run.nc'} is as it was; go on with:" in refusal


def test_a_full_disk_at_a_checkpoint_is_a_warning(office, tmp_path, short, monkeypatch):
    save, full = bm.Run.save, [True]

    def save_but_once(self, path, *told):
        if full:
            full.clear()
            raise OSError(28, "No space left on device")
        save(self, path)

    monkeypatch.setattr(bm.Run, "save", save_but_once)
    warnings = succeed("infer", office, "-o", tmp_path / "run", *short).stderr
    assert "checkpoint could not be written: No space left on device" in warnings


SLAM = "--fast --resolution 0.5 --threads 2"


def test_interrupted_before_the_first_sweep_it_is_as_it_was(office, finished, short, monkeypatch):
    before = contents(finished)
    interrupt_at_once(monkeypatch)
    result = refusal_of("infer", office, "-o", finished, *short, "--seed 5 --force", code=130)
    assert "interrupted before there was anything to save" in result
    assert "is as it was" in result
    assert contents(finished) == before


@pytest.mark.parametrize("where", full_but(["propagate", "warm-up"], "warm-up"))
def test_out_of_memory_before_the_first_checkpoint_it_is_as_it_was(office, finished, short, monkeypatch, where):
    before, real = contents(finished), bm.api.infer

    def infer(*given, on_progress, **options):
        def told(event):
            on_progress(event)
            if event.stage == where:
                raise MemoryError

        return real(*given, on_progress=told, **options)

    monkeypatch.setattr("bayesmap.api.infer", infer)
    options = ("--cells binary --start propagate",) if where == "propagate" else ()
    assert "out of memory" in refusal_of("infer", office, "-o", finished, *short, *options, "--seed 5 --force", code=1)
    assert contents(finished).items() >= before.items()
    # What had begun goes on with its own settings.
    monkeypatch.setattr("bayesmap.api.infer", real)
    succeed("infer", office, "-o", finished, "--resume")
    assert bm.load(finished / "run.nc").posterior.settings["seed"] == 5
    assert contents(finished).keys() ^ before.keys() == ({"surfaces.png"} if where == "propagate" else set())


def test_the_first_checkpoint_removes_the_old_run_and_its_products(office, finished, short, monkeypatch):
    more = "--warmup 20 --draws 400 --checkpoint-every 0 --seed 5 --force"
    infer_until_checkpoint(monkeypatch, office, "-o", finished, *short, more)
    assert sorted(contents(finished)) == ["config.toml", "run.nc"]
    assert "seed = 5" in (finished / "config.toml").read_text()


def test_a_full_disk_says_what_is_kept(office, finished, short, monkeypatch):
    def full(self, path, *told):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(bm.Run, "save", full)
    refusal = refusal_of("infer", office, "-o", finished, *short, "--seed 5 --force", code=1)
    assert "No space left on device; run.nc still holds the run to be replaced" in refusal
    refusal_of("infer", office, "-o", finished, "--resume", code=1)


def test_the_map_that_names_the_cells_may_be_the_folder_s_own(office, finished, short, monkeypatch):
    grid = bm.load(finished / "run.nc").grid
    options = (*short, "--warmup 20 --draws 30 --checkpoint-every 0 --force --grid", finished / "map.yaml")
    infer_until_checkpoint(monkeypatch, office, "-o", finished, *options)
    succeed("infer", office, "-o", finished, "--resume")
    assert bm.load(finished / "run.nc").grid == grid


@pytest.mark.full
def test_a_refused_resume_of_a_trajectory_s_run_changes_nothing(tmp_path):
    log, folder = tmp_path / "office.log", tmp_path / "run"
    world = "--world building --size 12x8 --scans 30 --odometry typical --fov 360 --angles 90 --seed 4"
    succeed("simulate", world, "-o", log)
    succeed("slam", log, "-o", folder, SLAM)
    before = contents(folder)
    for changed in (("--chains 3",), ("--resolution 0.4",), ("--seed 9",)):
        refusal_of("slam", log, "-o", folder, "--resume", *changed)
        assert contents(folder) == before
    succeed("slam", log, "-o", folder, "--resume")
    assert bm.load(folder / "run.nc").finished


def test_a_run_of_infer_is_not_resumed_as_one_of_slam(office, finished):
    before = contents(finished)
    refusal_of("slam", office, "-o", finished, "--resume --no-odometry")
    assert contents(finished) == before
    succeed("infer", office, "-o", finished, "--resume")


@pytest.mark.full
def test_settings_of_a_fleet_are_not_those_of_a_log_that_was_not_in_it(office, tmp_path, short):
    output = tmp_path / "runs"
    other, third = (shutil.copy(office, tmp_path / name) for name in ("other.log", "third.log"))
    succeed("infer", office, other, "-o", output, *short, "--seed 7")
    succeed("infer", third, "-o", output / "third", *short, "--resume")
    assert bm.load(output / "third" / "run.nc").posterior.settings["seed"] == 0


LIMIT_BYTES = 4096


def written_on_a_full_disk(*arguments):
    """Return the last line of a command whose files are cut short."""
    cut = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({LIMIT_BYTES}, {LIMIT_BYTES}))"
    process = start(*arguments, first=cut)
    out, errors = process.communicate()
    assert process.returncode == 1, errors
    assert out == ""
    assert "please report it" not in errors
    return errors.splitlines()[-1]


@pytest.mark.parametrize("name", full_but(["map.bag", "folder", "map.db3", "map.tif", "map.png"], "folder"))
def test_an_export_or_a_picture_onto_a_full_disk_leaves_nothing(office_run, tmp_path, name):
    if name == "map.tif":
        pytest.importorskip("rasterio")
    command = "render" if name == "map.png" else "export"
    told = written_on_a_full_disk(command, office_run / "run.nc", "-o", tmp_path / name)
    assert told.startswith(f"bayesmap: error: {tmp_path / name}: ")
    assert list(tmp_path.iterdir()) == []


def test_a_run_goes_on_without_checkpoints_and_says_in_the_end_what_could_not_be_saved(office, tmp_path, short):
    told = written_on_a_full_disk("infer", office, "-o", tmp_path, *short)
    assert told.startswith(f"bayesmap: error: {tmp_path / 'run.nc'}: writing failed; is the disk full?")
    assert [path.name for path in tmp_path.iterdir()] == ["config.toml"]
