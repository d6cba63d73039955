"""What each kind of picture reports: quantity -> value as text, measured in its datasets.

A function has the name of a kind and takes the scene's block and the datasets by their stages.
KIND_facts returns what the kind's caption says of what was computed and drawn (`d` in
captions.toml). The last four functions help them, and those of extensions.
"""

from collections.abc import Sequence
from typing import Any

import xarray as xr


def portrait(block: dict[str, Any], orbits: xr.Dataset) -> dict[str, str]:
    """Count orbits and impacts; give their energy and how near they come to grazing."""
    speed = float((orbits["xdot"] + orbits["udot"]).min())
    return {
        "orbits": f"{orbits.sizes['orbit']:,}",
        "impacts": f"{orbits.sizes['point']:,}",
        **energy_of(block, orbits),
        "least speed of contact": f"{speed:.2g}",
        "x": f"{float(orbits['x'].min()):.4f} to {float(orbits['x'].max()):.4f}",
    }


def portrait_facts(block: dict[str, Any], orbits: xr.Dataset) -> dict[str, Any]:
    """Count the orbits of each type of which something is seen, the others, and the points."""
    from .portrait import drawn

    seen = drawn(block, orbits)[1]
    types = orbits["type"].values[seen > 0].tolist()
    points = {"seen": int(seen.sum()), "points": orbits.sizes["point"]}
    return counts(types) | {"unseen": len(seen) - len(types)} | points


def motion(block: dict[str, Any], periodic: xr.Dataset, motion: xr.Dataset) -> dict[str, str]:
    """Describe the orbit, the times and impacts drawn, its period in time and its strain."""
    import numpy as np

    from pseudorigid.dynamics.variables import of_type

    axes, everywhere = block.get("axes", {}), {"limits": (-np.inf, np.inf)}
    across, up = (axes.get(name, everywhere)["limits"] for name in ("t", "displacement"))
    times = np.clip(motion["t"].values[[0, -1]], *across)
    impacts = (across, motion["impact_t"].values), (up, -motion["impact_position"].values)
    drawn = np.all([(low <= at) & (at <= high) for (low, high), at in impacts], axis=0)
    orbit = of_type(periodic, block["type"])
    return about_orbit(periodic, block) | {
        "time": "{:g} to {:g}".format(*times),
        "time of one period": f"{float(orbit['total_time']):.6f}",
        "impacts drawn": f"{drawn.sum():,}",
        "strain": f"{float(motion['strain'].min()):.4f} to {float(motion['strain'].max()):.4f}",
    }


def tangle(
    block: dict[str, Any], orbits: xr.Dataset, periodic: xr.Dataset, manifolds: xr.Dataset
) -> dict[str, str]:
    """Describe the orbit, and count its branches and their points."""
    return about_orbit(periodic, block) | {
        "branches": f"{manifolds.sizes['branch']:,}",
        "points of the lines": f"{manifolds.sizes['vertex']:,}",
    }


def tangle_facts(
    block: dict[str, Any], orbits: xr.Dataset, periodic: xr.Dataset, manifolds: xr.Dataset
) -> dict[str, Any]:
    """Name the marks that are seen, and the sides whose branches meet.

    The reversor maps y = xdot - k udot to -y, and an unstable branch to a stable one, which it
    meets where it crosses y = 0.
    """
    import numpy as np

    from pseudorigid.dynamics.variables import rows, states_of

    from .tangle import drawn

    _, xdot, udot = states_of(manifolds)
    y, meeting = xdot - block["ball"]["k"] * udot, set()
    names = zip(rows(manifolds), manifolds["stable"].values, manifolds["side"].values, strict=True)
    for span, stable, side in names:
        above = np.where(np.abs(y[span]) > 1e-9, np.sign(y[span]), np.nan)
        if not stable and (above[1:] * above[:-1] < 0.0).any():
            meeting.add(str(side))
    return {"seen": drawn(block, orbits, manifolds, periodic)[1], "meeting": sorted(meeting)}


def closeup(block: dict[str, Any], periodic: xr.Dataset, manifolds: xr.Dataset) -> dict[str, str]:
    """Describe the orbit, the window and the point."""
    quantities, attributes = about_orbit(periodic, block), manifolds.attrs
    for name in ("x", "xdot"):
        ends = attributes[f"window_{name}"]
        quantities[f"window, {name}"] = "{:.7g} to {:.7g}".format(*ends)
    for name in ("x", "xdot"):
        quantities[f"{name} of the point"] = f"{attributes[f'point_{name}']:.7f}"
    return quantities


def closeup_facts(block: dict[str, Any], manifolds: xr.Dataset, **_: xr.Dataset) -> dict[str, Any]:
    """Say whether a branch oscillates and whether both kinds coincide, and so differ in width.

    A branch oscillates if, in all, it turns by more than two whole turns.
    """
    import numpy as np

    from pseudorigid.dynamics.variables import rows

    from .closeup import drawn

    x, xdot = (manifolds[n] / np.ptp(manifolds.attrs[f"window_{n}"]) for n in ("x", "xdot"))
    steps = [np.diff((x + 1j * xdot).values[span]) for span in rows(manifolds)]
    turns = [np.nansum(np.abs(np.angle(step[1:] * step[:-1].conj()))) for step in steps]
    return {"oscillates": bool(max(turns) > 4.0 * np.pi), "coincide": drawn(block, manifolds)[1]}


def exponents(block: dict[str, Any], lyapunov: xr.Dataset) -> dict[str, str]:
    """Give the final exponents, and mean and spread of the largest ones, of one type only."""
    import numpy as np

    from pseudorigid.dynamics.variables import final_exponents

    last, types = final_exponents(lyapunov), lyapunov["type"].values
    kind = "chaotic" if "chaotic" in types else types[0]
    alike = types == kind
    some = np.sort(last[alike, 0])
    spread = f", standard deviation {np.std(some, ddof=1):.4f}" if some.size > 1 else ""
    known = alike.all() or kind == "chaotic"
    mean = {f"mean largest exponent ({kind})": f"{np.mean(some):.4f}{spread}"} if known else {}
    rounded = [np.round(row, 4) + 0.0 for row in (last[:, 0], *last)]  # 0.0 turns -0.0 into 0.0
    rows = [", ".join(f"{value:.4f}" for value in row) for row in rounded]
    return {
        "largest exponent": rows[0],
        "standard error of each largest, from eighths of its run": (
            ", ".join(f"{error:.4f}" for error in _errors_of_largest(lyapunov))
        ),
        **mean,
        "all three of an orbit, at the end": "; ".join(rows[1:]),
        "impacts of each orbit": f"{int(lyapunov['impact'].values[-1]):,}",
    }


def _errors_of_largest(lyapunov: xr.Dataset) -> list[float]:
    """Return the standard error of each largest exponent from the spread of parts of the run.

    It is too small where an orbit stays near islands for longer than an eighth of its run.
    """
    import numpy as np

    impact, errors = lyapunov["impact"].values, []
    for column in lyapunov["exponent"].values.max(axis=2).T:
        known = np.flatnonzero(np.isfinite(column))
        ends = np.unique(known[np.arange(1, 9) * known.size // 8 - 1]) if known.size >= 8 else known
        sums = np.diff(impact[ends] * column[ends], prepend=0.0)
        parts = sums / np.diff(impact[ends], prepend=0)
        errors.append(np.std(parts, ddof=1) / np.sqrt(parts.size) if parts.size > 1 else np.nan)
    return errors


def exponents_facts(block: dict[str, Any], lyapunov: xr.Dataset) -> dict[str, Any]:
    """Count orbits by type, and say from where to where the largest chaotic exponents are."""
    from pseudorigid.dynamics.variables import final_exponents

    from .exponents import drawn

    chaotic = lyapunov["type"].values == "chaotic"
    largest = sorted(final_exponents(lyapunov)[chaotic, 0].tolist())
    return {
        **counts(lyapunov["type"].values.tolist()),
        "largest": [f"{value:.4f}" for value in largest[:: max(len(largest) - 1, 1)]],
        "upper": bool(drawn(block, lyapunov)[1].size),
    }


def counts(types: Sequence[str]) -> dict[str, int]:
    """Count the orbits of each type."""
    return {name: types.count(name) for name in ("chaotic", "regular", "undecided", "undefined")}


def about_orbit(periodic: xr.Dataset, block: dict[str, Any]) -> dict[str, str]:
    """Return the orbit's type and period, its energy, and its rotation number or multiplier."""
    from pseudorigid.dynamics.variables import of_type

    orbit = of_type(periodic, block["type"])
    last = "rotation_number" if block["type"] == "elliptic" else "multiplier"
    return {
        "orbit": f"{orbit['type'].item()}, period {orbit.sizes['point']}",
        **energy_of(block, orbit),
        last.replace("_", " "): f"{float(orbit[last]):.6f}",
    }


def energy_of(block: dict[str, Any], states: xr.Dataset) -> dict[str, str]:
    """Return the energy of a dataset's states, eq. (29), to twelve digits."""
    from pseudorigid.dynamics.variables import states_of
    from pseudorigid.kernel import closed_forms

    x, xdot, udot = states_of(states)
    energy = closed_forms.energy(**block["ball"], x=x, xdot=xdot, udot=udot)
    ends = dict.fromkeys(f"{value:.12g}" for value in (energy.min(), energy.max()))
    return {"energy": " to ".join(ends)}


def listing(data: xr.Dataset, template: str, *names: str) -> str:
    """Format the values of some variables of a dataset side by side, with commas between rows."""
    rows = zip(*(data[name].values for name in names), strict=True)
    return ", ".join(template.format(*row) for row in rows)
