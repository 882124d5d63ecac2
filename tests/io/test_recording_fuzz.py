"""Whatever a recording's bytes are, it is read or refused; nothing else is raised, and no warning is given."""

import numpy as np
import pytest
import recordings as r
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.io.contents import contents_of

CONTAINERS = ("rosbag1", "db3", "mcap", "mcap-zstd", "mcap-plain", "mcap-ros1")


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    messages, _ = r.robot(odom=True)
    folder = tmp_path_factory.mktemp("whole")
    return {writer: r.written(folder / writer, messages, writer).read_bytes() for writer in CONTAINERS}


def tries(many, few, *landing):
    """Return cases of writers with many tries, and of the landing run's writers with few."""
    short = [(writer, few) for writer in landing]
    return pairs_but([*((writer, many) for writer in CONTAINERS), *short], *short)


@pytest.mark.parametrize(("writer", "count"), tries(40, 12, "rosbag1", "mcap"))
def test_recordings_cut_anywhere(contents, tmp_path, writer, count):
    content = contents[writer]
    ends = np.random.default_rng(0).integers(0, len(content), count)
    for end in [*ends, 1, 12, 13, 20, len(content) - 1, len(content) - 9]:
        r.read_or_refused(tmp_path / "cut", content[:end])


@pytest.mark.parametrize(("writer", "count"), tries(60, 16, "mcap-zstd", "mcap-plain"))
def test_recordings_with_some_bytes_changed_inserted_or_removed(contents, tmp_path, writer, count):
    rng, whole = np.random.default_rng(1), contents[writer]
    for i in range(count):
        content, at = bytearray(whole), int(rng.integers(len(whole)))
        for _ in range(rng.integers(1, 6)):
            content[rng.integers(len(content))] ^= 1 << rng.integers(8)
        inserted, removed = whole[:at] + rng.bytes(5) + whole[at:], whole[:at] + whole[at + 9 :]
        r.read_or_refused(tmp_path / "damaged", (bytes(content), inserted, bytes(content), removed)[i % 4])


@pytest.mark.parametrize("writer", full_but(CONTAINERS, "db3", "mcap-ros1"))
def test_looking_into_damaged_recordings(contents, tmp_path, writer):
    rng = np.random.default_rng(3)
    path = tmp_path / "damaged"
    for _ in range(15):
        content = bytearray(contents[writer][: rng.integers(len(contents[writer]))])
        if content:
            content[rng.integers(len(content))] ^= 0xFF
        path.write_bytes(content)
        try:
            found = contents_of(path).path
        except bm.BadInput as problem:
            found = str(problem)
        assert found.startswith(str(path))
