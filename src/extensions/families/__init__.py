"""Families of periodic orbits, followed over the energy or k, and what they explain."""
