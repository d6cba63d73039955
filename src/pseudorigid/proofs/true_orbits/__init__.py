"""Orbits that are the orbits of their starts, every number the rounded true value."""
