"""Axes that a scene does not give are round and have ticks; axes that show nothing are refused."""

from contextlib import nullcontext

import numpy as np
import pytest

from helpers.samples import DATA, KINDS, SCENES, module
from pseudorigid.dynamics.variables import states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.limits import around, decades, linear, of_data, refuse_empty, ticks


@pytest.mark.parametrize("low", [-0.37, 0.0, 1e-9, 12345.6])
@pytest.mark.parametrize("span", [1e-12, 3e-4, 0.99, 1.0, 7e5])
@pytest.mark.parametrize("margin", [0.0, 0.08])
def test_axes_hold_the_data_and_have_ticks(low, span, margin):
    axis = of_data(np.array([low, low + span, np.nan]), margin=margin)
    start, end = axis["limits"]
    assert start <= low and low + span <= end
    if span > 1e-9 * abs(low):
        assert end - start <= 1.6 * span
    assert 2 <= len(axis["ticks"]) <= 8 and all(start <= tick <= end for tick in axis["ticks"])
    assert axis["ticks"] == sorted(set(axis["ticks"]))


def test_limits_and_ticks_are_round_numbers():
    axis = of_data(np.array([-0.174, 0.573]), most=6)
    assert axis == {"limits": [-0.2, 0.6], "ticks": [-0.2, 0.0, 0.2, 0.4, 0.6]}
    assert of_data([0, 200000], room=0.0)["limits"] == [0, 200000]


@pytest.mark.parametrize("low, high", [(0.0799, 0.0809), (-1.01, 1.9), (3e-7, 4.1e-7), (1.0, 3.4)])
@pytest.mark.parametrize("count", [2.5, 4, 6])
def test_an_axis_has_at_least_two_round_ticks(low, high, count):
    assert len(ticks(low, high, count)) >= 2


@pytest.mark.parametrize(("above", "high"), [(None, 1.25), (0.5, 1.5), (0.0, 1.0)])
def test_room_above_data_is_chosen_apart(above, high):
    axis = around(np.array([0.0, np.nan, 1.0]), 0.25, 4, above=above)
    assert axis.limits == pytest.approx((-0.25, high))


@pytest.mark.parametrize("low", np.linspace(-3, 0, 13))
@pytest.mark.parametrize("span", [0.36, 0.69, 0.71, 1.0, 1.9])
def test_a_logarithmic_axis_has_at_least_two_ticks_with_their_values(low, span):
    axis = decades((low, low + span))
    labels = axis.texts()
    assert len(axis.ticks) >= 2 and all(low <= tick <= low + span for tick in axis.ticks)
    if axis.labels:
        assert [10.0**tick for tick in axis.ticks] == pytest.approx([*map(float, labels)])
    assert decades((-2.2, 0.3)).texts() == ["$10^{-2}$", "$10^{-1}$", "$10^{0}$"]


WRONG = [
    [1e300, 1.1e300], [-1e300, 1e300], [0, 1e300], [1e7, 2e7], [-5e-324, 5e-324],
]  # fmt: skip
AXES = [(kind, name) for kind in KINDS for name in SCENES[kind]["axes"]]
AXES += [("exponents", "largest")]  # of the upper panel


def draw_with(kind, name, limits):
    axes = SCENES[kind]["axes"] | {name: {"limits": limits, "ticks": limits}}
    return module(kind).draw(SCENES[kind] | {"axes": axes}, *DATA[kind]())


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("limits", WRONG, ids=str)
@pytest.mark.parametrize("kind, name", AXES)
def test_axes_that_show_nothing_are_refused_by_name_and_limits(kind, name, limits):
    with pytest.raises(ValueError) as refused:
        draw_with(kind, name, limits)
    message = str(refused.value)
    assert f"axes.{name}.limits [{limits[0]}, {limits[1]}]" in message and "\n" not in message


LINE = {"t": np.array([0.0, 1.0, 2.0]), "y": np.array([0.0, 1.0, 0.0])}


@pytest.mark.parametrize(("t", "y", "joined", "message"), [
    ([0.4, 0.6], [0.3, 0.7], True, None),  # between the samples
    ([0.4, 0.6], [0.3, 0.7], False, "nothing lies within"),
    ([0.9, 1.1], [-0.1, 0.5], False, "nothing lies within"),
    ([0.0, 0.2], [-0.9, -0.1], True, r"^axes\.y\.limits .*lie from 0 to 1$"),
    ([0, 2], [-1e4, 1e4], True, None),  # flat
    ([0, 2], [-1e4, 1e4], False, "too wide"),
])  # fmt: skip
def test_a_line_between_samples_and_flat_data_are_drawn(t, y, joined, message):
    axes = {"t": {"limits": t}, "y": {"limits": y}}
    with pytest.raises(ValueError, match=message) if message else nullcontext():
        refuse_empty(axes, LINE, joined)
    with pytest.raises(ValueError, match=r"axes\.t: .*nothing to be drawn"):
        refuse_empty(axes, {"t": np.array([])}, joined)


def test_a_view_from_which_the_surface_hides_all_is_refused():
    data = DATA["portrait"]()[0]
    scene = SCENES["portrait"]
    seen = Box(scene).seen(states_of(data))
    assert 0 < seen.sum() < seen.size
    one = data.isel(orbit=[0]).assign(row_size=("orbit", [1]))
    assert module("portrait").draw(scene, one.isel(point=[int(np.argmax(seen))]))
    with pytest.raises(ValueError, match=r"^view .*'azimuth': 115.* hides all"):
        module("portrait").draw(scene, one.isel(point=[int(np.argmin(seen))]))


def test_a_window_that_no_branch_passes_is_refused():
    (data,) = DATA["closeup"]()
    none = data.isel(vertex=[]).assign_attrs(window_x=[3.0, 3.1], window_xdot=[0.0, 0.1])
    with pytest.raises(ValueError, match=r"^window: no branch .* x \[3.0, 3.1\]"):
        module("closeup").draw(SCENES["closeup"], none)


@pytest.mark.parametrize("low", [-13.2, 0.0])
@pytest.mark.parametrize("span", [3.0, 9.5, 17.0, 40.0])
def test_a_long_logarithmic_axis_has_few_ticks_at_even_distances(low, span):
    steps = np.diff([*decades((low, low + span)).ticks])
    assert 1 <= steps.size <= 9 and np.all(steps == steps[0]) and steps[0] % 1 == 0


def test_long_labels_are_shortened_by_what_the_name_says():
    axis = linear(12_345_600.0, 12_345_900.0, 3, "impacts")
    base, power = axis.name.partition("less ")[2].split(r") $/\;10^{")
    unit = 10.0 ** int(power.rstrip("}$"))
    values = [float(base) + float(label) * unit for label in axis.texts()]
    assert values == pytest.approx([*axis.ticks], abs=1e-3)
    small = linear(0.0, 3e-7, 3, "error")
    assert small.name == r"error $/\;10^{-7}$" and small.texts() == ["0", "2"]
    assert linear(0.0, 3.0, 3, "n").name == "n"


def test_an_axis_around_one_value_has_it_in_its_middle():
    low, high = around(np.array([5.0, 5.0, np.nan]), 0.5, 4).limits
    assert (low, high) == pytest.approx((4.98, 5.02))
