import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from PIL import Image

from bayesmap.errors import BadInput
from bayesmap.io.ros.maps import MODES, read_map, write_map
from bayesmap.space.grid import Grid

shapes = hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=8)
probabilities = hnp.arrays(np.float64, shapes, elements=st.floats(0, 1))
resolutions = st.floats(1e-6, 10.0)
corners = st.tuples(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5))


def nav2_reads(path_yaml, newer=False):
    """Read a map by nav2's rules, written again; returns cells (height, width) from the bottom, and the YAML's entries.

    Versions from 2025 on compute in single precision, include the bounds, and take what is transparent for unknown.
    """
    entries = yaml.safe_load(path_yaml.read_text())
    with Image.open(path_yaml.parent / entries["image"]) as image:
        has_alpha, grey = "A" in image.getbands(), np.asarray(image.convert("L"))
        rgba = np.asarray(image.convert("RGBA"))
    number, mode = (np.float32 if newer else np.float64), entries["mode"]
    occupied, free = number(entries["occupied_thresh"]), number(entries["free_thresh"])
    shade = grey / number(255)
    if not newer:
        shade = (rgba if mode == "trinary" and has_alpha else rgba[..., :3]).mean(axis=-1) / 255
    if mode == "raw":
        cells = np.rint(255 * shade).astype(int)
        return np.where(cells > 100, -1, cells)[::-1], entries
    occ = shade if entries["negate"] else number(1) - shade
    scaled = (occ - free) / (occupied - free) * 100
    between = -1 if mode == "trinary" else np.floor(scaled + 0.5) if newer else np.rint(scaled)
    is_occupied, is_free = (occ >= occupied, occ <= free) if newer else (occ > occupied, occ < free)
    cells = np.where(is_occupied, 100, np.where(is_free, 0, between)).astype(int)
    return np.where((has_alpha and (newer or mode == "scale")) & (rgba[..., 3] < 255), -1, cells)[::-1], entries


@pytest.mark.parametrize("mode", MODES)
@given(occupancy=probabilities, resolution=resolutions, origin=corners, data=st.data())
def test_nav2_reads_a_map_as_it_was_meant_and_so_do_we(tmp_path_factory, mode, occupancy, resolution, origin, data):
    observed = data.draw(hnp.arrays(bool, occupancy.shape))
    grid = Grid(occupancy.shape, resolution, origin)
    path, image = write_map(tmp_path_factory.mktemp("map") / "m.yaml", occupancy, grid, observed, mode=mode)
    assert image.suffix == (".png" if mode == "scale" and not observed.all() else ".pgm")
    read_cells, entries = nav2_reads(path)
    cells = read_cells.T
    assert entries["resolution"] == grid.resolution
    assert entries["origin"] == pytest.approx([*grid.origin, 0.0], rel=1e-12, abs=0.0)
    if mode == "trinary":
        expected = np.where(occupancy > 0.65, 100, np.where(occupancy < 0.25, 0, -1))
    else:
        expected = np.rint(100 * occupancy)
    # One step of a grey is 0.4 % in scale, and nav2 rounds to a whole per cent.
    off = np.abs(cells - (100 * occupancy if mode == "scale" else expected))[observed]
    assert (off <= (0.5 + 100 * 0.5 / 255 + 1e-9 if mode == "scale" else 0)).all()
    assert (cells[~observed] == -1).all()
    if mode == "scale":
        assert (cells[observed] >= 0).all()
    newer = nav2_reads(path, newer=True)[0].T
    # Older versions round halves to even and in double precision: they may differ by one per cent.
    assert np.abs(cells - newer).max() <= (1 if mode == "scale" else 0)
    np.testing.assert_array_equal(cells == -1, newer == -1)
    read, read_grid = read_map(path)
    np.testing.assert_array_equal(read, np.where(cells == -1, np.nan, cells / 100))
    assert read_grid == Grid(grid.shape, grid.resolution, tuple(entries["origin"][:2]))


def test_an_origin_is_written_without_the_noise_of_floating_point(tmp_path):
    path, _ = write_map(tmp_path / "m.yaml", np.zeros((3, 4)), Grid((3, 4), 0.1, (0.1 + 0.2, 0.12414815121802761)))
    assert "origin: [0.3, 0.12414815121802761, 0]" in path.read_text()


def test_the_first_row_is_the_top_unknown_cells_are_grey_205_and_scaled_maps_saturate_beyond_thresholds(tmp_path):
    occupancy = np.zeros((3, 2))
    occupancy[0, 1] = 1.0  # low x, high y
    _, image = write_map(tmp_path / "m.yaml", occupancy, Grid((3, 2)))
    np.testing.assert_array_equal(np.asarray(Image.open(image)), [[0, 254, 254], [254, 254, 254]])
    assert image.read_bytes().startswith(b"P5")
    path, image = write_map(tmp_path / "m.yaml", np.array([[0.1, np.nan, 0.5]]), Grid((1, 3)))
    np.testing.assert_array_equal(np.asarray(Image.open(image))[::-1, 0], [254, 205, 205])
    np.testing.assert_array_equal(nav2_reads(path)[0][:, 0], [0, -1, -1])
    occupancy = np.array([[0.1, 0.2, 0.5, 0.8, 0.9]])
    grid = Grid((1, 5))
    path, _ = write_map(tmp_path / "m.yaml", occupancy, grid, mode="scale", occupied_thresh=0.75, free_thresh=0.25)
    np.testing.assert_array_equal(nav2_reads(path)[0].T, [[0, 0, 50, 100, 100]])


@pytest.mark.parametrize("name", ["plain.yaml", "two words.yaml", "colon: and # hash.yaml", "día.yml", "0.yaml"])
def test_any_file_name_finds_its_image(tmp_path, name):
    write_map(tmp_path / name, np.eye(2), Grid((2, 2)))
    np.testing.assert_array_equal(read_map(tmp_path / name)[0], np.eye(2))


def test_maps_of_other_programs_raw_and_negated_ones_are_read(tmp_path):
    Image.fromarray(np.array([[254, 0], [205, 254]], dtype=np.uint8)).save(tmp_path / "floor 1.pgm")
    (tmp_path / "map.yaml").write_text(
        "---\n# made by map_saver\nimage: 'floor 1.pgm'  # relative\nresolution: 0.050000\n"
        "origin:\n- -1.5\n- 2\n- 0.0\nnegate: false\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    cells, grid = read_map(tmp_path / "map.yaml")
    np.testing.assert_array_equal(cells, [[np.nan, 0.0], [0.0, 1.0]])
    assert grid == Grid((2, 2), 0.05, (-1.5, 2.0))
    Image.fromarray(np.array([[0, 37, 100, 101, 255]], dtype=np.uint8)).save(tmp_path / "m.pgm")
    head = "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    (tmp_path / "raw.yaml").write_text(head + "mode: raw\nnegate: 0\n")
    np.testing.assert_array_equal(read_map(tmp_path / "raw.yaml")[0][:, 0], [0, 0.37, 1, np.nan, np.nan])
    (tmp_path / "negated.yaml").write_text(head + "negate: 1\n")
    np.testing.assert_array_equal(read_map(tmp_path / "negated.yaml")[0][:, 0], [0, 0, np.nan, np.nan, 1])


@pytest.mark.parametrize(("text", "says"), [
    ("resolution: 0.1\norigin: [0, 0, 0]\n", "has no 'image:'"),
    ("image: absent.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n", r"absent\.pgm: cannot be read"),
    ("image: m.pgm\nresolution: fine\norigin: [0, 0, 0]\n", "resolution must be a number, got 'fine'"),
    ("image: m.pgm\nresolution: 0.1\norigin: [0, 0]\n", r"origin must be \[x, y, yaw\]"),
    ("image: m.pgm\nresolution: 0.1\norigin: [0, 0, 0.5]\n", "turned by 0.5 rad"),
    ("image: m.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nmode: fuzzy\n", "mode 'fuzzy' is not known"),
    ("image: m.pgm\nnonsense\n", "line 2: not YAML: could not find expected ':'"),
])  # fmt: skip
def test_a_bad_yaml_is_refused_with_the_reason(tmp_path, text, says):
    Image.fromarray(np.zeros((2, 2), dtype=np.uint8)).save(tmp_path / "m.pgm")
    (tmp_path / "m.yaml").write_text(text)
    with pytest.raises(BadInput, match=says):
        read_map(tmp_path / "m.yaml")


@pytest.mark.parametrize(("change", "says"), [
    ({"occupancy": np.full((2, 3), 1.5)}, r"occupancy\[0, 0\] is 1.5"),
    ({"occupancy": np.zeros((3, 2))}, "occupancy has shape"), ({"observed": np.ones((3, 2))}, "observed has shape"),
    ({"mode": "fuzzy"}, "mode 'fuzzy' is not known"), ({"occupied_thresh": 0.1}, "free_thresh < occupied_thresh"),
    ({"path_yaml": "map.png"}, r"must end in \.yaml"),
])  # fmt: skip
def test_a_map_that_cannot_be_written_leaves_no_file(tmp_path, change, says):
    arguments = {"path_yaml": "m.yaml", "occupancy": np.zeros((2, 3)), "grid": Grid((2, 3)), **change}
    arguments["path_yaml"] = tmp_path / arguments["path_yaml"]
    with pytest.raises(BadInput, match=says):
        write_map(**arguments)
    assert list(tmp_path.iterdir()) == []
