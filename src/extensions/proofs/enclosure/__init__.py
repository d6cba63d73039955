"""The impact map in ball arithmetic (Arb, through python-flint).

A ball is a midpoint and a radius. Every operation returns a ball that contains all possible
results, so a statement about a ball holds for each number in it. `UndecidedError` is raised where
the balls are too wide, or the precision of the context is too low, to decide.
"""
