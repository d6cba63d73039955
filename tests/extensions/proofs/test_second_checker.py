"""The second checker proves the same statements and refuses altered certificates."""

from fractions import Fraction

import pytest
from mpmath import iv

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import horseshoe, jump, periodic
from helpers.parts import second_checker
from helpers.parts.certificates import altered, with_field
from helpers.parts.second_checker import NotProvedError
from helpers.slowly import slowly

KINDS = {periodic.check: "periodic orbit", jump.check_smooth: "no touch"}
QUICK = [name for name, theorem in THEOREMS.items() if theorem.checker in KINDS]
KINDS[horseshoe.check] = "horseshoe"
HORSESHOES = [name for name, theorem in THEOREMS.items() if theorem.checker is horseshoe.check]


def check(name, text=None, **changed):
    """Prove a theorem by the second checker."""
    theorem = THEOREMS[name]
    bounds = theorem.bounds | changed
    if surface := bounds.pop("surface", None):
        bounds |= {"k": surface.k, "g": surface.g, "energy": surface.energy}
    return second_checker.check(text or theorem.text(), KINDS[theorem.checker], **bounds)


@pytest.mark.parametrize("name", [*QUICK, *slowly(*HORSESHOES)])
def test_it_proves_the_statement_with_the_same_digits(name):
    """Margins are at least the package's: enclosures of coverings are narrower."""
    found, result = check(name), THEOREMS[name].check()
    for digit in {"x", "trace"} & result.digits.keys():
        stated = iv.mpf(result.digits[digit].strip("[").split()[0])
        assert abs(found[digit] - stated) < 1e-25 and found[digit].delta < 1e-28
    for margin in {"beyond", "room"} & result.margins.keys():
        assert found[margin] > result.margins[margin] - 1e-9


@pytest.mark.slow
@pytest.mark.parametrize(("name", "radius"), [
    ("fixed-point", "1e-2"), ("fixed-point-low", "5e-3"), ("six-elliptic", "4e-4"),
    ("six-hyperbolic", "5e-4"), ("six-inverse", "2e-3"), ("ten-elliptic", "1e-5"),
    ("twelve-elliptic", "1e-5"),
])  # fmt: skip
def test_it_proves_the_orbits_in_the_larger_boxes_of_the_page(name, radius):
    larger = with_field(THEOREMS[name].text(), "radius", f'"{radius}"')
    assert check(name, larger, radius=Fraction(radius))


@pytest.mark.slow
@pytest.mark.parametrize("name", [*QUICK, *HORSESHOES])
def test_it_refuses_altered_certificates_and_stronger_statements(name):
    for field, number, text in altered(THEOREMS[name].text()):
        if field != "radius":  # it proves larger boxes too
            with pytest.raises(NotProvedError):
                assert check(name, text), number
    bounds = THEOREMS[name].bounds
    for bound in bounds.keys() & ({"radius"} if "type" in bounds else {"entropy", "energy"}):
        with pytest.raises(NotProvedError):
            check(name, **{bound: 2 * bounds[bound]})
