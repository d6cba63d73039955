"""An orbit stops where the pipeline refuses it, with the pipeline's words and without a verdict."""

import numpy as np
import pytest

from helpers.project import wait_for
from pseudorigid import Ball, orbit
from pseudorigid.kernel import formulas

pytestmark = pytest.mark.slow  # it sees no figure
# k, g, E, start and what becomes of 40 impacts: some flights are too long at once, some later.
CASES = [
    (0.2, 1e-8, 0.01, 0.5),
    (0.2, 1e-8, 0.01, -0.999),
    (0.05, 1e-7, 0.02, 0.3),
    (1.0, 1e-6, 0.3, -0.7),
    (1 / 3, 3e-6, 1e-5, 0.6),
    (0.2, 5e-7, 0.04, 0.3),
    (0.2, 5e-7, 0.04, 0.8),
    (0.2, 0.04, 0.01, 0.5),
]


def refusal(ball, start, impacts):
    """The number of impacts that Python computes, and its words about the next one."""
    done = orbit(ball, [[value] for value in start], impacts)
    count = int(np.isfinite(done["tau"].values[:, 0]).sum())
    if count == impacts:
        return count, ""
    with pytest.raises(ValueError) as refused:
        orbit(ball, start, impacts)
    return count, str(refused.value)


@pytest.mark.parametrize("back", ["", "<"])
def test_orbits_stop_as_in_python(person, back):
    words = []
    for k, g, energy, start in CASES:
        ball, impacts = Ball(k, g), 40
        state = formulas.start(k, g, energy, start)  # Python and config.yaml refuse some
        count, message = refusal(ball, state, impacts)
        person.open(f"k={k!r}&g={g!r}&E={energy!r}&orbits={start!r}*{impacts}{back}&chosen=0")
        ((title, facts),) = person.run("return titles().map((t, i) => [t, facts()[i]])")
        assert facts.startswith(f"{count} impacts · ")
        assert title.count(f" stops: {message}") == bool(message)
        assert ("chaotic" in title or "regular" in title) == (not message)
        assert message in person.text("hint")
        assert "NaN" not in person.run("return document.body.innerText")
        if count:
            assert len(person.table()[1]) == count + 1
        words.append(message)
    assert len(set(words)) == 2 and words[-1] == ""


def test_branches_and_jumps_say_so_too(person):
    sentence = person.run("return pseudorigid.TOO_LONG")
    trace = """const points = [[...pseudorigid.start(0.2, 1e-8, 0.01, 0.1), 1]];
        const spec = { saddle: 0, side: "outer", stable: false, length: 1 };
        const values = { k: 0.2, g: 1e-8, energy: 0.01, points, spec };
        return new Computer().ask("branch", values).then(() => "", error => error.message);"""
    assert person.run(trace) == sentence
    person.open("k=0.2&g=1e-8&E=0.01&jump=1")
    wait_for(lambda: sentence in person.text("jump-note"))
