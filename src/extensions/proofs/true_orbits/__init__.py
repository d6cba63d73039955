"""Orbits of exact starts, each number correctly rounded."""
