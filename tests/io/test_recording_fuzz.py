"""Whatever a recording's bytes are, it is read or refused; nothing else is raised, and no warning is given."""

import numpy as np
import pytest
import recordings as r
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.io.contents import contents_of
from bayesmap.io.logs import read_log

CONTAINERS = ("rosbag1", "db3", "mcap", "mcap-zstd", "mcap-plain", "mcap-ros1")


@pytest.fixture(scope="module")
def contents(tmp_path_factory):
    messages, _ = r.robot(odom=True)
    folder = tmp_path_factory.mktemp("whole")
    return {writer: r.written(folder / writer, messages, writer).read_bytes() for writer in CONTAINERS}


def read_or_refused(path, content):
    path.write_bytes(content)
    for skip in (False, True):
        try:
            scans = read_log(path, skip_bad_lines=skip)
        except bm.BadInput as problem:
            refusal = str(problem)
        else:
            refusal = f"{path}: read" if len(scans) else "nothing was read, and nothing said"
        assert refusal.startswith(str(path))


def tries(many, few, *landing):
    """Return cases of writers with many tries, and of the landing run's writers with few."""
    short = [(writer, few) for writer in landing]
    return pairs_but([*((writer, many) for writer in CONTAINERS), *short], *short)


@pytest.mark.parametrize(("writer", "count"), tries(40, 20, "rosbag1", "mcap"))
def test_recordings_cut_anywhere(contents, tmp_path, writer, count):
    content = contents[writer]
    ends = np.random.default_rng(0).integers(0, len(content), count)
    for end in [*ends, 1, 12, 13, 20, len(content) - 1, len(content) - 9]:
        read_or_refused(tmp_path / "cut", content[:end])


@pytest.mark.parametrize(("writer", "count"), tries(60, 25, "mcap-zstd"))
def test_recordings_with_some_bytes_changed(contents, tmp_path, writer, count):
    rng = np.random.default_rng(1)
    for _ in range(count):
        content = bytearray(contents[writer])
        for _ in range(rng.integers(1, 6)):
            content[rng.integers(len(content))] ^= 1 << rng.integers(8)
        read_or_refused(tmp_path / "flipped", bytes(content))


@pytest.mark.parametrize(("writer", "count"), tries(20, 12, "mcap-plain"))
def test_bytes_inserted_and_removed(contents, tmp_path, writer, count):
    rng = np.random.default_rng(2)
    for _ in range(count):
        content, at = contents[writer], rng.integers(len(contents[writer]))
        read_or_refused(tmp_path / "longer", content[:at] + rng.bytes(5) + content[at:])
        read_or_refused(tmp_path / "shorter", content[:at] + content[at + 9 :])


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
