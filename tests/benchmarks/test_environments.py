"""A peer's environment is made of the peer's own pinned packages, whatever our own installation was told."""

import sys

import pytest

from benchmarks import environments

SAYS = "import os; raise SystemExit(' '.join(sorted(k for k in os.environ if k.startswith('PIP_'))) or 'none')"


def test_our_pins_are_not_the_peers(monkeypatch):
    for name in ("PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_TARGET"):
        monkeypatch.setenv(name, "ours.txt")
    monkeypatch.setenv("PIP_INDEX_URL", "https://mirror.example/simple")
    said = environments._run([sys.executable, "-c", SAYS])
    assert said is not None
    assert "PIP_INDEX_URL" in said.split()
    assert not {"PIP_CONSTRAINT", "PIP_REQUIREMENT", "PIP_TARGET"} & set(said.split())


def test_a_peer_that_cannot_be_installed_is_left_out_with_the_reason(monkeypatch, tmp_path):
    monkeypatch.setattr(environments, "ENVIRONMENTS", tmp_path)
    monkeypatch.setattr(environments, "_run", lambda command: "no matching distribution")
    monkeypatch.setattr(environments, "_find_python", lambda versions: sys.executable)
    found = environments.ensure("numpyro")
    assert found == environments.Unavailable("numpyro could not be installed: no matching distribution")


@pytest.mark.parametrize("name", sorted(environments.PYTHONS))
def test_every_peer_is_pinned(name):
    lines = (environments.PEERS / f"{name}.constraints.txt").read_text().splitlines()
    assert all("==" in line for line in lines if line and not line.startswith("#"))
