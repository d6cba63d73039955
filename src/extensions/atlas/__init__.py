"""A sweep: regular and chaotic motion over a grid of k and E/g^2.

The map commutes with a change of the unit of length. A sweep takes g R as this unit, so that g = 1
and the energy is E/g^2: a cell holds for every g at which eq. (31) admits its energy.

`kinds` lists the cells and cuts them into blocks. `cell` computes the numbers of a cell and joins
blocks to one dataset. `verdicts` measures how often orbits are classified wrongly, and `last_curve`
finds the edge of the main island.
"""
