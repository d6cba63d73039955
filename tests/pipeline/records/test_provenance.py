"""Which results are current, and how times tell Snakemake so."""

import json
import os
import shutil
from contextlib import suppress
from importlib import metadata

import pytest

from helpers.verdicts import commit
from pipeline.records import provenance
from pipeline.records.files import FileError
from pipeline.records.provenance import (
    BuildSpec,
    Freshness,
    record_path,
    recorded,
    spec_path,
)
from pipeline.records.sources import syntax_hash

ORBITS, DRAWING = "results/paper/orbits_fig2.nc", "results/paper/figures/fig2.png"


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Return a folder with recorded orbits and a drawing of them, and their specifications."""
    monkeypatch.chdir(tmp_path)
    config, view = {"ball": {"g": 0.04}, "energy": 0.01}, {"view": {"elevation": 40}}
    for source, module in (("a.py", "numba"), ("b.py", "matplotlib.pyplot")):
        (tmp_path / source).write_text(f"def f():\n    import {module}\n")
    orbits = BuildSpec(ORBITS, "fig2", "orbits", config, "stage", "a.f", ["a.py", "b.py"], [])
    drawing = "fig2", "drawing png", config | view, "draw", "b.draw", ["b.py"], [ORBITS]
    specs = {ORBITS: orbits, DRAWING: BuildSpec(DRAWING, *drawing)}
    make(tmp_path, specs, *specs)
    return tmp_path, specs


def make(root, specs, *paths):
    """Write results, in which their paths stand, and their records."""
    for path in paths:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        with recorded(Freshness(root, specs).build_specs[path]):
            (root / path).write_text(path)


def planned(made):
    """Return the line about fig2, after its name."""
    (line,) = Freshness(*made).to_make([ORBITS, DRAWING])
    return line.removeprefix("fig2: ")


def test_a_plan_names_what_changed_by_scene(made):
    root, specs = made
    assert planned(made) == "nothing to make" and Freshness(*made).state(DRAWING) == "current"

    def with_config(*paths, **fields):
        new = {path: specs[path]._replace(config=specs[path].config | fields) for path in paths}
        return root, specs | new

    changed = with_config(DRAWING, view={"elevation": 30})
    assert planned(changed) == "view.elevation 40 -> 30: drawing"
    assert planned(with_config(*specs, energy=0.008)) == "energy 0.01 -> 0.008: orbits, drawing"
    orbits = with_config(ORBITS, energy=0.008)
    assert planned(orbits) == "energy 0.01 -> 0.008: orbits, drawing"
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
    here = record["environment"]["matplotlib"]
    drawn.write_text(json.dumps(record | {"inputs": {ORBITS: "0" * 64}}))
    assert planned(made) == f"made from another {ORBITS}: drawing"
    drawn.write_text(
        json.dumps(record | {"environment": record["environment"] | {"matplotlib": "1.0"}})
    )
    assert planned(made) == f"made with matplotlib 1.0 then, {here} here: drawing"
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
    with suppress(KeyboardInterrupt), recorded(Freshness(*made).build_specs[ORBITS]):
        (root / ORBITS).write_text("made anew")
        raise KeyboardInterrupt
    assert planned(made) == "no record of what made it: orbits, drawing"


def test_a_package_that_is_installed_on_demand_has_the_version_that_would_be(monkeypatch):
    """So that a new .venv outdates no result of proofs."""
    here = provenance._installed("python-flint")

    def lacking(name):
        raise metadata.PackageNotFoundError

    monkeypatch.setattr(metadata, "version", lacking)
    assert provenance._installed("python-flint") == here and here
    assert provenance._installed("numpy") is None


@pytest.mark.parametrize(("package", "outdated"), [
    ("numba", "orbits"), ("llvmlite", "orbits"),
    *((package, "orbits, drawing") for package in ("matplotlib", "fonttools", "pyparsing")),
    ("scipy", ""), ("python-flint", ""), ("numpy", ""), ("pillow", ""),
])  # fmt: skip
def test_an_upgrade_of_a_package_outdates_what_imports_it(made, monkeypatch, package, outdated):
    """The orbits' sources import numba and matplotlib, the drawing's matplotlib alone."""
    installed = metadata.version
    monkeypatch.setattr(metadata, "version", lambda n: "99" if n == package else installed(n))
    if outdated == "orbits":
        assert [*Freshness(*made).outdated([ORBITS])] == [ORBITS]
    words = f"made with {package} {installed(package)} then, 99 here: orbits, drawing"
    assert planned(made) == (words if outdated else "nothing to make")


def test_an_upgrade_of_what_encodes_a_gif_outdates_it_alone(made, monkeypatch):
    root, specs = made
    moving = "results/paper/figures/fig2.gif"
    specs[moving] = specs[DRAWING]._replace(result=moving)
    make(root, specs, moving)
    installed = metadata.version
    monkeypatch.setattr(metadata, "version", lambda n: "99" if n == "pillow" else installed(n))
    assert [*Freshness(*made).outdated()] == [moving]


def test_an_edit_of_the_further_sources_of_a_result_outdates_it(made):
    """A result that was made another way, as on a card, names what this way needs beside."""
    root, _ = made
    (root / "card.py").write_text("card")
    with recorded(Freshness(*made).build_specs[ORBITS]) as output:
        (root / ORBITS).write_text(ORBITS)
        output["way"] = {"card.py": syntax_hash("card.py")}
    assert planned(made) == "nothing to make"
    (root / "card.py").write_text("edited")
    assert planned(made).startswith("made by other code than this tree's: card.py differs: orbits")


def test_what_is_made_from_something_outdated_is_outdated_over_any_number_of_steps(made):
    root, specs = made
    last = "results/paper/figures/fig2.svg"
    specs[last] = specs[DRAWING]._replace(result=last, inputs=[DRAWING])
    make(root, specs, last)
    assert Freshness(*made).outdated([last]) == {}
    (root / "a.py").write_text("edited")
    found = Freshness(*made).outdated([last])
    assert found[last] == f"made from {DRAWING}, which is not current"


def test_another_function_outdates_a_result(made):
    root, specs = made
    other = specs | {ORBITS: specs[ORBITS]._replace(function="a.g")}
    words = "made by other code than this tree's: function a.f -> a.g: orbits, drawing"
    assert planned((root, other)) == words


def test_a_job_refuses_sources_and_packages_that_its_specification_does_not_have(made):
    root, specs = made
    spec = Freshness(root, specs).build_specs[ORBITS]
    (root / "b.py").write_text("edited")
    with pytest.raises(FileError, match=r"^b\.py changed during the run"), recorded(spec):
        raise AssertionError
    other = spec._replace(sources={}, environment={"numpy": "1.0"})
    with pytest.raises(FileError, match=r"^numpy is .* here, not 1\.0"), recorded(other):
        raise AssertionError
    assert planned(made).startswith("made by other code than this tree's: b.py")


def test_a_refusal_lasts_until_what_led_to_it_changes(made):
    root, specs = made
    with suppress(ValueError), recorded(Freshness(root, specs).build_specs[ORBITS]):
        raise ValueError("no such orbit")
    found = Freshness(root, specs)
    assert {*found.outdated().values()} == {"cannot exist: no such orbit"}
    assert found.state(DRAWING) == "cannot exist: no such orbit"
    (root / "a.py").write_text("edited")
    assert Freshness(root, specs).refusal(DRAWING) is None


def run_again(made):
    """Return the results that Snakemake makes, which looks at times alone."""
    root, specs = made
    Freshness(root, specs).set_times()
    again = []
    for path, spec in specs.items():
        outputs = [root / path, root / record_path(path)]
        inputs = [root / file for file in (spec_path(path), *spec.inputs)]
        there = [file.stat().st_mtime_ns for file in outputs if file.exists()]
        newest = max(file.stat().st_mtime_ns for file in inputs if file.exists())
        missing = not outputs[0].exists() or {*spec.inputs} & {*again}
        if missing or newest > min(there):
            again.append(path)
    return again


def test_times_say_what_is_outdated_whatever_they_were(made):
    root, specs = made
    files = [root / place(p) for p in specs for place in (spec_path, record_path, str)]
    assert run_again(made) == []
    for times in ((4e9, 4e9, 0), (0, 4e9, 4e9), (4e9, 0, 4e9), (0, 0, 0), (5e9, 4e9, 3e9)):
        for i, file in enumerate(files):
            os.utime(file, (times[i % 3], times[i % 3] - i))
        assert run_again(made) == []
    edited = dict(specs)
    edited[DRAWING] = specs[DRAWING]._replace(config={"energy": 0.02})
    for when in (0, 4e9):
        for file in files:
            os.utime(file, (when, when))
        assert run_again((root, edited)) == [DRAWING]
    os.utime(root / DRAWING)  # as `snakemake --touch` does
    assert run_again((root, edited)) == [DRAWING]
    assert run_again(made) == []  # the edit is undone
    make(root, edited, DRAWING)
    assert run_again((root, edited)) == [] and run_again(made) == [DRAWING]
    make(root, specs, DRAWING)
    (root / spec_path(DRAWING)).write_bytes(b"\xff")  # no text
    assert run_again(made) == []


def test_times_of_files_of_another_owner_are_set_by_copies(made, monkeypatch):
    """In a folder that one may write, after a run of root or of a member of the same group."""
    root, specs = made
    assert run_again(made) == []
    contents = {root / p: p for p in specs}
    foreign, utime = {*contents, *(root / spec_path(p) for p in specs)}, os.utime

    def of_owner(path, *times):
        if path in foreign:
            foreign.remove(path)
            raise PermissionError(1, "Operation not permitted")
        utime(path, *times)

    for file in [*foreign]:
        utime(file, (4e9, 4e9))
    monkeypatch.setattr(os, "utime", of_owner)
    assert run_again(made) == [] and not foreign
    assert {file: file.read_text() for file in contents} == contents


def test_damage_of_a_result_or_a_record_is_outdated_and_a_copy_is_not(made):
    root, specs = made
    kept = {file: file.read_bytes() for p in specs for file in (root / p, root / record_path(p))}
    for i, file in enumerate(kept):
        for damage in (kept[file][:-3], b"x" + kept[file][1:], None):
            file.unlink()
            if damage is not None:
                file.write_bytes(damage)
            again = run_again(made)
            assert again == [*specs][i // 2 :], file
            file.write_bytes(kept[file])
            shutil.rmtree(root / "results/paper/specs")  # as in results from a cache
            assert run_again(made) == []


def test_the_commit_is_that_of_the_repository_that_has_the_workflow(tmp_path, monkeypatch):
    """A folder inside another repository has none; figures and untracked files are no edits."""
    files = [tmp_path / name for name in ("Snakefile", "paper_figures/fig2.png", "module.py")]
    for file in files:
        file.parent.mkdir(exist_ok=True)
        file.touch()
    commit(tmp_path, *files)
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner/Snakefile").touch()
    monkeypatch.chdir(tmp_path / "inner")
    found = provenance.commit.__wrapped__
    assert found() == (None, None)
    monkeypatch.chdir(tmp_path)
    files[1].write_text("another picture")
    head = provenance.git("rev-parse", "HEAD").decode().strip()
    assert found() == (head, False)
    files[2].write_text("an edit")
    assert found() == (head, True)
