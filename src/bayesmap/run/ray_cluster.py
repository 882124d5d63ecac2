"""The connection of this process to a Ray cluster, and what its errors mean."""

from __future__ import annotations

import logging
from typing import Any

from bayesmap.errors import BadInput


def connect(address: str | None) -> Any:
    """The `ray` module, connected; a connection that there is already is used, and none is closed.

    Args:
        address: see `bayesmap.run.ray_executor.RayExecutor`.

    Raises:
        BadInput: Ray is not installed, or there is no cluster at the address.
    """
    try:
        import ray
    except ImportError:
        raise BadInput("RayExecutor: Ray is not installed; install it with: pip install 'bayesmap[ray]'") from None
    if not ray.is_initialized():
        try:
            ray.init(address=address, log_to_driver=False, logging_level=logging.ERROR, include_dashboard=False)
        except Exception as error:  # among others a bare Exception, of a node that does not come up in time
            where = "on this machine" if address in (None, "auto") else f"at {address}"
            reason = " ".join(str(error).split())
            raise BadInput(
                f"RayExecutor: no Ray cluster {where} can be used: {reason}; ray start --head starts one, and without "
                "an address bayesmap does"
            ) from error
    return ray


def outcome(ray: Any, ref: Any) -> Any:
    """What a task returned, or the exception that it raised, as if it had run here."""
    try:
        return ray.get(ref)
    except ray.exceptions.RayTaskError as error:
        raise error.cause from None


def failed(error: Exception) -> ConnectionError:
    """The error of a task whose worker died more often than it may."""
    reason = str(error).strip().splitlines()
    return ConnectionError(
        "RayExecutor: a task was given up after its workers had died again and again (out of memory? a node that "
        f"cannot load bayesmap?): {reason[0] if reason else type(error).__name__}"
    )
