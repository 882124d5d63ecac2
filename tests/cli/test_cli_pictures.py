"""demo, simulate, render and export: files that open, and truth that comes back."""

import json
from typing import get_args

import numpy as np
import pytest
from PIL import Image
from shell import call, json_of, refusal_of, succeed
from tiers import full_but, latin

import bayesmap as bm
from bayesmap.cli.folder import DERIVED
from bayesmap.cli.keys import Picture
from bayesmap.cli.render import default_name
from bayesmap.cli.translation import odometry_of
from bayesmap.errors import BadInput
from bayesmap.io.logs import describe_log
from bayesmap.io.ros.maps import read_map
from bayesmap.io.text.trajectories import read_trajectory
from bayesmap.sim.robot import OdometryNoise
from bayesmap.space.planar import between, compose, interpolate


def test_a_demo_leaves_runs_films_and_a_document(tmp_path):
    folder = tmp_path / "demo"
    document = json_of("demo", "-o", folder, "--draws 200 --particles 5000 --json")
    assert json.loads((folder / "demo.json").read_text()) == document
    assert {path.name for path in folder.iterdir()} == set(document["outputs"])
    assert document["runs"].keys() == {"gibbs", "block", "importance", "film"}
    assert document["runs"]["importance"]["diagnostics"]["effective_sample_size"] < 10
    assert document["heldout"] is None
    for ending in ("gif", "webp"):
        with Image.open(folder / f"chain.{ending}") as film:
            assert film.n_frames > 10
    run = bm.load(folder / "run.nc")
    walls, _ = bm.worlds.tutorial()
    sure = (run.occupancy < 0.05) | (run.occupancy > 0.95)
    assert sure.sum() > 150
    assert ((run.occupancy > 0.5) == walls)[sure].mean() > 0.98
    # A demo may be repeated, but other people's runs are safe from it.
    (folder / "demo.json").unlink()
    refusal_of("demo", "-o", folder)


def render(run, what, folder, *options):
    target = folder / ("film.gif" if what == "animation" else "picture.png")
    assert succeed("render", run, "--what", what, "-o", target, *options).stdout == f"{target}\n"
    with Image.open(target) as image:
        assert image.size[0] > 400


@pytest.mark.parametrize("what", ["figure", "mean", "entropy", "width", "draw", "trace"])
def test_pictures_of_surfaces(office, office_run, tmp_path, what):
    truth = ["--truth", office.with_name("office-truth.yaml")] if what in ("figure", "mean") else []
    render(office_run / "run.nc", what, tmp_path, *truth)


BINARY = ("figure", "mean", "deviation", "draw", "animation", "residuals", "log-odds")


@pytest.mark.parametrize("what", full_but(BINARY, "figure", "deviation", "animation"))
def test_pictures_of_binary_walls(office, held_out, tmp_path, what):
    unseen = ["--heldout", office, "--holdout 4"] if what == "residuals" else []
    render(held_out("binary")[0], what, tmp_path, *unseen)


WINDOWS = latin(3, ["residuals", "surprise", "log-odds"], [None, "observed", "0,6,-1,5"])


@pytest.mark.parametrize(("what", "window"), WINDOWS)
def test_pictures_of_what_others_and_unseen_scans_say(office, held_out, tmp_path, what, window):
    unseen = ["--heldout", office, "--holdout 4"] if what != "log-odds" else []
    render(held_out("surface")[0], what, tmp_path, *unseen, *(["--window", window] if window else []))


def test_residuals_of_scans_that_were_seen_are_refused(office, office_run, held_out, tmp_path):
    for run, every in ((office_run / "run.nc", 4), (held_out("surface")[0], 2), (held_out("surface")[0], 0)):
        options = ("--what residuals --heldout", office, "--holdout", every, "-o", tmp_path / "picture.png")
        refusal_of("render", run, *options)
    assert list(tmp_path.iterdir()) == []


def test_binary_walls_have_no_interval_and_no_surfaces_and_other_cells_have(held_out, office_run, tmp_path):
    for what, message in (("width", "a wall has no interval"), ("surfaces", "--cells surface")):
        assert message in refusal_of("render", held_out("binary")[0], "--what", what, "-o", tmp_path / "no.png")
        succeed("render", office_run / "run.nc", "--what", what, "-o", tmp_path / f"{what}.png")
    assert {path.name for path in tmp_path.iterdir()} == {"width.png", "surfaces.png"}
    assert "--what width" in refusal_of("render", office_run / "run.nc", "--what deviation -o", tmp_path / "no.png")


def test_layers_of_walls_and_of_surfaces_in_a_geotiff(held_out, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    for cells, names in (("binary", ("mean", "entropy")), ("surface", ("mean", "entropy", "lower", "upper"))):
        succeed("export", held_out(cells)[0], "-o", tmp_path / "map.tif", "--force")
        with rasterio.open(tmp_path / "map.tif") as file:
            assert file.descriptions == names
            layers = file.read()
        if len(names) == 4:
            known = ~np.isnan(layers[0])
            assert (layers[2] <= layers[3])[known].all()
            # Means are of what the draws expect, ends of what was drawn: with few draws they miss by a little.
            assert (np.maximum(layers[2] - layers[0], layers[0] - layers[3])[known] < 0.05).mean() > 0.9


def test_render_animation_and_default_names(office_run, tmp_path):
    copy = tmp_path / "run.nc"
    copy.write_bytes((office_run / "run.nc").read_bytes())
    for what, name in (("animation", "animation.gif"), ("figure", "figure.png"), ("entropy", "entropy.png")):
        document = json.loads(call("render", copy, "--what", what, "--json --frames 3").stdout)
        assert document["outputs"] == {name: str(tmp_path / name)}
        succeed("render", copy, "--what", what, "--frames 3")  # replaces its own picture, but no other program's
    Image.new("RGB", (9, 9)).save(tmp_path / "entropy.png")
    assert "entropy.png: exists already; --force replaces it" in refusal_of("render", copy, "--what entropy")
    with Image.open(tmp_path / "animation.gif") as film:
        assert film.n_frames == 3
    own = {default_name(what) for what in get_args(Picture)} | {"plan.png", "explore.png", "export.yaml", "export.pgm"}
    demo = {"posterior-block.png", "posterior-importance.png", "weights-importance.png", "chain.gif"}
    assert not own & {*DERIVED, *demo}


def test_render_says_what_it_cannot_draw(office_run, tmp_path):
    for arguments, message in (
        (["--what weights"], "no importance weights"),
        (["--what draw --draw 99"], "this run has 8 draws a chain"),
        (["--what draw --chain 3"], "this run has chains 1 to 2"),
        (["--what animation -o", tmp_path / "film.png"], ".gif, .webp"),
        (["-o", tmp_path / "picture.jpg"], ".png, .pdf, .svg"),
        (["--what residuals"], "give --heldout LOG"),
        (["--what surprise --heldout", tmp_path / "no.log"], "no.log"),
        (["--what mean --window 1,2"], "give X0,X1,Y0,Y1 in metres"),
        (["--what mean --window 900,901,0,1"], "lies outside the map"),
        (["--window observed"], "figure shows the whole map"),
    ):
        assert message in refusal_of("render", office_run / "run.nc", *arguments)


def test_exported_maps_are_those_of_the_run(office_run, tmp_path):
    run = bm.load(office_run / "run.nc")
    for mode in ("trinary", "scale"):
        target = tmp_path / f"{mode}.yaml"
        succeed("export", office_run / "run.nc", "-o", target, "--mode", mode)
        occupancy, grid = read_map(target)
        assert (grid, "map of map_server or nav2, no log" in call("info", target).stdout) == (run.grid, True)
        known = ~np.isnan(occupancy)
        if mode == "scale":
            assert not (known & ~run.observed).any()
            assert (run.occupancy[run.observed & ~known] < 0.1).all()  # few beams passed these
            np.testing.assert_allclose(occupancy[known], run.occupancy[known], atol=0.011)
    endings = ".yaml, .yml, .bag, .mcap, .db3, .rrd, .tum, .g2o, .tif, .tiff"
    for name, message in (("map.txt", endings), ("nowhere/map.yaml", "no such folder; make it first")):
        assert message in refusal_of("export", office_run / "run.nc", "-o", tmp_path / name)


@pytest.mark.parametrize("name", ["map.yaml", "map.bag", "map.mcap", "map.db3", "map", "map.rrd", "map.tum", "map.tif"])
def test_export_to_every_format_and_never_over_an_old_file_unasked(office_run, tmp_path, name):
    if name in ("map.rrd", "map.tif"):
        pytest.importorskip({"map.rrd": "rerun", "map.tif": "rasterio"}[name])
    target = tmp_path / name
    outputs = json_of("export", office_run / "run.nc", "-o", target, "--json")["outputs"]
    assert outputs[name] == str(target)
    assert set(outputs) == {path.name for path in tmp_path.iterdir()}
    assert "exists already; --force replaces it" in refusal_of("export", office_run / "run.nc", "-o", target)
    succeed("export", office_run / "run.nc", "-o", target, "--force")


def test_export_of_layers_in_a_recording(office_run, tmp_path):
    from mcap.reader import make_reader

    succeed("export", office_run / "run.nc", "-o", tmp_path / "map.mcap", "--format gridmap")
    with open(tmp_path / "map.mcap", "rb") as file:
        assert [schema.name for schema, _, _ in make_reader(file).iter_messages()] == ["grid_map_msgs/msg/GridMap"]
    refusal = refusal_of("export", office_run / "run.nc", "-o", tmp_path / "map.tum", "--mode raw")
    assert "tum keeps the numbers and takes no mode" in refusal


def test_simulate_worlds_from_files(tmp_path):
    drawing, truth = tmp_path / "room.txt", tmp_path / "scan-truth.yaml"
    drawing.write_text("XXXXX\nX...X\nX...X\nXXXXX\n")
    scan = ("--pose 1.5,2.5,0 -o", tmp_path / "scan.log.gz")
    assert json_of("simulate", "--world", drawing, "--pose 2.5,2.5,90", *scan, "--json")["scans"] == 2
    assert read_map(truth)[0].shape == (4, 5)
    assert "--force replaces it" in refusal_of("simulate", "--world", truth, *scan)
    succeed("simulate", "--world", truth, "--pose 1.5,2.5,0 -o", tmp_path / "again.log")
    succeed("simulate", "--world", tmp_path / "scan-truth.pgm", "--pose 0.15,0.25,0 -o", tmp_path / "p.log")
    refusal_of("simulate", "--world", drawing, "-o", tmp_path / "q.log", code=2)


SMALL = "--world building --size 12x8 --resolution 0.25 --scans 15 --angles 60"


def simulated(tmp_path, *arguments):
    return json_of("simulate", SMALL, *arguments, "-o", tmp_path / "office.log", "--json")


def test_beams_that_meet_nothing_are_no_return_whatever_the_sensor(tmp_path):
    assert simulated(tmp_path, "--sensor gaussian:0.02 --max-range 2")["readings"]["no_return"] > 100
    scans = describe_log(tmp_path / "office.log").scans
    hits = scans.ranges_m[np.isfinite(scans.ranges_m)]
    # 2 % of the hits between 0 and 2 m lie within the last 4 cm, if none stand for nothing.
    assert (hits > 1.96).mean() < 0.1
    assert hits.max() <= 2.0


def test_the_tutorial_keeps_its_cap_where_it_is_called_from_python():
    walls, pose = bm.worlds.tutorial()
    angles = np.arange(100) / 100 * 2 * np.pi
    world, laser = (walls, bm.worlds.TUTORIAL_GRID, pose, angles), {"sensor": bm.Gaussian(0.2), "max_range_m": 42.0}
    scans, typed = bm.simulate(*world, **laser), bm.simulate(*world, **laser, typed=True)
    assert np.isfinite(scans.ranges_m).all()
    nothing = scans.ranges_m > 40.0
    assert nothing.any()
    np.testing.assert_array_equal(np.isposinf(typed.ranges_m), nothing)


def test_raw_odometry_with_the_truth_beside_it(tmp_path):
    document = simulated(tmp_path, "--odometry typical,slips_per_m=0.05 --laser 0.1,-0.05,5")
    assert document["odometry"]["slips_per_m"] == 0.05
    reading = describe_log(tmp_path / "office.log")
    truth = read_trajectory(tmp_path / "office-truth.tum")
    mount = np.array([0.1, -0.05, np.radians(5.0)])
    np.testing.assert_allclose(reading.scans.mount, mount, atol=1e-4)
    np.testing.assert_allclose(reading.scans.stamps_s, truth.stamps_s, atol=1e-5)
    drift = between(compose(truth.poses, mount), reading.scans.poses)
    assert np.abs(drift[0]).max() < 1e-5
    assert np.hypot(*drift[:, :2].T).max() > 0.1

    relations = np.loadtxt(tmp_path / "office.relations")
    start, end = (interpolate(truth.stamps_s, truth.poses, relations[:, column]) for column in (0, 1))
    assert len(relations) > 20
    np.testing.assert_allclose(between(relations[:, [2, 3, 7]], between(start, end)), 0.0, atol=1e-4)


def test_another_drive_is_in_the_same_building(tmp_path):
    poses, walls = [], []
    for options in ("--seed 4", "--seed 4 --drive-seed 5", "--seed 5"):
        simulated(tmp_path, options, "--force")
        poses.append(describe_log(tmp_path / "office.log").scans.poses)
        walls.append((tmp_path / "office-truth.pgm").read_bytes())
    assert walls[0] == walls[1] != walls[2]
    assert np.abs(poses[1] - poses[0]).max() > 0.1


def test_a_recording_holds_scans_odometry_and_the_place_of_the_laser(tmp_path):
    options = "--format mcap --size 12x8 --resolution 0.25 --minutes 0.05 --angles 60 --laser 0.2,0,90 --json"
    document = json_of("simulate", options, "-o", tmp_path / "robot.mcap")
    assert (document["scans"], document["beams"]) == (30, 1800)
    reading = describe_log(tmp_path / "robot.mcap")
    mount = np.array([0.2, 0.0, np.pi / 2])
    np.testing.assert_allclose(reading.scans.mount, mount, atol=1e-6)
    truth = read_trajectory(tmp_path / "robot-truth.tum")
    np.testing.assert_allclose(reading.scans.stamps_s, truth.stamps_s, atol=1e-5)
    np.testing.assert_allclose(np.diff(truth.stamps_s), 0.1, atol=1e-5)
    drift = between(compose(truth.poses, mount), reading.scans.poses)
    assert np.abs(drift[0]).max() < 1e-5
    assert np.abs(drift[-1]).max() > 0.01


@pytest.mark.parametrize(("line", "message"), [
    ("--format carmen -o a.mcap", "ends differently"), ("--format mcap -o a.log", "ends differently"),
    ("--minutes 1 -o a.log", "--world building"),
])  # fmt: skip
def test_a_recording_that_cannot_be_made_is_refused(tmp_path, monkeypatch, line, message):
    monkeypatch.chdir(tmp_path)
    assert message in refusal_of("simulate", line, code=3 if "minutes" in line else 2)


def test_true_poses_come_with_no_trajectory_of_the_truth(tmp_path):
    simulated(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"office-truth.pgm", "office-truth.yaml", "office.log"}


def test_odometry_as_it_is_typed():
    assert odometry_of("true") is None
    assert odometry_of("typical") == OdometryNoise()
    assert (odometry_of("perfect, lag_s=0.1").lag_s, odometry_of("perfect").turn_per_m) == (0.1, 0.0)
    for text, message in (
        ("worn", "begin with true, typical or perfect"),
        ("typical,wheels=2", "'wheels=2' is not name=value with one of distance_per_m"),
        ("typical,lag_s=soon", "'soon' is not a number"),
        ("typical,slip_m=-1", "slip_m must be a finite number of 0 or more"),
    ):
        with pytest.raises(BadInput, match=message):
            odometry_of(text)
