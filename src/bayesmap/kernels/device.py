"""Which device kernels run on, and how arrays get there."""

import contextlib
import os
import sys
import threading
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import warp as wp

from bayesmap.errors import BadInput

_STARTING = threading.Lock()


def start() -> None:
    """Start Warp once, quietly: its greeting and its lament about a missing GPU driver are not our output."""
    with _STARTING:
        _start()


@cache
def _start() -> None:
    wp.config.log_level = max(wp.config.log_level, wp.LOG_WARNING)
    with _no_stderr():
        wp.init()


@contextlib.contextmanager
def _no_stderr() -> Iterator[None]:
    """Send file descriptor 2 to nowhere: the driver lament is printed by native code."""
    try:
        sys.stderr.flush()
        saved = os.dup(2)
    except (OSError, ValueError, AttributeError):  # no stderr to silence
        yield
        return
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


def resolve(name: str = "cpu") -> str:
    """Check a device name such as "cpu" or "cuda:0".

    Raises:
        BadInput: no such device on this machine.
    """
    start()
    known = [device.alias for device in wp.get_devices()]
    alias = "cuda:0" if name == "cuda" else name
    if alias not in known:
        raise BadInput(f"device: {name!r} is not on this machine; there is: {', '.join(known)}")
    return alias


def to_device(array: np.ndarray[Any, Any], dtype: Any, device: str) -> Any:
    """Put a NumPy array where kernels read it; on the CPU this shares memory when dtype and layout fit.

    Of vectors, the array's last axis holds the components.
    """
    scalar = getattr(dtype, "_wp_scalar_type_", dtype)
    flat = np.ascontiguousarray(array, dtype=wp.dtype_to_numpy(scalar))
    return wp.array(flat, dtype=dtype, device=device, copy=device != "cpu")


def load_kernels(kernel: Any, device: str) -> None:
    """Compile the kernel's module for a device, or fetch it from Warp's cache, now rather than at its first launch."""
    # Launches on the CPU use blocks of one; any other size would be another variant, compiled for nothing.
    kernel.module.load(wp.get_device(device), 1 if device == "cpu" else None)
