"""Start Warp, put arrays and structs on a device (`pack`), and launch a kernel on all cores (`launch`).

Launches release the GIL: `launch` runs one per thread. Kernels write only to own elements, so threads change no result.
"""

import contextlib
import os
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.errors import BadInput

# Arrays in main memory; then arrays on a device, with one dimension (s) and with two (Rows).
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Ints = NDArray[np.int32]
Int32s, Float32s = wp.array(dtype=wp.int32), wp.array(dtype=wp.float32)
Float64s, Uint8s = wp.array(dtype=wp.float64), wp.array(dtype=wp.uint8)
Vec2ds, Vec3ds = wp.array(dtype=wp.vec2d), wp.array(dtype=wp.vec3d)
Int32Rows, Float32Rows = wp.array2d(dtype=wp.int32), wp.array2d(dtype=wp.float32)
Float64Rows, Uint8Rows = wp.array2d(dtype=wp.float64), wp.array2d(dtype=wp.uint8)
ZERO, HALF, ONE = (wp.constant(wp.float64(x)) for x in (0.0, 0.5, 1.0))
ZERO_32, ONE_32 = (wp.constant(wp.float32(x)) for x in (0.0, 1.0))
_START_LOCK = threading.Lock()
MIN_THREADED_BEAMS = 1_000  # fewer beams than this are traced before a second thread has started, which takes 0.2 ms


def start() -> None:
    """Start Warp once and silence its greeting and its warning about a missing GPU driver."""
    with _START_LOCK:
        _start()


@cache
def _start() -> None:
    wp.config.log_level = max(wp.config.log_level, wp.LOG_WARNING)
    with _no_stderr():
        wp.init()


@contextlib.contextmanager
def _no_stderr() -> Iterator[None]:
    """Discard the output to file descriptor 2, where native code prints the warning."""
    try:
        sys.stderr.flush()
        saved = os.dup(2)
    except (OSError, ValueError, AttributeError):  # no stderr to silence
        yield
        return
    try:
        with open(os.devnull, "wb") as null:
            os.dup2(null.fileno(), 2)
        yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


def resolve(name: str = "cpu") -> str:
    """Return Warp's name of a device such as "cpu" or "cuda:0". Raises `BadInput` if this machine does not have it."""
    start()
    names = [device.alias for device in wp.get_devices()]
    alias = "cuda:0" if name == "cuda" else name
    if alias not in names:
        raise BadInput(f"device: {name!r} is not on this machine; there is: {', '.join(names)}")
    return alias


def to_device(array: np.ndarray[Any, Any], dtype: Any, device: str) -> Any:
    """Put a NumPy array on a device, vectors along its last axis; on the CPU it shares memory if it can."""
    flat = np.ascontiguousarray(array, dtype=wp.dtype_to_numpy(getattr(dtype, "_wp_scalar_type_", dtype)))
    return wp.array(flat, dtype=dtype, device=device, copy=device != "cpu")


def struct_like(values: type, *warp_types: Any) -> Any:
    """Return the struct of a dataclass or NamedTuple for kernels, whose fields have these Warp types in order."""
    fields = dict(zip(values.__annotations__, warp_types, strict=True))
    name = f"{values.__name__}Arrays"
    body = {"__annotations__": fields, "__module__": values.__module__, "__qualname__": name}
    return wp.struct(type(name, (), body))


def pack(struct: Any, device: str, /, **values: Any) -> Any:
    """Return a struct for kernels. NumPy arrays are put on the device; for an array, a shape stands for zeros."""
    packed = struct()
    for name, value in values.items():
        setattr(packed, name, _as_argument(value, struct.vars[name].type, device))
    return packed


def _as_argument(value: Any, warp_type: Any, device: str) -> Any:
    """Return a value for a field or an argument of this type, see `pack`."""
    if isinstance(value, np.ndarray):
        return to_device(value, warp_type.dtype, device)
    if isinstance(value, tuple) and hasattr(warp_type, "dtype"):
        return wp.zeros(value, dtype=warp_type.dtype, device=device)
    return value


def load_kernels(kernel: Any, device: str) -> None:
    """Compile the module of a kernel for a device, or fetch it from Warp's cache, before its first launch."""
    # Launches on the CPU use blocks of one. Any other size would compile a variant that is never used.
    kernel.module.load(wp.get_device(device), 1 if device == "cpu" else None)


def ceil_div(a: Any, b: int) -> Any:
    """Return a / b rounded up, for an integer or an array of integers a."""
    return -(-a // b)


def available_cores() -> int:
    """Return the number of cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # macOS
        return os.cpu_count() or 1


def threads_for(beams: int) -> int | None:
    """Return the threads for a kernel that follows beams through the grid: 1 for few beams, else None (all cores)."""
    return 1 if beams < MIN_THREADED_BEAMS else None


@cache
def thread_pool(threads: int) -> ThreadPoolExecutor:
    """Return the pool with this many threads; each pool lives as long as the process."""
    return ThreadPoolExecutor(threads, thread_name_prefix="bayesmap")


if hasattr(os, "register_at_fork"):  # a forked child inherits the pools without their threads
    os.register_at_fork(after_in_child=thread_pool.cache_clear)


def launch(
    kernel: Any, size: int, inputs: Sequence[Any], device: str, threads: int | None = None, begin: int = 0
) -> list[Any]:
    """Run ``kernel(first, *inputs)`` over ``size`` elements from ``begin`` on; on the CPU, one slice per thread.
    ``first`` is the index of a slice's first element. NumPy arrays among the inputs are put on the device with the
    types of the kernel's arguments. A shape, a tuple, stands for an output, zero at first. Returns the outputs.
    """
    arguments = [_as_argument(value, a.type, device) for value, a in zip(inputs, kernel.adj.args[1:], strict=True)]
    threads = min(threads or available_cores(), size) if device == "cpu" else 1
    if size > 0 and threads == 1:
        wp.launch(kernel, dim=size, inputs=[begin, *arguments], device=device)
    elif size > 0:
        load_kernels(kernel, device)  # once, before the threads would all try
        edges = [begin + size * i // threads for i in range(threads + 1)]

        def run_slice(i: int) -> None:
            wp.launch(kernel, dim=edges[i + 1] - edges[i], inputs=[edges[i], *arguments], device=device)

        futures = [thread_pool(threads - 1).submit(run_slice, i) for i in range(1, threads)]
        run_slice(0)  # on this thread
        for future in futures:
            future.result()
    return [a.numpy() for a, value in zip(arguments, inputs, strict=True) if isinstance(value, tuple)]
