"""The environments that the benchmark's peers run in, made by the benchmark itself.

A peer may need what bayesmap must not have (GenJAX 0.10.3 pins jax < 0.6 and numpy < 2), so each gets a
virtual environment of its own under `.bench/`, with every package pinned in
`benchmarks/peers/NAME.constraints.txt`. Making one that is already there costs nothing. A peer that
cannot be installed (no network, no suitable Python) is reported in one line and left out: the benchmark
of bayesmap itself must run on any machine.

`python -m benchmarks.environments genjax numpyro` makes these two without running anything.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ENVIRONMENTS = ROOT / ".bench"
PEERS = Path(__file__).resolve().with_name("peers")
INSTALL_TIMEOUT_S = 900

OURS = {"PYTHONPATH", *(f"PIP_{name}" for name in ("CONSTRAINT", "REQUIREMENT", "TARGET", "PREFIX", "USER"))}
"""Variables that say what is installed for bayesmap, and where; a peer's packages and versions are its own."""


PYTHONS = {
    "genjax": ((3, 11), (3, 12)),
    "numpyro": ((3, 11), (3, 12), (3, 13), (3, 14)),
    "pyoctomap": ((3, 11), (3, 12), (3, 13), (3, 14)),
}
"""The peers, and the Python versions for which all their pinned packages have wheels, preferred first."""


@dataclass(frozen=True)
class Unavailable:
    """Why a peer cannot be run here, in one line."""

    reason: str


def ensure(name: str) -> Path | Unavailable:
    """The interpreter of a peer's environment, which is made if it is missing or out of date.

    An environment counts as made once its stamp is written, which happens last: one that was interrupted
    half-way is made again.
    """
    constraints = PEERS / f"{name}.constraints.txt"
    folder = ENVIRONMENTS / name
    python, stamp = folder / "bin" / "python", folder / "installed"
    fingerprint = hashlib.sha256(constraints.read_bytes()).hexdigest()
    if stamp.is_file() and stamp.read_text() == fingerprint and _version_of(str(python)) is not None:
        return python

    base = _find_python(PYTHONS[name])
    if base is None:
        wanted = ", ".join(f"{major}.{minor}" for major, minor in PYTHONS[name])
        return Unavailable(f"{name} needs Python {wanted}; none of them is on the PATH")
    print(f"making the environment of {name} in {folder}", file=sys.stderr)
    install = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    install += ["--only-binary", ":all:", "--requirement", str(constraints)]
    for command in ([base, "-m", "venv", "--clear", str(folder)], install):
        problem = _run(command)
        if problem is not None:
            shutil.rmtree(folder, ignore_errors=True)
            return Unavailable(f"{name} could not be installed: {problem}")
    stamp.write_text(fingerprint)
    return python


def _find_python(versions: tuple[tuple[int, int], ...]) -> str | None:
    """The running interpreter if its version will do, otherwise the first suitable one on the PATH."""
    if sys.version_info[:2] in versions:
        return sys.executable
    for major, minor in versions:
        found = shutil.which(f"python{major}.{minor}")
        if found is not None and _version_of(found) == (major, minor):
            return found
    return None


def _version_of(python: str) -> tuple[int, int] | None:
    """An interpreter's version, or None if it does not run (a dangling link, a version manager's stub)."""
    command = [python, "-c", "import sys; print(*sys.version_info[:2])"]
    try:
        answer = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    except (OSError, subprocess.SubprocessError):
        return None
    major, minor = answer.stdout.split()
    return int(major), int(minor)


def _run(command: list[str]) -> str | None:
    """Run a command; None if it succeeded, otherwise what it says went wrong, in one line."""
    environment = {key: value for key, value in os.environ.items() if key not in OURS}
    try:
        subprocess.run(command, capture_output=True, text=True, check=True, timeout=INSTALL_TIMEOUT_S, env=environment)
    except subprocess.CalledProcessError as error:
        lines = [line.strip() for line in (error.stdout + error.stderr).splitlines() if line.strip()]
        errors = [line.removeprefix("ERROR: ") for line in lines if line.startswith("ERROR: ")]
        return (errors or lines[-1:] or [f"exit status {error.returncode}"])[0]
    except subprocess.TimeoutExpired:
        return f"not done after {INSTALL_TIMEOUT_S} s"
    except OSError as error:
        return str(error)
    return None


def main(names: list[str]) -> int:
    """Make the named environments (all, if none is named); 1 if one of them is not to be had."""
    unknown = sorted(set(names) - set(PYTHONS))
    if unknown:
        print(f"no such peer: {', '.join(unknown)}; known: {', '.join(PYTHONS)}", file=sys.stderr)
        return 2
    status = 0
    for name in names or list(PYTHONS):
        result = ensure(name)
        if isinstance(result, Unavailable):
            print(result.reason, file=sys.stderr)
            status = 1
        else:
            print(f"{name}: {result}")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
