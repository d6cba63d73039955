"""Small versions of the datasets of claims."""

import json
from unittest.mock import patch

from extensions.atlas.cell import block_of_cells_of_a_sweep
from extensions.atlas.last_curve import last_curve
from extensions.atlas.sweep import dataset_of_a_sweep
from extensions.claims.analyses.clusters import clusters
from extensions.claims.analyses.control import control
from extensions.claims.analyses.exclusion import exclusion
from extensions.claims.analyses.flux import flux
from extensions.claims.analyses.jumps import jumps
from extensions.claims.analyses.rotation import rotation
from extensions.claims.analyses.spread import spread
from paper import values
from pseudorigid.dynamics import lyapunov, manifolds, motion, orbits
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.periodic import symmetric_orbits

BALL, HIGH, LOW = Ball(**values.BALL), 0.01, 0.001
STARTS_2 = [-0.440981, -0.338085, -0.23519, -0.132294, -0.063608, 0.142183, 0.165702, 0.534522]
CONTROL = {
    "strengths": [0.05], "orbits": 120, "impacts": 8000, "starts": STARTS_2,
    "shown": 0.05, "drawn": 300,
}  # fmt: skip
STARTS_8 = [-0.20706, 0.155183, 0.426642, 0.66769, 0.894427, 0.999522]


def sweep(ks, energies, starts, impacts):
    """Return the dataset of a sweep over k and E/g^2."""
    work = {"starts": starts, "impacts": impacts}
    cells = [[k, energy] for k in ks for energy in energies]
    block = block_of_cells_of_a_sweep(cells, **work)
    dataset = dataset_of_a_sweep(block, k=ks, energy=energies)
    return dataset.assign_attrs(g=0.04, config=json.dumps(work))


def made(stage, *inputs, ball=BALL, energy=HIGH, method=None, **fields):
    """Return a stage's dataset with the attributes of a saved one."""
    config = fields if method is None else fields | {"method": method}
    about = {"k": ball.k, "g": ball.g, "energy": energy, "config": json.dumps(config)}
    dataset = stage(ball, energy, *inputs, **fields)
    return dataset.assign_attrs(about | dataset.attrs)


def flux_of_the_paper():
    """Return the dataset of the flux through the turnstiles of the period-six orbit.

    Its lobes have 15 digits, for which their orbits start farther from the saddle.
    """
    few = {"_BITS": (1200, 900), "_PERIODS_EARLIER": (6, 9)}
    with patch.multiple("extensions.claims.analyses.flux", **few):
        return made(flux, period=6, distance=3e-4, orbits=29, impacts=6000)


def datasets(derived, flowing):
    """Return name -> dataset; those of the derivations and of the flux are given."""
    one, six = (made(symmetric_orbits, period=period) for period in (1, 6))
    scan = ImpactMap((0.3, 1e-12))
    published = made(
        lyapunov.scene_exponents, ball=Ball(0.2, 0.04, map=scan), records=4,
        method={"scan": 0.3, "tolerance": 1e-12}, starts=[0.6, 0.62, 0.65], impacts=20_000,
    )  # fmt: skip
    line = [0.3125, 0.625, 3.0, 6.25, 10.3125, 13.0, 16.5625, 18.75]
    return {
        "derivations": derived,
        "fig2/orbits": made(
            orbits.scene_orbits, starts=STARTS_2,
            impacts=[1500, 2500, 3000, 3500, 4000, 3000, 2500, 25000],
        ),
        "fig3/periodic": one,
        "fig3/motion": made(motion.scene_motion, one, period=1, type="elliptic", duration=16),
        "fig4/periodic": six,
        "fig4/motion": made(motion.scene_motion, six, period=6, type="elliptic", duration=60),
        "fig5/manifolds": made(
            manifolds.scene_manifolds, six, period=6, type="hyperbolic",
            resolution={"distance": 0.02, "bend": 20},
            branches={"outer": {"length": 2.8}, "inner": {"length": 1}},
        ),
        "fig6/manifolds": made(
            manifolds.scene_manifolds, six, period=6, type="hyperbolic",
            resolution={"distance": 0.1, "bend": 20}, point=0, length=0.1,
            window={"x": [-0.002862691, 0.001413489], "xdot": [-0.00109292, 0.000777909]},
        ),
        "fig7/lyapunov": made(
            lyapunov.scene_exponents, records=4, starts=[0.6, 0.62, 0.65], impacts=200_000
        ),
        "fig8/orbits": made(
            orbits.scene_orbits, energy=LOW, starts=STARTS_8,
            impacts=[2000, 3500, 4500, 5000, 15000, 5000],
        ),
        "as_published/fig7/lyapunov": published.assign_attrs(
            impacts=scan.impacts, impacts_missed=scan.missed
        ),
        "atlas/line": sweep([0.2], line, 300, 3000),
        "atlas/plane": sweep([0.1, 0.2, 0.3], [1.0, 4.0, 10.0], 240, 1500),
        "clusters/clusters": made(
            clusters, orbits=116, impacts=3000, cuts=[4, 6], lags=2, resamples=40,
            seed=1,
        ),
        "control/control": made(control, **CONTROL),
        "control_low/control": made(control, energy=LOW, **CONTROL | {"impacts": 4000}),
        "exclusion/exclusion": made(exclusion, grid=60, followed=80),
        "jumps/jumps": made(jumps, energies=[0.0018], sides=200),
        "rotation/rotation": made(
            rotation, energies=[0.001, 0.026], starts=200, impacts=6000, detail=(-0.8344, -0.8341),
            detail_impacts=50_000,
        ),
        "spread/spread": made(
            spread, orbits=16, length=200_000, blocks=20,
            regular=[-0.44, 0.142183], regular_impacts=1 << 14, cells=20, visits=1 << 14,
        ),
        "flux/flux": flowing,
        "last_curve/last_curve": made(
            last_curve, nobles=[[0, 5, 1, 15], [0, 5, 1, 17]], convergents=6,
            between=(-0.2, -0.0325639), drawn=10,
        ),
    }  # fmt: skip
