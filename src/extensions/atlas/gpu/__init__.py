"""Cells of a sweep on a graphics processor."""
