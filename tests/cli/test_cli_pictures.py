"""`demo`, `simulate`, `render` and `export`: files that open, and truth that comes back."""

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
from bayesmap.io.ros.maps import read_map


def test_demo(tmp_path):
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


@pytest.mark.parametrize("what", ["figure", "mean", "entropy", "width", "draw", "trace"])
def test_render(office, office_run, tmp_path, what):
    target = tmp_path / "picture.png"
    truth = ["--truth", office.with_name("office-truth.yaml")] if what in ("figure", "mean") else []
    result = succeed("render", office_run / "run.nc", "--what", what, "-o", target, *truth)
    assert result.stdout == f"{target}\n"
    with Image.open(target) as image:
        assert image.size[0] > 400


@pytest.fixture(scope="module")
def heldout_run(office, tmp_path_factory):
    return held_out(office, tmp_path_factory.mktemp("run") / "heldout")


@pytest.fixture(scope="module")
def binary_run(office, tmp_path_factory):
    return held_out(office, tmp_path_factory.mktemp("run") / "binary", "--cells", "binary")


def held_out(office, folder, *options):
    few = "--resolution 0.25 --chains 2 --warmup 5 --draws 8 --no-progress"
    succeed("infer", office, "-o", folder, few, "--holdout 3", *options)
    return folder


def test_residuals_of_scans_that_were_seen_are_refused(office, office_run, heldout_run, tmp_path):
    for run, every in ((office_run, "3"), (heldout_run, "2"), (heldout_run, "0")):
        held_out = ("--what residuals --heldout", office, "--holdout", every)
        refusal_of("render", run / "run.nc", *held_out, "-o", tmp_path / "picture.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("what", "window"), latin(3, ["residuals", "surprise", "log-odds"], [None, "observed", "0,6,-1,5"])
)
def test_render_what_others_and_unseen_scans_say(office, heldout_run, tmp_path, what, window):
    target = tmp_path / "picture.png"
    heldout = ["--heldout", office, "--holdout 3"] if what != "log-odds" else []
    part = ["--window", window] if window else []
    succeed("render", heldout_run / "run.nc", "--what", what, "-o", target, *heldout, *part)
    with Image.open(target) as image:
        assert image.size[0] > 400


def test_binary_walls_have_no_interval_and_no_surfaces_and_other_cells_have(binary_run, office_run, tmp_path):
    for what, message in (("width", "a wall has no interval"), ("surfaces", "--cells surface")):
        assert message in refusal_of("render", binary_run / "run.nc", "--what", what, "-o", tmp_path / "no.png")
        succeed("render", office_run / "run.nc", "--what", what, "-o", tmp_path / f"{what}.png")
    assert {path.name for path in tmp_path.iterdir()} == {"width.png", "surfaces.png"}
    assert "--what width" in refusal_of("render", office_run / "run.nc", "--what deviation -o", tmp_path / "no.png")


BINARY = ("figure", "mean", "deviation", "draw", "animation", "residuals", "log-odds")


@pytest.mark.parametrize("what", full_but(BINARY, "figure", "deviation", "animation"))
def test_binary_walls_are_still_drawn(office, binary_run, tmp_path, what):
    target = tmp_path / ("film.gif" if what == "animation" else "picture.png")
    heldout = ["--heldout", office, "--holdout 3"] if what == "residuals" else []
    succeed("render", binary_run / "run.nc", "--what", what, "-o", target, *heldout)


def test_layers_of_walls_and_of_surfaces_in_a_geotiff(binary_run, office_run, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    for run, names in ((binary_run, ("mean", "entropy")), (office_run, ("mean", "entropy", "lower", "upper"))):
        succeed("export", run / "run.nc", "-o", tmp_path / "map.tif", "--force")
        with rasterio.open(tmp_path / "map.tif") as file:
            assert file.descriptions == names
            layers = file.read()
        if len(names) == 4:
            known = ~np.isnan(layers[0])
            assert (layers[2] <= layers[3])[known].all()
            # Means are of what the draws expect, ends of what was drawn: with few draws they miss by a little.
            outside = np.maximum(layers[2] - layers[0], layers[0] - layers[3])[known]
            assert (outside < 0.05).mean() > 0.9


def test_render_animation_and_default_names(office_run, tmp_path):
    copy = tmp_path / "run.nc"
    copy.write_bytes((office_run / "run.nc").read_bytes())
    for what, name in (("animation", "animation.gif"), ("figure", "figure.png"), ("entropy", "entropy.png")):
        document = json.loads(call("render", copy, "--what", what, "--json --frames 3").stdout)
        assert document["outputs"] == {name: str(tmp_path / name)}
        assert f"{name}: exists already; --force replaces it" in refusal_of("render", copy, "--what", what)
    with Image.open(tmp_path / "animation.gif") as film:
        assert film.n_frames == 3
    own = {default_name(what) for what in get_args(Picture)} | {"plan.png", "explore.png", "export.yaml", "export.pgm"}
    assert not own & {
        *DERIVED,
        "posterior-block.png",
        "posterior-importance.png",
        "weights-importance.png",
        "chain.gif",
    }


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


def test_export(office_run, tmp_path):
    run = bm.load(office_run / "run.nc")
    for mode in ("trinary", "scale"):
        target = tmp_path / f"{mode}.yaml"
        succeed("export", office_run / "run.nc", "-o", target, "--mode", mode)
        occupancy, grid = read_map(target)
        assert grid == run.grid
        known = ~np.isnan(occupancy)
        if mode == "scale":
            assert not (known & ~run.observed).any()
            assert (run.occupancy[run.observed & ~known] < 0.1).all()  # few beams passed these
            np.testing.assert_allclose(occupancy[known], run.occupancy[known], atol=0.011)
    assert ".yaml, .yml, .bag, .mcap, .db3, .rrd, .tum, .g2o, .tif, .tiff" in refusal_of(
        "export", office_run / "run.nc", "-o", tmp_path / "map.txt"
    )
    assert "no such folder; make it first" in refusal_of(
        "export", office_run / "run.nc", "-o", tmp_path / "nowhere" / "map.yaml"
    )


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
    assert "tum keeps the numbers and takes no mode" in refusal_of(
        "export", office_run / "run.nc", "-o", tmp_path / "map.tum", "--mode raw"
    )


def test_simulate_worlds_from_files(tmp_path):
    drawing = tmp_path / "room.txt"
    drawing.write_text("XXXXX\nX...X\nX...X\nXXXXX\n")
    truth = tmp_path / "scan-truth.yaml"
    assert (
        json_of(
            "simulate", "--world", drawing, "--pose 1.5,2.5,0 --pose 2.5,2.5,90 -o", tmp_path / "scan.log.gz", "--json"
        )["scans"]
        == 2
    )
    assert read_map(truth)[0].shape == (4, 5)
    assert "--force replaces it" in refusal_of(
        "simulate", "--world", truth, "--pose 1.5,2.5,0 -o", tmp_path / "scan.log.gz"
    )
    succeed("simulate", "--world", truth, "--pose 1.5,2.5,0 -o", tmp_path / "again.log")
    succeed("simulate", "--world", tmp_path / "scan-truth.pgm", "--pose 0.15,0.25,0 -o", tmp_path / "p.log")
    refusal_of("simulate", "--world", drawing, "-o", tmp_path / "q.log", code=2)
