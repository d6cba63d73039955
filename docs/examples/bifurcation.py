# %% A bifurcation: two orbits of period six are born at the fixed point.
import numpy as np

from pseudorigid import Ball, Picture, symmetric_orbits

ball = Ball(k=0.2, g=0.04)
hues = {"elliptic": "mediumblue", "hyperbolic": "orangered"}
title = "The fixed point and orbits of period six"
picture = Picture([0.007, 0.0095], [-0.14, 0.25], ("$E$", "$x$"), title)
for energy in np.linspace(0.007, 0.0095, 41):
    for orbits in (symmetric_orbits(ball, energy, period) for period in (1, 6)):
        for x, kind in zip(orbits["x"].values, orbits["type"].values, strict=True):
            picture.dots(0 * x + energy, x, hues[kind], 1.6, kind)
picture.save("bifurcation.png")
