"""Files of relations, as Kuemmerle et al. write them."""

import gzip

import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.io.text.relations import write_relations


@pytest.mark.parametrize("name", ["true.relations", "true.relations.gz"])
def test_relations_are_written_with_all_their_digits(tmp_path, name):
    rng = np.random.default_rng(0)
    first, second = 976052905.0 + np.round(np.sort(rng.uniform(0, 100, (2, 7)), axis=0), 6)
    relative = rng.uniform(-3, 3, (7, 3))
    path = write_relations(tmp_path / name, first, second, relative)
    text = gzip.decompress(path.read_bytes()) if name.endswith(".gz") else path.read_bytes()
    table = np.loadtxt(text.decode().splitlines())
    np.testing.assert_allclose(table[:, :2], np.column_stack([first, second]), atol=1e-6, rtol=0)
    np.testing.assert_allclose(table[:, [2, 3, 7]], relative, atol=1e-8)
    assert not table[:, 4:7].any()


def test_shapes_that_do_not_fit(tmp_path):
    for first, second, relative in (([], [], np.zeros((0, 3))), ([1], [2, 3], np.zeros((1, 3))), ([1], [2], [0, 0])):
        with pytest.raises(BadInput, match="relations: got stamps"):
            write_relations(tmp_path / "a.relations", first, second, relative)
