"""The floors of the house: imports point downwards, wherever they stand, and rooms are few."""

import ast
import shutil
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest
from project import NO_CACHES, ROOT

# Each room may import those to its right, and the pipeline all of the science.
FLOORS = {
    "pseudorigid": ("study", "figures", "sweep", "analyses", "proofs", "dynamics", "kernel"),
    "pipeline": ("cli", "jobs", "checks", "config", "records"),
}
MOST = 7  # rooms


def modules(src):
    """Dotted name -> file of every module of both packages."""
    return {
        ".".join(file.relative_to(src).with_suffix("").parts).removesuffix(".__init__"): file
        for package in FLOORS
        for file in sorted((src / package).rglob("*.py"))
    }


@cache
def statements(text):
    """The nodes of a module's text that may import something."""
    nodes = ast.walk(ast.parse(text))
    return [node for node in nodes if isinstance(node, (ast.Import, ast.ImportFrom, ast.Call))]


def imports(src):
    """Module -> the modules that it imports anywhere, also by import_module with a literal."""
    known = modules(src)
    found = {}
    for name, file in known.items():
        package = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
        targets = set()
        for node in statements(file.read_text(encoding="utf-8")):
            targets.update(_targets(node, package, known))
        found[name] = targets - {name}
    return found


def _targets(node, package, known):
    """The modules of ours that a statement imports."""
    match node:
        case ast.Import(names=names):
            wanted = [alias.name for alias in names]
        case ast.ImportFrom(module=module, names=names, level=level):
            base = ".".join([*package[: len(package) - level + 1], *([module] if module else [])])
            base = base if level else module
            wanted = [f"{base}.{alias.name}" for alias in names]
            wanted = [name if name in known else base for name in wanted]
        case ast.Call(func=ast.Name(id=called) | ast.Attribute(attr=called), args=[first, *_]):
            if called not in ("import_module", "__import__"):
                return []
            if not (isinstance(first, ast.Constant) and isinstance(first.value, str)):
                return []
            dots = len(first.value) - len(first.value.lstrip("."))
            base = package[: len(package) - dots + 1] if dots else []
            wanted = [".".join([*base, first.value[dots:]])]
        case _:
            return []
    return [name for name in wanted if name in known]


def circle(graph):
    """The nodes of a circle in a graph, or None."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return path[path.index(node) :]
        if node in done:
            return None
        path.append(node)
        for other in sorted(graph.get(node, ())):
            if found := visit(other):
                return found
        done.add(path.pop())
        return None

    return next(filter(None, map(visit, sorted(graph))), None)


def rooms(graph, parent):
    """The graph of what lies side by side in a package, folders and modules alike."""
    depth = parent.count(".") + 1
    found = {}
    for name, targets in graph.items():
        if not name.startswith(f"{parent}."):
            continue
        room = name.split(".")[depth]
        inside = {t.split(".")[depth] for t in targets if t.startswith(f"{parent}.")}
        found.setdefault(room, set()).update(inside - {room})
    return found


def faults(src):
    """What is wrong with the house, a line each."""
    graph = imports(src)
    if found := circle(graph):
        yield f"a circle: {' > '.join(found)}"
    floor = {f"{package}.{room}": i for package in FLOORS for i, room in enumerate(FLOORS[package])}
    for name, targets in graph.items():
        for target in sorted(targets):
            here, there = (".".join(path.split(".")[:2]) for path in (name, target))
            if here.startswith("pseudorigid") and there.startswith("pipeline"):
                yield f"{name} imports {target}: the science knows no pipeline"
            elif here.partition(".")[0] == there.partition(".")[0]:
                upwards = floor.get(there, 99) < floor.get(here, -1)
                yield from [f"{name} imports {target}: upwards"] * upwards
    for parent in sorted({name.rpartition(".")[0] for name in graph} - {""}):
        side_by_side = rooms(graph, parent)
        if found := circle(side_by_side):
            yield f"a circle of rooms in {parent}: {' > '.join(found)}"
        counted = set(side_by_side) - {"__main__"}
        if parent in FLOORS:
            for room in sorted(counted - set(FLOORS[parent])):
                yield f"{parent}.{room}: a room without a floor"
        else:  # peers that no other one imports do not count
            counted = set().union(*side_by_side.values())
        if len(counted) > MOST:
            yield f"{parent}: {len(counted)} rooms: {', '.join(sorted(counted))}"


def test_the_house_stands():
    assert list(faults(ROOT / "src")) == []


def test_the_reading_sees_every_file_and_known_imports():
    graph = imports(ROOT / "src")
    assert len(graph) == len(list((ROOT / "src").glob("p*/**/*.py")))
    assert "pseudorigid.kernel.compiled" in graph["pseudorigid.kernel.arithmetic"]
    assert "pseudorigid.figures.canvas.render" in graph["pipeline.records.drawings"]


@pytest.fixture
def copy(tmp_path):
    """A copy of the source, for one fault."""
    return Path(shutil.copytree(ROOT / "src", tmp_path / "src", ignore=NO_CACHES))


PLANTED = {
    "a circle of files": (
        {"pseudorigid/kernel/impact_law.py": "from . import impact"},
        "a circle: pseudorigid.kernel.",
    ),
    "a circle inside a function": (
        {
            "pseudorigid/figures/canvas/style.py": "def f():\n    from .sheet import Sheet",
        },
        "a circle: pseudorigid.figures.canvas.",
    ),
    "a circle of rooms, none of files": (
        {
            "pseudorigid/figures/canvas/one.py": "",
            "pseudorigid/figures/canvas/two.py": "from ..axes import three",
            "pseudorigid/figures/axes/three.py": "from ..canvas import one",
        },
        "a circle of rooms in pseudorigid.figures: axes > canvas",
    ),
    "upwards": (
        {"pseudorigid/kernel/up.py": "from ..dynamics import ball"},
        "pseudorigid.kernel.up imports pseudorigid.dynamics.ball: upwards",
    ),
    "upwards, in a property": (
        {
            "pseudorigid/dynamics/up.py": "class A:\n    @property\n    def map(self):\n"
            "        import pseudorigid.figures.canvas.style"
        },
        "pseudorigid.dynamics.up imports pseudorigid.figures.canvas.style: upwards",
    ),
    "upwards, by a name": (
        {
            "pseudorigid/proofs/up.py": "import importlib\n\n"
            "def f():\n    return importlib.import_module('pseudorigid.sweep.grid')"
        },
        "pseudorigid.proofs.up imports pseudorigid.sweep.grid: upwards",
    ),
    "upwards, by a relative name": (
        {
            "pipeline/records/up.py": "from importlib import import_module\n\n"
            "def f():\n    import_module('..cli.main', __package__)"
        },
        "pipeline.records.up imports pipeline.cli.main: upwards",
    ),
    "out of the science": (
        {"pseudorigid/study/out.py": "def f():\n    from pipeline import config"},
        "pseudorigid.study.out imports pipeline.config: the science knows no pipeline",
    ),
    "an eighth room": (
        {f"pseudorigid/{name}.py": "" for name in ("eighth",)},
        "pseudorigid: 8 rooms: ",
    ),
    "a room of its own at the top": (
        {"pipeline/tools/__init__.py": "", "pipeline/tools/one.py": ""},
        "pipeline.tools: a room without a floor",
    ),
    "an eighth room below that others import": (
        {
            "pipeline/records/wide/__init__.py": "",
            **{f"pipeline/records/wide/r{i}.py": "" for i in range(8)},
            "pipeline/records/wide/all.py": "\n".join(f"from . import r{i}" for i in range(8)),
        },
        "pipeline.records.wide: 8 rooms: ",
    ),
}


@pytest.mark.parametrize("fault", PLANTED)
def test_a_planted_fault_is_found(copy, fault):
    files, words = PLANTED[fault]
    for name, text in files.items():
        path = copy / name
        path.parent.mkdir(exist_ok=True)
        with path.open("a") as file:
            file.write(f"\n\n{text}\n")
    assert any(line.startswith(words) for line in faults(copy)), list(faults(copy))


def test_many_peers_that_no_sibling_imports_are_no_fault(copy):
    folder = copy / "pipeline" / "records" / "peers"
    folder.mkdir()
    for name in ("__init__", *(f"r{i}" for i in range(12))):
        (folder / f"{name}.py").write_text("")
    assert list(faults(copy)) == []


def test_a_circle_is_found_wherever_it_is():
    chain = {a: {b} for a, b in pairwise("abcdef")}
    assert circle(chain) is None
    assert circle(chain | {"f": {"c"}}) == ["c", "d", "e", "f"]
    assert circle({"a": {"b", "c"}, "b": {"d"}, "c": {"d"}, "d": set()}) is None
