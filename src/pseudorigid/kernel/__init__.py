"""Compiled impact map, with the same bits on every machine."""
