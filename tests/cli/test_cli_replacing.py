"""A run to be replaced stays until something is in its place; where files cannot grow, nothing is half-written."""

import shutil

import pytest
from shell import interrupt_at_checkpoint, interrupt_at_once, refusal_of, start, succeed
from tiers import full_but

import bayesmap as bm

SLAM = "--fast --resolution 0.5 --threads 2"


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


@pytest.fixture
def finished(office_run, tmp_path):
    """A finished run of its own for each test."""
    return shutil.copytree(office_run, tmp_path / "run")


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
    after = contents(finished)
    assert {name: after[name] for name in before} == before
    # What had begun goes on with its own settings.
    monkeypatch.setattr("bayesmap.api.infer", real)
    succeed("infer", office, "-o", finished, "--resume")
    assert bm.load(finished / "run.nc").posterior.settings["seed"] == 5
    assert contents(finished).keys() == before.keys()


def test_at_the_first_checkpoint_it_goes_with_all_that_was_made_of_it(office, finished, short, monkeypatch):
    interrupt_at_checkpoint(monkeypatch)
    long = "--warmup 20 --draws 400 --checkpoint-every 0"
    refusal_of("infer", office, "-o", finished, *short, long, "--seed 5 --force", code=130)
    assert sorted(contents(finished)) == ["config.toml", "run.nc"]
    assert "seed = 5" in (finished / "config.toml").read_text()


def test_a_full_disk_says_what_is_kept(office, finished, short, monkeypatch):
    def full(self, path, *told):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(bm.Run, "save", full)
    assert "No space left on device; run.nc still holds the run to be replaced" in refusal_of(
        "infer", office, "-o", finished, *short, "--seed 5 --force", code=1
    )
    refusal_of("infer", office, "-o", finished, "--resume", code=1)


def test_the_map_that_names_the_cells_may_be_the_folder_s_own(office, finished, short, monkeypatch):
    long = "--warmup 20 --draws 30 --checkpoint-every 0"
    grid = bm.load(finished / "run.nc").grid
    with monkeypatch.context() as patch:
        interrupt_at_checkpoint(patch)
        options = (*short, long, "--grid", finished / "map.yaml", "--force")
        refusal_of("infer", office, "-o", finished, *options, code=130)
    succeed("infer", office, "-o", finished, "--resume")
    assert bm.load(finished / "run.nc").grid == grid


@pytest.mark.full
def test_a_refused_resume_of_a_trajectory_s_run_changes_nothing(tmp_path):
    log, folder = tmp_path / "office.log", tmp_path / "run"
    succeed(
        "simulate", "--world building --size 12x8 --scans 30 --odometry typical --fov 360 --angles 90 --seed 4 -o", log
    )
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
    output, other = tmp_path / "runs", tmp_path / "other.log"
    other.write_text(office.read_text())
    third = tmp_path / "third.log"
    third.write_text(office.read_text())
    succeed("infer", office, other, "-o", output, *short, "--seed 7")
    succeed("infer", third, "-o", output / "third", *short, "--resume")
    assert bm.load(output / "third" / "run.nc").posterior.settings["seed"] == 0


LIMIT_BYTES = 4096


def written_on_a_full_disk(*arguments):
    """What a command says whose files are cut short."""
    cut = f"import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({LIMIT_BYTES}, {LIMIT_BYTES}))"
    process = start(*arguments, first=cut)
    out, errors = process.communicate()
    assert process.returncode == 1, errors
    assert out == ""
    assert "please report it" not in errors
    return errors.splitlines()[-1]


@pytest.mark.parametrize("name", full_but(["map.bag", "folder", "map.db3", "map.tif"], "folder"))
def test_an_export_onto_a_full_disk_leaves_nothing(office_run, tmp_path, name):
    if name == "map.tif":
        pytest.importorskip("rasterio")
    told = written_on_a_full_disk("export", office_run / "run.nc", "-o", tmp_path / name)
    assert told.startswith(f"bayesmap: error: {tmp_path / name}: ")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_a_picture_onto_a_full_disk_leaves_nothing(office_run, tmp_path):
    told = written_on_a_full_disk("render", office_run / "run.nc", "-o", tmp_path / "map.png")
    assert told == f"bayesmap: error: {tmp_path / 'map.png'}: File too large"
    assert list(tmp_path.iterdir()) == []


def test_a_run_goes_on_without_checkpoints_and_says_in_the_end_what_could_not_be_saved(office, tmp_path, short):
    told = written_on_a_full_disk("infer", office, "-o", tmp_path, *short)
    assert told.startswith(f"bayesmap: error: {tmp_path / 'run.nc'}: writing failed; is the disk full?")
    assert [path.name for path in tmp_path.iterdir()] == ["config.toml"]
