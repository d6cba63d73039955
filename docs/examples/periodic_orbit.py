# %% A periodic orbit in time: one period of ten impacts at a low energy.
from pseudorigid import Ball, Picture, motion, symmetric_orbits

ball = Ball(k=0.2, g=0.04)
ten = symmetric_orbits(ball, energy=0.001, period=10).isel(orbit=0)
path = motion(ball, ten, duration=ten["total_time"])
# %% The two curves meet at the impacts, where the ball touches the floor.
t, height, strain = path["t"], -path["position"], path["strain"]
picture = Picture(t, [-0.35, 0], ("$t$", ""), "Elliptic orbit of period ten, $E$ = 0.001")
picture.line(t, height, "height $-x$", color="royalblue", lw=1.2)
picture.line(t, strain, "strain $u$", color="orangered", lw=1.2, ls="--")
picture.dots(path["impact_t"], -path["impact_position"], "black", 3, "impact")
picture.save("periodic_orbit.png")
