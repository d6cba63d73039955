"""Imports point downwards, without circles; packages are small, and processes load little."""

import graphlib
import os
import sys

import grimp
import pytest
from project import ROOT, SHIPPED, run

# Each part of a package may import those to its right, and the pipeline all of the science.
LAYERS = {
    "pseudorigid": ("study", "figures", "sweep", "analyses", "proofs", "dynamics", "kernel"),
    "pipeline": ("cli", "jobs", "publication", "checks", "explorer", "config", "records"),
}
LEVEL = {f"{package}.{part}": i for package in LAYERS for i, part in enumerate(LAYERS[package])}
MAX_PARTS = 7


@pytest.fixture
def graph():
    """Module -> the modules that it imports anywhere."""
    built = grimp.build_graph(*LAYERS, cache_dir=None)
    return {name: set(built.find_modules_directly_imported_by(name)) for name in built.modules}


def circle(graph):
    """The nodes of a circle in a graph, or None."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return None


def parts(graph, parent):
    """The graph of the modules and packages that lie side by side in a package."""
    depth = parent.count(".") + 1
    found = {}
    for name, targets in graph.items():
        if name.startswith(f"{parent}."):
            part, *inside = (
                path.split(".")[depth] for path in (name, *targets) if path.startswith(f"{parent}.")
            )
            found.setdefault(part, set()).update({*inside} - {part})
    return found


def violations(graph):
    """Yield a line for each violation of the rules."""
    if nodes := circle(graph):
        yield f"a circle: {' > '.join(nodes)}"
    for name, targets in graph.items():
        for target in targets:
            part, imported = (".".join(path.split(".")[:2]) for path in (name, target))
            if part.startswith("pseudorigid") and imported.startswith("pipeline"):
                yield f"{name} imports {target}: the science must not import the pipeline"
            elif part.split(".")[0] == imported.split(".")[0] and (
                LEVEL.get(imported, 99) < LEVEL.get(part, -1)
            ):
                yield f"{name} imports {target}: upwards"
    for parent in {name.rpartition(".")[0] for name in graph} - {""}:
        siblings = parts(graph, parent)
        if nodes := circle(siblings):
            yield f"a circle in {parent}: {' > '.join(nodes)}"
        counted = set(siblings) - {"__main__"}
        if parent in LAYERS:
            for part in counted - set(LAYERS[parent]):
                yield f"{parent}.{part}: a part without a layer"
        else:  # modules that no sibling imports do not count
            counted = set().union(*siblings.values())
        if len(counted) > MAX_PARTS:
            yield f"{parent}: {len(counted)} parts: {', '.join(sorted(counted))}"


def test_the_source_follows_the_rules(graph):
    assert list(violations(graph)) == []


@pytest.mark.parametrize(
    ("module", "imported"),
    [
        ("pseudorigid.kernel.arithmetic", "pseudorigid.kernel.compiled"),
        ("pipeline.cli.commands.verify", "pipeline.publication.archive"),  # in a function
    ],
)
def test_known_imports_are_seen(graph, module, imported):
    assert imported in graph[module]


WIDE = {f"pipeline.records.wide.r{i}": set() for i in range(8)}
# Imports that are added, and the beginning of a line on them.
FAULTS = {
    "a circle of modules": (
        {"pseudorigid.kernel.impact_law": {"pseudorigid.kernel.impact"}},
        "a circle: pseudorigid.kernel.",
    ),
    "a circle of packages, none of modules": (
        {
            "pseudorigid.figures.canvas.one": set(),
            "pseudorigid.figures.canvas.two": {"pseudorigid.figures.axes.three"},
            "pseudorigid.figures.axes.three": {"pseudorigid.figures.canvas.one"},
        },
        "a circle in pseudorigid.figures: ",
    ),
    "upwards": (
        {"pseudorigid.dynamics.up": {"pseudorigid.figures.canvas.style"}},
        "pseudorigid.dynamics.up imports pseudorigid.figures.canvas.style: upwards",
    ),
    "out of the science": (
        {"pseudorigid.study.out": {"pipeline.config"}},
        "pseudorigid.study.out imports pipeline.config: the science ",
    ),
    "an eighth part": ({"pseudorigid.eighth": set()}, "pseudorigid: 8 parts: "),
    "a part without a layer": (
        {"pipeline.tools.one": set()},
        "pipeline.tools: a part without a layer",
    ),
    "eight modules that a sibling imports": (
        WIDE | {"pipeline.records.wide.all": set(WIDE)},
        "pipeline.records.wide: 8 parts: ",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found(graph, fault):
    planted, line = FAULTS[fault]
    for module, imported in planted.items():
        graph.setdefault(module, set()).update(imported)
    found = list(violations(graph))
    assert any(violation.startswith(line) for violation in found), found


def test_many_modules_that_no_sibling_imports_are_no_fault(graph):
    assert list(violations(graph | WIDE)) == []


LIBRARIES = ("numpy", "numba", "xarray", "matplotlib", "netCDF4", "pseudorigid.study")
OURS = ("pseudorigid", "pipeline.", "numba", "matplotlib")
RECORDS = ["pipeline.records", "pipeline.records.artifacts", "pipeline.records.files"]


@pytest.mark.parametrize(
    ("code", "names", "expected"),
    [
        (f"import pipeline.cli.running, pipeline.config as c; c.load({str(SHIPPED)!r})",
         LIBRARIES, []),
        ("import pipeline.cli.commands.list", LIBRARIES, []),
        ("import pipeline.records.artifacts", OURS, [*RECORDS, "pseudorigid"]),
    ],
    ids=["start of a run", "list", "artifacts"],
)  # fmt: skip
def test_a_process_loads_no_more_than_it_needs(code, names, expected):
    program = f"import sys\n{code}\nprint(*sorted(n for n in sys.modules if n.startswith({names})))"
    result = run(sys.executable, "-c", program, env=os.environ | {"PYTHONPATH": str(ROOT / "src")})
    assert result.stdout.split() == expected, result.stderr
