"""Searches in floating point: they propose certificates, and prove nothing.

They use the ball map, for its midpoints, and the dynamics. The checkers do not use the searches.
"""
