"""A grid over k and E/g^2, the two numbers that decide what is free of the unit of length.

The map commutes with a change of the unit of length, so here lengths are in units of g R: then
g = 1 and the energy is E/g^2. A cell holds for every ball with this k, whatever its g, as long as
eq. (31) lets it bounce at that energy.

`grid` knows the cells and how they are cut into blocks, `verdict` judges orbits, `cell` computes
one cell, `blocks` computes a block and joins them.
"""
