"""Compilation of kernels for other processors: a library of other parts, without commands."""

from pipeline.declaration import Part

PART = Part()
