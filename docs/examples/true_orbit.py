# %% One orbit in double precision, and the true orbit of the same start.
import numpy as np

from extensions.proofs import true_orbit
from pseudorigid import Ball, Picture, orbit

ball = Ball(k=0.2, g=0.04)
doubles = orbit(ball, ball.start(0.6, energy=0.01), impacts=160)
true = true_orbit("1/5", "1/25", "1/100", 160, start="3/5")
# %% They part after some 120 impacts: the error grows by a factor of e in every four.
picture = Picture([80, 160], [-0.2, 0.53], ("Impact", "$x$"), "A chaotic orbit, $E$ = 0.01")
picture.line(true["impact"], true["x"], "true orbit", color="orangered", lw=0.8)
picture.dots(np.arange(1, 161), doubles["x"], "royalblue", 2.8, "in double precision")
picture.save("true_orbit.png")
