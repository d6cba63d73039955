"""Curves of periodic orbits against a parameter: pseudo-arclength continuation and its events."""
