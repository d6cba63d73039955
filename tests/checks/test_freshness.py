"""A result whose record does not fit this tree is reported with the reason."""

import json
from contextlib import suppress
from importlib import metadata

import pytest

from pipeline.checks.freshness import Freshness
from pipeline.records.build_spec import BuildSpec
from pipeline.records.record import record_path, recorded
from pipeline.records.sources import syntax_hash

ORBITS, DRAWING = "results/paper/orbits_fig2.nc", "results/paper/figures/fig2.png"


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Return a folder with recorded orbits and a drawing of them, and their specifications."""
    monkeypatch.chdir(tmp_path)
    config, view = {"ball": {"g": 0.04}, "energy": 0.01}, {"view": {"elevation": 40}}
    specs = {
        ORBITS: BuildSpec(ORBITS, "fig2", "orbits", config, "stage", None, ["a.py", "b.py"], []),
        DRAWING: BuildSpec(
            DRAWING, "fig2", "drawing png", config | view, "draw", None, ["b.py"], [ORBITS]
        ),
    }
    for source in ("a.py", "b.py"):
        (tmp_path / source).write_text(source)
    for path, spec in specs.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        with recorded(spec):
            (tmp_path / path).write_text(path)
    return tmp_path, specs


def planned(made):
    """Return the line of a plan after `fig2: `."""
    (line,) = Freshness(*made).plan([ORBITS, DRAWING])
    return line.removeprefix("fig2: ")


def test_a_plan_names_what_changed_by_scene(made):
    root, specs = made
    assert planned(made) == "nothing to make"
    assert Freshness(*made).state(DRAWING) == "current"

    def with_config(*paths, **fields):
        new = {path: specs[path]._replace(config=specs[path].config | fields) for path in paths}
        return root, specs | new

    changed = with_config(DRAWING, view={"elevation": 30})
    assert planned(changed) == "view.elevation 40 -> 30: drawing"
    assert planned(with_config(*specs, energy=0.008)) == "energy 0.01 -> 0.008: orbits, drawing"
    orbits = with_config(ORBITS, energy=0.008)
    assert planned(orbits) == "energy 0.01 -> 0.008: orbits; perhaps drawing"
    assert Freshness(*orbits).state(DRAWING) == "stale: energy 0.01 -> 0.008"
    (root / "b.py").write_text("other")
    other = "made by other code than this tree's"
    assert planned(made) == f"{other}: b.py differs: orbits, drawing"
    (root / "a.py").write_text("other")
    both = f"{other}: a.py differs (and 1 more); {other}: b.py differs"
    assert planned(made) == f"{both}: orbits, drawing"


def test_a_plan_names_records_that_do_not_fit_and_results_that_changed(made):
    root, _ = made
    drawn, computed = (root / record_path(path) for path in (DRAWING, ORBITS))
    record, text = json.loads(drawn.read_text()), computed.read_text()
    here = record["environment"]["numpy"]
    drawn.write_text(json.dumps(record | {"inputs": {ORBITS: "0" * 64}}))
    assert planned(made) == f"made from another {ORBITS}: drawing"
    drawn.write_text(json.dumps(record | {"environment": record["environment"] | {"numpy": "1.0"}}))
    assert planned(made) == f"made with numpy 1.0 then, {here} here: drawing"
    (root / DRAWING).unlink()
    assert planned(made) == "not made yet: drawing"
    (root / ORBITS).write_text("other")
    assert planned(made) == "changed after it was made: orbits, drawing"
    for content in ("", "{", "[]", "{}", text.replace('"sources"', '"sauces"')):
        computed.write_text(content)
        broken = f"its record {record_path(ORBITS)} cannot be read"
        assert planned(made) == f"{broken}: orbits, drawing"
    computed.unlink()
    assert planned(made) == "no record of what made it: orbits, drawing"
    (root / ORBITS).unlink()
    assert planned(made) == "not made yet: orbits, drawing"
    assert Freshness(*made).state(ORBITS) == "missing"


def test_a_result_whose_job_was_killed_before_its_record_has_to_be_made_again(made):
    root, specs = made
    for path in specs:
        (root / record_path(path)).unlink()
    with suppress(KeyboardInterrupt), recorded(specs[ORBITS]):
        (root / ORBITS).write_text("made anew")
        raise KeyboardInterrupt
    assert planned(made) == "no record of what made it: orbits, drawing"


# What computes and what draws: not sympy (its results are compared), nor what runs the jobs.
COMPUTING = "llvmlite", "netCDF4", "numba", "numpy", "python-flint", "scipy", "xarray"
DRAWING_PACKAGES = "deflate", "fonttools", "matplotlib", "pyparsing"


@pytest.mark.parametrize("package", COMPUTING + DRAWING_PACKAGES)
def test_an_upgrade_of_a_package_that_decides_bits_outdates_all(made, monkeypatch, package):
    installed = metadata.version
    monkeypatch.setattr(metadata, "version", lambda n: "99" if n == package else installed(n))
    assert (
        planned(made) == f"made with {package} {installed(package)} then, 99 here: orbits, drawing"
    )


def test_an_edit_of_the_further_sources_of_a_result_outdates_it(made):
    """A result that was made another way, as on a card, names what this way needs beside."""
    root, specs = made
    (root / "card.py").write_text("card")
    with recorded(specs[ORBITS]) as output:
        (root / ORBITS).write_text(ORBITS)
        output["way"] = {"card.py": syntax_hash("card.py")}
    assert planned(made) == "nothing to make"
    (root / "card.py").write_text("edited")
    assert planned(made).startswith("made by other code than this tree's: card.py differs: orbits")


def test_what_is_made_from_something_outdated_is_outdated_over_any_number_of_steps(made):
    root, specs = made
    last = "results/paper/figures/fig2.svg"
    specs[last] = specs[DRAWING]._replace(result=last, inputs=[DRAWING])
    with recorded(specs[last]):
        (root / last).write_text(last)
    assert Freshness(*made).outdated([last]) == {}
    (root / "a.py").write_text("edited")
    found = Freshness(*made).outdated([last])
    assert found[last] == f"made from {DRAWING}, which is not current"
