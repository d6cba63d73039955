# %% How the next impact is found: a step to the root of a parabola that lies above the gap.
import numpy as np

from pseudorigid import Ball, Picture

(k, g), start, ball = (0.2, 0.04), 5.0, Ball(k=0.2, g=0.04)
x, v, w = ball.state(0.126, -0.129, energy=0.01)  # one that all but touches at t = 2
b, c = ((1 - k) * v - 2 * k * w) / (1 + k), -(2 * v + (1 - k) * w) / (1 + k)
tau, curve = ball.impact(x, v, w)[3], g + np.hypot(x, c)  # no second derivative is larger
t = np.linspace(0.0, tau + 0.3, 400)
f, at = (x + b * s + g * s * s / 2 - x * np.cos(s) + c * np.sin(s) for s in (t, start))
slope = b + g * start + x * np.sin(start) + c * np.cos(start)
step = (np.sqrt(slope**2 - 2 * curve * at) - slope) / curve
h = np.linspace(0.0, step + 0.3, 100)
picture = Picture(t, f, ("$t$", "gap $f$"), "A step of the march, and the next impact")
picture.line(t, f, "gap", color="black", lw=1.2)
picture.line(start + h, at + slope * h + curve * h**2 / 2, "majorant", color="#d55e00", ls="--")
picture.line([start, start + step], [0.0, 0.0], "step", color="#0072b2", lw=2.5)
picture.dots([tau], [0.0], "black", 5, "root")
picture.save("gap.png")
