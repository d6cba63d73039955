"""The impact map in ball arithmetic (Arb, through python-flint): the one part that proofs share.

A ball is a midpoint and a radius; every operation returns a ball that contains all results. What
is asked of a set of states holds for each state in it. Where balls are too wide, or the precision
of the context too low, to decide, `UndecidedError` is raised: nothing is ever assumed.
"""
