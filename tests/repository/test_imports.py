"""Imports point downwards, without circles; packages are small, and processes load little."""

import ast
import graphlib
import os
import sys
from functools import cache

import pytest
from project import ROOT, SHIPPED, run

# Each part of a package may import those to its right, and the pipeline all of the science.
LAYERS = {
    "pseudorigid": ("study", "figures", "sweep", "analyses", "proofs", "dynamics", "kernel"),
    "pipeline": ("cli", "jobs", "publication", "checks", "explorer", "config", "records"),
}
LEVEL = {f"{package}.{part}": i for package in LAYERS for i, part in enumerate(LAYERS[package])}
MAX_PARTS = 7


def sources():
    """Path under src -> text of each module."""
    src = ROOT / "src"
    return {
        str(file.relative_to(src)): file.read_text(encoding="utf-8")
        for package in LAYERS
        for file in sorted((src / package).rglob("*.py"))
    }


@cache
def import_nodes(text):
    """The nodes of a module's text that may import something."""
    nodes = ast.walk(ast.parse(text))
    return [node for node in nodes if isinstance(node, (ast.Import, ast.ImportFrom, ast.Call))]


def imports(files):
    """Module -> the modules that it imports anywhere, also by import_module with a literal."""
    names = {file: file[:-3].replace("/", ".").removesuffix(".__init__") for file in files}
    modules, graph = set(names.values()), {}
    for file, name in names.items():
        package = name.split(".") if file.endswith("__init__.py") else name.split(".")[:-1]
        nodes = import_nodes(files[file])
        targets = {target for node in nodes for target in _targets(node, package, modules)}
        graph[name] = targets - {name}
    return graph


def _targets(node, package, modules):
    """The project's modules that a statement imports."""
    match node:
        case ast.Import(names=names):
            targets = [alias.name for alias in names]
        case ast.ImportFrom(module=module, names=names, level=level):
            base = package[: len(package) - level + 1] if level else []
            base = ".".join([*base, *([module] if module else [])])
            targets = [f"{base}.{alias.name}" for alias in names]
            targets = [name if name in modules else base for name in targets]
        case ast.Call(
            func=ast.Name(id="import_module" | "__import__")
            | ast.Attribute(attr="import_module" | "__import__"),
            args=[ast.Constant(value=str(name)), *_],
        ):
            dots = len(name) - len(name.lstrip("."))
            base = package[: len(package) - dots + 1] if dots else []
            targets = [".".join([*base, name[dots:]])]
        case _:
            targets = []
    return [name for name in targets if name in modules]


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


def violations(files):
    """Yield a line for each violation of the rules."""
    graph = imports(files)
    if nodes := circle(graph):
        yield f"a circle: {' > '.join(nodes)}"
    for name, targets in graph.items():
        for target in sorted(targets):
            part, imported = (".".join(path.split(".")[:2]) for path in (name, target))
            if part.startswith("pseudorigid") and imported.startswith("pipeline"):
                yield f"{name} imports {target}: the science must not import the pipeline"
            elif part.split(".")[0] == imported.split(".")[0] and (
                LEVEL.get(imported, 99) < LEVEL.get(part, -1)
            ):
                yield f"{name} imports {target}: upwards"
    for parent in sorted({name.rpartition(".")[0] for name in graph} - {""}):
        siblings = parts(graph, parent)
        if nodes := circle(siblings):
            yield f"a circle in {parent}: {' > '.join(nodes)}"
        counted = set(siblings) - {"__main__"}
        if parent in LAYERS:
            for part in sorted(counted - set(LAYERS[parent])):
                yield f"{parent}.{part}: a part without a layer"
        else:  # modules that no sibling imports do not count
            counted = set().union(*siblings.values())
        if len(counted) > MAX_PARTS:
            yield f"{parent}: {len(counted)} parts: {', '.join(sorted(counted))}"


def test_the_source_follows_the_rules():
    assert list(violations(sources())) == []


def test_known_imports_are_seen():
    graph = imports(sources())
    assert "pseudorigid.kernel.compiled" in graph["pseudorigid.kernel.arithmetic"]
    assert "pseudorigid.figures.canvas.render" in graph["pipeline.jobs.draw"]


NUMBERED = [f"r{i}" for i in range(8)]
IN_A_PROPERTY = """class A:
    @property
    def map(self):
        import pseudorigid.figures.canvas.style"""
FAULTS = {
    "a circle of modules": (
        {"pseudorigid/kernel/impact_law.py": "from . import impact"},
        "a circle: pseudorigid.kernel.",
    ),
    "a circle inside a function": (
        {"pseudorigid/figures/canvas/style.py": "def f():\n    from .sheet import Sheet"},
        "a circle: pseudorigid.figures.canvas.",
    ),
    "a circle of packages, none of modules": (
        {
            "pseudorigid/figures/canvas/one.py": "",
            "pseudorigid/figures/canvas/two.py": "from ..axes import three",
            "pseudorigid/figures/axes/three.py": "from ..canvas import one",
        },
        "a circle in pseudorigid.figures: ",
    ),
    "upwards, in a property": (
        {"pseudorigid/dynamics/up.py": IN_A_PROPERTY},
        "pseudorigid.dynamics.up imports pseudorigid.figures.canvas.style: upwards",
    ),
    "upwards, by a name": (
        {"pseudorigid/proofs/up.py": "importlib.import_module('pseudorigid.sweep.grid')"},
        "pseudorigid.proofs.up imports pseudorigid.sweep.grid: upwards",
    ),
    "upwards, by a relative name": (
        {"pipeline/records/up.py": "import_module('..cli.main', __package__)"},
        "pipeline.records.up imports pipeline.cli.main: upwards",
    ),
    "out of the science": (
        {"pseudorigid/study/out.py": "def f():\n    from pipeline import config"},
        "pseudorigid.study.out imports pipeline.config: the science ",
    ),
    "an eighth part": ({"pseudorigid/eighth.py": ""}, "pseudorigid: 8 parts: "),
    "a part without a layer": (
        {"pipeline/tools/__init__.py": "", "pipeline/tools/one.py": ""},
        "pipeline.tools: a part without a layer",
    ),
    "eight modules that a sibling imports": (
        {
            **{f"pipeline/records/wide/{name}.py": "" for name in ("__init__", *NUMBERED)},
            "pipeline/records/wide/all.py": f"from . import {', '.join(NUMBERED)}",
        },
        "pipeline.records.wide: 8 parts: ",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found(fault):
    planted, line = FAULTS[fault]
    files = sources()
    files |= {name: f"{files.get(name, '')}\n\n{text}\n" for name, text in planted.items()}
    found = list(violations(files))
    assert any(violation.startswith(line) for violation in found), found


def test_many_modules_that_no_sibling_imports_are_no_fault():
    planted = dict.fromkeys((f"pipeline/records/peers/{n}.py" for n in ("__init__", *NUMBERED)), "")
    assert list(violations(sources() | planted)) == []


LIBRARIES = ("numpy", "numba", "xarray", "matplotlib", "netCDF4", "pseudorigid.study")
OURS = ("pseudorigid", "pipeline.", "numba", "matplotlib")
RECORDS = ["pipeline.records", "pipeline.records.artifacts", "pipeline.records.files"]


@pytest.mark.parametrize(
    ("code", "names", "expected"),
    [
        (f"import pipeline.cli.running, pipeline.config as c; c.load({str(SHIPPED)!r})",
         LIBRARIES, []),
        ("import pipeline.records.artifacts", OURS, [*RECORDS, "pseudorigid"]),
    ],
    ids=["start of a run", "artifacts"],
)  # fmt: skip
def test_a_process_loads_no_more_than_it_needs(code, names, expected):
    program = f"import sys\n{code}\nprint(*sorted(n for n in sys.modules if n.startswith({names})))"
    result = run(sys.executable, "-c", program, env=os.environ | {"PYTHONPATH": str(ROOT / "src")})
    assert result.stdout.split() == expected, result.stderr
