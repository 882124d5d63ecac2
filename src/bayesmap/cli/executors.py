"""Where chains run, as ``--executor`` says it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.run.runner import Executor

THREADS, RAY = "threads", "ray"


def ray_address(executor: str) -> tuple[bool, str | None]:
    """Whether it is a Ray cluster, and its address: None where Ray shall find one, or start one.

    Raises:
        BadInput: neither threads nor Ray.
    """
    if executor == THREADS:
        return False, None
    if executor == RAY:
        return True, None
    if executor.startswith("ray://") and executor != "ray://":
        return True, executor
    raise BadInput(f"--executor must be threads, ray or ray://HOST:PORT, got {executor!r}")


def executor_of(executor: str) -> Executor | None:
    """The executor that a setting names; None for the threads of this process."""
    on_ray, address = ray_address(executor)
    if not on_ray:
        return None
    from bayesmap.run.ray_executor import RayExecutor

    return RayExecutor(address)
