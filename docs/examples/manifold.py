# %% Stable and unstable manifolds of the hyperbolic orbit of period six.
from pseudorigid import Ball, Picture, symmetric_orbits, trace_manifold

ball = Ball(k=0.2, g=0.04)
six = symmetric_orbits(ball, energy=0.01, period=6).isel(orbit=1)
lines = [trace_manifold(ball, 0.01, six, n, side="outer", length=7) for n in range(6)]
# %% Time reversal maps y to -y, and the unstable branches to the stable ones.
picture = Picture([-0.19, 0.54], [-0.2, 0.2], ("$x$", "$y$"), "Outer branches, $E$ = 0.01")
for sign, label, hue in ((-1, "stable", "yellowgreen"), (1, "unstable", "royalblue")):
    for line in lines:
        y = sign * (line["xdot"] - ball.k * line["udot"])
        picture.line(line["x"], y, label, color=hue, lw=0.7)
picture.dots(six["x"], six["xdot"] - ball.k * six["udot"], "black", 3.5, "orbit")
picture.save("manifold.png")
