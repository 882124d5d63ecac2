"""Warp kernels: the only room that imports warp, and one source for CPU and CUDA."""
