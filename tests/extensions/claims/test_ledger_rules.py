"""The rule of each verdict, on made-up datasets that lie on either side of each condition."""

import math
from collections import defaultdict

import numpy as np
import pytest
import xarray as xr

from extensions.claims.analyses.strains import flight_strains
from extensions.claims.analyses.stretches import spread_of_runs, stretches
from extensions.claims.ledger import chaos, lookup, model, periodic
from extensions.claims.ledger.outcomes import CORRECTED, FALSE, HOLDS, PROVED, UNDECIDED
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import described

ALL, NONE = defaultdict(lambda: True), defaultdict(bool)  # theorems that are proved


def data(dims="", /, **values):
    """Return a dataset: arrays are variables, with the first of the dims; the others attributes."""
    arrays = {name: np.asarray(v) for name, v in values.items() if isinstance(v, list | np.ndarray)}
    attributes = {name: v for name, v in values.items() if name not in arrays}
    variables = {name: (tuple(dims.split())[: v.ndim], v) for name, v in arrays.items()}
    return xr.Dataset(variables, attrs=attributes)


def formulas(printed=1, corrected=1):
    names = ["jump_conditions", "conserved_energy", "determinants", "bound_in_flight", "smooth"]
    names += ["euler_tensor", "softness", "one_form", "area", "reversible"]
    values = dict.fromkeys(names, 0.0) | {"euler_tensor": 0.2, "softness": 5.0, "smooth": 0.001}
    rows = {"printed": [printed] * 10, "corrected": [corrected] * 10, "value": [*values.values()]}
    return data("formula", **rows).assign_coords(formula=names)


def sea(exponent, chaotic=None, **attributes):
    """Return a dataset of `spread` with exponents (block, orbit, index) and the chaotic orbits."""
    exponent = np.asarray(exponent, float)
    kinds = np.where(
        [True] * exponent.shape[1] if chaotic is None else chaotic, "chaotic", "regular"
    )
    found = xr.Dataset(
        {"exponent": (("block", "orbit", "index"), exponent), "type": ("orbit", kinds)}
    )
    return found.assign_attrs({"block_impacts": 1000} | attributes)


def word(outcome):
    return outcome.verdict


# -- the sea ---------------------------------------------------------------------------------------

COUNTS = [0, 90, 100, 20, 5, 30, 50, 14, 14]  # flights; the valley is at 4


@pytest.mark.parametrize(("change", "verdict", "valley"), [
    ({}, HOLDS, 4.0),
    ({4: 12}, HOLDS, 4.0),
    ({4: 13}, FALSE, 4.0),  # above a quarter of the lower peak
    ({1: 20, 2: 20, 4: 6}, FALSE, 4.0),  # which may be the first one
    ({1: 0}, HOLDS, 4.0),  # short flights are no valley
    ({8: 0}, HOLDS, 4.0),  # nor is the last bin, which may be cut short
])  # fmt: skip
def test_a_valley_is_deep_beside_the_lower_peak(change, verdict, valley):
    flights = [change.get(i, n) for i, n in enumerate(COUNTS)]
    cuts = xr.Dataset({name: ("cut", [4.0, 6.0]) for name in ("cluster_impacts", "period")})
    cuts["period_error"] = "cut", [0.1, 0.3]
    cuts["flights"], cuts["bin_edge"] = ("bin", flights), ("edge", np.arange(10.0))
    found = chaos.clustered(cuts)
    assert (word(found), found.numbers["valley"]) == (verdict, valley)
    assert found.numbers["period_error"] == 0.3 and len(found.numbers["clusters"]) == 2


@pytest.mark.parametrize(("low", "verdict"), [
    ([[[0.005, 0.004]], [[0.0, 0.009]]], HOLDS),
    ([[[0.005, 0.011]], [[0.0, 0.009]]], CORRECTED),  # one coordinate, at one cut
    ([[[0.011, 0.0]], [[0.0, 0.02]]], FALSE),  # at each cut
])  # fmt: skip
def test_clusters_remember_if_the_interval_of_a_coordinate_lies_above(low, verdict):
    low = np.array(low)
    clusters = xr.Dataset({"cut": ("cut", [4.0, 6.0])})
    ends = {"": low + 0.01, "_low": low, "_high": low + 0.05}
    for end, values in ends.items():
        clusters[f"dependence{end}"] = ("cut", "lag", "then"), values
        pairs = np.stack([values, values], axis=2)
        clusters[f"correlation{end}"] = ("cut", "lag", "first", "then"), pairs
    found = chaos.uncorrelated(clusters)
    assert word(found) == verdict and found.numbers["widest"] == pytest.approx(0.04)


@pytest.mark.parametrize(("least", "verdict"), [(96, CORRECTED), (95, FALSE)])
def test_each_orbit_enters_nearly_all_cells_at_the_end(least, verdict):
    spread = sea(np.ones((1, 3, 3)), [True, False, True])
    for name, values in (("any", [99, 100]), ("least", [99, least]), ("all", [99, 99])):
        spread[f"entered_{name}"] = "visit", values
    spread["visit"] = "visit", [10, 20]
    found = chaos.connected(spread)
    assert word(found) == verdict
    assert found.numbers == {
        "chaotic": 2, "orbits": 3, "impacts": 20, "every": 100, "least": least
    }  # fmt: skip
    one = chaos.one_chaotic_sea(spread, NONE)
    assert word(one) == (UNDECIDED if verdict == CORRECTED else FALSE)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("share", "kind", "verdict"),
    [(0.9, "regular", HOLDS), (1.1, "regular", FALSE), (0.9, "chaotic", FALSE)],
)
def test_each_exponent_of_a_regular_orbit_is_within_the_bound(sign, share, kind, verdict):
    exponents = np.zeros((2, 2, 3))
    exponents[0], exponents[-1, 1, 2] = 9.0, sign * share * chaos.regular_bound(1 << 20)
    spread = data("length island index", length=[1 << 19, 1 << 20], regular_exponent=exponents)
    spread["regular_type"] = "island", ["regular", kind]
    assert word(chaos.regular_exponents(spread)) == verdict


def test_orbits_differ_if_one_mean_is_off_by_more_than_its_own_chance():
    noise = np.random.default_rng(1).normal(0.0, 0.01, (50, 6)) * [1.0, 1.0, 1.0, 1.0, 5.0, 1.0]
    noise -= noise.mean(axis=0)
    blocks = np.zeros((50, 6, 3))
    blocks[:, :, 0] = 0.2 + noise
    errors = np.sqrt(np.sum(noise**2, axis=0) / 49 / 50)
    for off, verdict in ((0.0, HOLDS), (4.9, HOLDS), (5.1, FALSE)):
        blocks[:, 2, 0] = 0.2 + noise[:, 2] + off * errors[2] * 6 / 5
        found = chaos.independent_of_start(sea(blocks))
        assert word(found) == verdict
        assert found.numbers["furthest"] == pytest.approx(off, abs=1e-6)
    most = pytest.approx(blocks[:, 2, 0].mean(), abs=1e-15)
    assert found.numbers["most"] == most and found.numbers["least"] < 0.201
    assert word(chaos.independent_of_start(sea(noise[:, :, None] - [0.1, 0.2, 0.3]))) == FALSE
    assert word(chaos.independent_of_start(sea(blocks, np.arange(6) != 2))) == HOLDS


def test_each_chaotic_orbit_exceeds_a_hundred_times_the_bound():
    bound = 100.0 * chaos.regular_bound(10_000_000)
    for share, verdict in ((1.1, HOLDS), (0.9, FALSE)):
        blocks = np.full((10_000, 3, 3), 2.0 * bound)
        blocks[:, 1] = share * bound
        assert word(chaos.chaotic_nature(sea(blocks), ALL)) == verdict
        assert word(chaos.chaotic_nature(sea(blocks, [True, False, True]), ALL)) == HOLDS


@pytest.mark.parametrize(
    ("orbits", "impacts", "least", "verdict"),
    [(3, 200_000, 0.11, HOLDS), (3, 200_000, 0.09, FALSE), (2, 200_000, 0.2, FALSE),
     (3, 100_000, 0.2, FALSE)],
)  # fmt: skip
def test_figure_7_has_the_printed_orbits_and_each_is_chaotic(orbits, impacts, least, verdict):
    ends = np.full((2, orbits, 3), [0.0, 0.24, -0.24])
    ends[1, 0] = -least, 0.0, least
    found = chaos.figure_7(data("record orbit index", exponent=ends, impact=[1, impacts]))
    assert word(found) == verdict and min(found.numbers["ends"]) == least


def test_a_printed_exponent_is_the_mean_or_that_of_likely_short_runs():
    alternating = np.where(np.arange(400) % 2, 1.0, -1.0)[:, None]
    apart = 0.01 * np.array([-1.0, 1.0, 0.0, 0.0])  # of the means, with error 0.0041
    for middle, swing, verdict in (
        (0.236, 0.0, HOLDS),
        (0.245, 0.04, CORRECTED),  # off, but short runs reach it
        (0.255, 0.001, FALSE),
        (0.215, 0.001, FALSE),
    ):
        blocks = np.zeros((400, 4, 3))
        blocks[:, :, 0] = middle + apart + swing * alternating
        spread = sea(blocks, block_impacts=200_000).assign(
            described(spread_of_runs(blocks, 200_000))
        )
        found = chaos.long_run_exponent(spread)
        assert word(found) == verdict
        assert found.numbers["error"] == pytest.approx(2.0 * 0.01 / math.sqrt(6.0), rel=1e-3)
        above = 100 * np.mean(blocks[:, :, 0] > 0.235)
        assert found.numbers["percent"] == pytest.approx(above)


def test_exponents_vanish_in_pairs_and_each_is_looked_at():
    right = np.full((10, 2, 3), [0.3, 0.0, -0.3])  # 10,000 impacts: 0.01 is too much
    assert word(chaos.opposite_exponents(formulas(), sea(right))) == HOLDS
    assert word(chaos.opposite_exponents(formulas(0), sea(right))) == FALSE
    for index, off in ((0, 0.011), (2, 0.011), (1, 0.011), (1, -0.011), (0, -0.011)):
        wrong = right.copy()
        wrong[:, 1, index] += off
        assert word(chaos.opposite_exponents(formulas(), sea(wrong))) == FALSE
        middle = chaos.third_exponent(formulas(), sea(wrong))
        assert word(middle) == (FALSE if index == 1 else HOLDS)
        assert middle.numbers["middle"] == pytest.approx(0.011 if index == 1 else 0.0)
    assert word(chaos.third_exponent(formulas(0), sea(right))) == FALSE


def test_stretches_are_of_the_chaotic_orbits_and_of_whole_blocks():
    blocks = np.random.default_rng(2).normal(size=(5, 3, 3))
    found = stretches(sea(blocks, [True, False, True]), 2000)
    means = [0.5 * (blocks[i, orbit] + blocks[i + 1, orbit]) for i in (0, 2) for orbit in (0, 2)]
    assert found == pytest.approx([max(mean) for mean in means])


# -- the energy and the material -------------------------------------------------------------------


def line(share, width=0.02, energy=(0.625, 3.0, 6.25)):
    share = np.atleast_2d(np.asarray(share, float))
    ends = {"regular": share, "regular_low": share - width, "regular_high": share + width}
    found = xr.Dataset({name: (("k", "energy"), values) for name, values in ends.items()})
    ks = 0.1 * np.arange(1, 1 + len(share))
    return found.assign_coords(k=ks, energy=[*energy]).assign_attrs(g=0.04)


def test_a_share_depends_on_the_energy_if_it_falls_to_less_than_half():
    for share, verdict in (([0.9, 0.3, 0.44], HOLDS), ([0.9, 0.5, 0.46], FALSE)):
        found = chaos.depends_on_energy(line([share]), NONE)
        assert word(found) == verdict and found.numbers["width"] == pytest.approx(0.04)
        assert (found.numbers["low"], found.numbers["high"]) == (min(share), 0.9)
        assert [row["energy"] for row in found.numbers["shares"]] == pytest.approx([0.001, 0.01])
        assert [row["share"] for row in found.numbers["shares"]] == [share[0], share[2]]


@pytest.mark.parametrize(
    ("share", "verdict"),
    [([0.9, 0.5, 0.3], HOLDS), ([0.9, 0.5, 0.46], FALSE), ([0.9, 0.2, 0.3], CORRECTED),
     ([0.9, 0.27, 0.3], HOLDS)],
)  # fmt: skip
def test_a_rise_within_the_intervals_is_none(share, verdict):
    assert word(chaos.destroyed_with_energy(line([share]), NONE)) == verdict


@pytest.mark.parametrize(
    ("least", "verdict"), [(0.4, HOLDS), (0.46, HOLDS), (0.47, FALSE), (0.49, FALSE)]
)
def test_shares_differ_over_the_material_if_their_intervals_are_apart(least, verdict):
    plane = line([[0.1, 0.2, 0.5], [0.9, 0.9, least]], width=0.019)
    found = chaos.dependence_on_material(plane)
    assert word(found) == verdict
    assert (found.numbers["least"]["share"], found.numbers["most"]["share"]) == (least, 0.5)


@pytest.mark.parametrize(
    ("low", "high", "verdict"), [(0.02, 0.98, HOLDS), (0.009, 0.98, FALSE), (0.02, 0.991, FALSE)]
)
def test_a_share_is_mixed_if_its_interval_is_off_both_ends(low, high, verdict):
    plane = line([[0.5, 0.5, 0.5, 0.5]], 0.1, (1.0, 2.0, 3.0, 4.0))
    plane["regular_low"][0, 1:3], plane["regular_high"][0, 1:3] = low, high
    plane["trace"] = ("k", "energy"), np.zeros((1, 4))
    found = chaos.mixed_shares(plane, NONE)
    assert word(found) == verdict and found.numbers["bare"] == 100.0
    assert found.numbers["mixed"] == (100.0 if verdict == HOLDS else 50.0)
    assert found.numbers["fixed_points"] is True
    plane["trace"][0, 3] = math.nan
    assert chaos.mixed_shares(plane, NONE).numbers["fixed_points"] is False


# -- the model -------------------------------------------------------------------------------------


def test_the_mean_strain_energy_exceeds_a_tenth_by_three_errors():
    right, wrong = (sea(np.full((4, 2, 3), exponent)) for exponent in (0.2, -0.2))
    for apart, verdict in ((0.0, HOLDS), (0.07, HOLDS), (0.085, FALSE)):
        share = np.array([0.2 - apart, 0.2 + apart, 0.2])
        table = {"strain_energy": share, "kinetic_energy": 1.0 - share, "time": [1.0, 1.0, 2.0]}
        found = model.strain_energy(data("orbit", **table), right)
        assert word(found) == verdict
        assert found.numbers["mean"] == pytest.approx(0.2)
        error = apart * math.sqrt(2 * 3 / 2) / 4
        assert found.numbers["standard_error"] == pytest.approx(error, abs=1e-12), apart
        assert word(model.strain_energy(data("orbit", **table), wrong)) == FALSE


def test_parameters_are_all_compared():
    right = {"energy": 0.01, "k": 0.2, "g": 0.04}
    assert word(model.parameters(formulas(), data(**right))) == HOLDS
    assert word(model.parameters(formulas(0), data(**right))) == FALSE
    for name, value in (("energy", 0.011), ("k", 0.201), ("g", 0.041)):
        assert word(model.parameters(formulas(), data(**right | {name: value}))) == FALSE
    solid = formulas().assign(value=formulas()["value"] + 0.1)
    assert word(model.parameters(solid, data(**right))) == FALSE
    assert word(model.homogeneous(solid, data(**right))) == FALSE
    assert word(model.homogeneous(formulas(), data(**right))) == CORRECTED
    assert word(model.homogeneous(formulas(0, 0), data(**right))) == FALSE


def test_one_orbit_decides_energies_strains_and_speeds():
    for error, strain, verdict in ((1e-14, -0.99, PROVED), (2e-13, -1.01, FALSE)):
        some = {"energy_error": [0.0, 0.0, error], "least_strain": [-0.5, -0.5, strain]}
        clusters = data("orbit", **some)
        assert word(model.energy_surface(formulas(), clusters)) == verdict
        assert word(model.least_strain(formulas(), clusters)) == verdict
        assert word(model.energy_surface(formulas(0), clusters)) == FALSE
        assert word(model.least_strain(formulas(0), clusters)) == FALSE
    portraits = [data("impact", xdot=[0.3, 0.2], udot=[-0.1, low]) for low in (0.0, -0.21)]
    assert word(model.contact_speeds(portraits[0], portraits[0])) == HOLDS
    assert word(model.contact_speeds(*portraits)) == FALSE


@pytest.mark.parametrize(
    ("starts", "points", "verdict"),
    [(8, 45_000, HOLDS), (7, 45_000, FALSE), (8, 42_700, FALSE), (8, 47_300, FALSE)],
)
def test_a_portrait_has_the_printed_starts_and_points(starts, points, verdict):
    sizes = [points - 1000 * (starts - 1)] + [1000] * (starts - 1)
    assert word(model.figure_2(data("orbit", row_size=sizes))) == verdict


def test_regular_orbits_prevail_at_the_lower_energy_if_the_interval_is_above_a_half():
    portrait = data("orbit", row_size=[30_000] + [1000] * 5, energy=0.001, g=0.04)
    for share, verdict in ((0.53, HOLDS), (0.51, FALSE)):
        assert word(model.figure_8(portrait, line([[share, 0.9, 0.1]]), NONE)) == verdict
    few = portrait.isel(orbit=slice(5))
    assert word(model.figure_8(few, line([[0.9, 0.9, 0.9]]), NONE)) == FALSE


def test_a_formula_is_proved_as_printed_or_where_nothing_is_printed():
    for printed, corrected, verdict in (
        (1, 0, PROVED), (-1, 1, PROVED), (0, 1, CORRECTED), (-1, 0, FALSE), (0, 0, FALSE)
    ):  # fmt: skip
        algebra = formulas(printed, corrected)
        assert word(lookup.derived(algebra, "area", "smooth")) == verdict
    algebra["printed"].values[:], algebra["printed"].values[2] = 1, 0
    assert word(lookup.derived(algebra, "area", "determinants")) == FALSE
    assert word(lookup.derived(algebra, "area", "smooth")) == PROVED


# -- periodic orbits, branches and islands ---------------------------------------------------------


def test_motions_are_those_that_are_printed():
    def verdict(kinds=("elliptic", "elliptic"), ends=(16, 60)):
        orbits = [data("orbit", type=[kind], total_time=[1.0]) for kind in kinds]
        lines = [data("time", t=[0.0, end]) for end in ends]
        return word(periodic.motions(*orbits, *lines))

    assert verdict() == HOLDS
    assert verdict(kinds=("elliptic", "hyperbolic")) == verdict(kinds=("hyperbolic", "elliptic"))
    assert verdict(kinds=("elliptic", "hyperbolic")) == FALSE
    assert verdict(ends=(16, 59)) == verdict(ends=(15, 60)) == FALSE


def test_each_crossing_and_each_lobe_is_looked_at():
    def flux(**change):
        right = {
            "sine": [[1e-3, -1e-3], [0.1, -0.2]], "saddle": [0, 1], "target": [2, 3],
            "area": [1e-7, 2e-4], "sea_inside": [0.0, 0.3], "sea_out": [0.0, 0.01],
            "sea_out_error": [0.0, 1e-4],
            "area_error": [0.0, 0.0],
        }  # fmt: skip
        found = data("side crossing", **right | change, sea_impacts=1000)
        return found.assign(digits=("side", ["1e-7", "2e-4"]))

    assert word(periodic.heteroclinic(flux())) == HOLDS
    for sine in ([[1e-3, -1e-9], [0.1, -0.2]], [[1e-3, -1e-3], [1e-9, -0.2]]):
        assert word(periodic.transversal(flux(sine=sine), {"a": True})) == FALSE
        assert word(periodic.source_of_chaos(flux(sine=sine), {})) == FALSE
    assert word(periodic.transversal(flux(), {"a": True, "b": False})) == HOLDS
    assert word(periodic.transversal(flux(), {"a": True, "b": True})) == PROVED
    assert word(periodic.lobe_areas(flux())) == HOLDS
    assert word(periodic.lobe_areas(flux(area=[3e-7, 2e-4]))) == FALSE
    for target in ([0, 3], [2, 1]):
        assert word(periodic.heteroclinic(flux(target=target))) == FALSE
    found = periodic.source_of_chaos(flux(), {"a": True})
    assert word(found) == HOLDS
    assert found.numbers["passages"] == pytest.approx(1000 * 0.01 * 1e-7 / 2e-4)
    assert word(periodic.source_of_chaos(flux(sea_inside=[1e-9, 0.3]), {})) == FALSE
    assert word(periodic.source_of_chaos(flux(sea_out=[0.1, 0.0]), {})) == FALSE


def test_a_point_lies_in_the_window_in_both_coordinates():
    inside = {"point_x": 0.2108, "point_xdot": 0.0928}
    assert word(periodic.point_in_window(data(**inside), {"six-hyperbolic": False})) == HOLDS
    assert word(periodic.point_in_window(data(**inside), {"six-hyperbolic": True})) == PROVED
    for name, value in (("x", 0.2117), ("x", 0.2099), ("xdot", 0.0933), ("xdot", 0.0924)):
        outside = data(**inside | {f"point_{name}": value})
        assert word(periodic.point_in_window(outside, {"six-hyperbolic": True})) == FALSE


def test_a_curve_is_gone_or_broken_by_its_last_residue():
    share = data("count", share=[0.1, 0.2], share_error=[0.0, 0.01], impacts=[1, 2])

    def found(*residues):
        size = len(residues)
        rows = {"residue": np.array(residues), "period": np.tile([5, 8, 13], (size, 1))}
        table = data("orbit convergent", **rows)
        table["rotation"] = "orbit", np.linspace(0.1, 0.2, size)
        return periodic.last_curve(table, share, NONE)

    gone, broken = [0.2, -0.5, 0.04], [0.3, 0.9, -1.1]
    assert word(found(gone, broken)) == HOLDS
    assert found(gone, gone, broken, broken).numbers["outside"] == pytest.approx(0.2)
    assert found(gone, gone, broken, broken).numbers["inside"] == pytest.approx(0.1)
    for rows in ((gone, gone), (broken, broken), ([0.2, 0.5, 0.06], broken)):
        assert word(found(*rows)) == UNDECIDED
    for other in ([0.3, 0.5, 0.9], [0.3, 1.3, 1.2]):  # too small; not the largest
        assert word(found(gone, other)) == UNDECIDED


def test_the_trace_by_differences_is_wrong_if_it_is_at_one_orbit():
    ball = Ball(0.2, 0.04)
    orbits = symmetric_orbits(ball, 0.01, 6).assign_attrs(k=0.2, g=0.04)
    assert word(periodic.finite_differences(orbits)) == HOLDS
    for row in range(orbits.sizes["orbit"]):
        wrong = orbits.copy(deep=True)
        wrong["trace"].values[row] += 0.01 * max(1.0, abs(wrong["trace"].values[row]))
        assert word(periodic.finite_differences(wrong)) == FALSE


def turns(*rows, chaotic=()):
    exponent = np.zeros((len(rows), len(rows[0])))
    exponent[:, [*chaotic]] = 1.0
    table = {"rotation": np.array(rows), "exponent": exponent}
    found = data("energy start", **table, impacts=1000)
    return found.assign_coords(energy=0.01 * np.arange(1, 1 + len(rows)))


def test_a_rotation_number_turns_back_by_more_than_a_tenth_of_its_steps():
    falling = np.linspace(0.2, 0.1, 21)
    once, thrice = falling.copy(), falling.copy()
    once[5], thrice[[5, 9, 13]] = once[4] + 1e-3, thrice[[4, 8, 12]] + 1e-3
    rounding = falling.copy()
    rounding[1::2] = rounding[::2][:10] + 1e-9
    for row, turned in ((falling, False), (once, False), (thrice, True), (rounding, False)):
        for sign in (1.0, -1.0):
            found = periodic.no_twist_map(turns(falling, sign * row), ALL)
            assert word(found) == (HOLDS if turned else UNDECIDED)
            assert [*found.numbers["energies"]] == [0.02] * turned
            assert found.numbers["monotone"] is True
    # beyond two chaotic neighbours another island begins
    other = turns(falling, np.append(falling[:14], -falling[14:]), chaotic=(12, 13))
    assert word(periodic.no_twist_map(other, ALL)) == UNDECIDED
    for row, verdict in ((falling, HOLDS), (-falling, HOLDS), (once, UNDECIDED)):
        found = periodic.like_twist_maps(turns(row, thrice), ALL)
        assert word(found) == verdict and found.numbers["steps"] == 20
    assert word(periodic.like_twist_maps(turns(0.0 * falling, falling), ALL)) == UNDECIDED


def test_points_alternate_around_their_middle():
    angle = np.arange(12) * np.pi / 6 + 0.1
    points = {"x": np.cos(angle), "xdot": 0.3 * np.sin(angle), "udot": 0.0 * angle}

    def verdict(order):
        rows = {name: np.stack([v[order], v[np.setdiff1d(np.arange(12), order)]])
                for name, v in points.items()}  # fmt: skip
        orbits = data("orbit point", **rows, k=0.2).assign(
            type=("orbit", ["elliptic", "hyperbolic"])
        )
        return word(periodic.alternating_points(orbits, {"twist-six": True}))

    assert verdict(np.arange(0, 12, 2)) == HOLDS
    assert verdict(np.array([0, 1, 4, 6, 8, 10])) == FALSE


# -- strains in flight -----------------------------------------------------------------------------


@pytest.mark.parametrize("tau", [0.5, 2.0, 3.5, 7.0, 12.0, 30.0])
def test_extrema_of_the_strain_are_those_of_a_fine_grid(tau):
    t = np.linspace(0.0, tau, 400_001)
    for angle in np.linspace(0.05, 6.2, 9):
        x, c = 0.3 * math.cos(angle), 0.3 * math.sin(angle)
        strain = c * np.sin(t) - x * np.cos(t)
        assert flight_strains(x, c, tau) == pytest.approx((strain.min(), strain.max()), abs=1e-9)
