"""Proved flights and orbits, in ball arithmetic.

`flight` encloses one flight of a ball of states, and proves which root of the gap is the first.
`reference_solver` proves flight times and orbits of states that are given as doubles.

It needs python-flint, which `pip install pseudorigid[verified]` adds.
"""
