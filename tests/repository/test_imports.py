"""Imports point downwards, without circles; the engine names no part; processes load little."""

import ast
import copy
import graphlib
import os
import re
import sys
import tomllib
from importlib.util import find_spec

import grimp
import pytest
import yaml

from helpers.project import ROOT, SHIPPED, run
from helpers.requirements import requested
from pipeline import config
from pipeline.cli import packages
from pipeline.command_list import COMMANDS
from pipeline.config import MAIN
from pipeline.config.schema import scene
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.parts import SETS, SETTINGS
from pipeline.declaration import files, parts
from pipeline.records.sources import source_files

# Each package may import those to its right, and each part of one the parts to its right.
ORDER = ("extensions", "study", "paper", "pipeline", "pseudorigid")
PRESENT = [name for name in ORDER if (ROOT / "src" / name / "__init__.py").is_file()]
PACKAGES_OF_PARTS = {
    file.parent.name: ".".join(file.parent.relative_to(ROOT / "src").parts)
    for file in (ROOT / "src").rglob("part.py")
}
LAYERS = {
    "pseudorigid": ("verified", "figures", "dynamics", "kernel"),
    "pipeline": (
        *("cli", "renew", "jobs", "checks", "config", "command_list"),
        *("records", "loading", "declaration", "spelling"),
    ),
}
LEVEL = {f"{package}.{part}": i for package in LAYERS for i, part in enumerate(LAYERS[package])}


@pytest.fixture(scope="module")
def built():
    """The graph of imports, also of those in functions."""
    return grimp.build_graph(*PRESENT, cache_dir=None)


@pytest.fixture
def graph(built):
    """Module -> the modules that it imports anywhere."""
    return {name: set(built.find_modules_directly_imported_by(name)) for name in built.modules}


def circle(graph):
    """The nodes of a circle in a graph, or None."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return None


def pieces(graph, parent):
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
            package, other = (ORDER.index(path.split(".")[0]) for path in (name, target))
            if other < package or (
                other == package and LEVEL.get(imported, 99) < LEVEL.get(part, -1)
            ):
                yield f"{name} imports {target}: upwards"
    for parent in {name.rpartition(".")[0] for name in graph} - {""}:
        siblings = pieces(graph, parent)
        if nodes := circle(siblings):
            yield f"a circle in {parent}: {' > '.join(nodes)}"
        if parent in LAYERS:
            for part in set(siblings) - {"__main__", *LAYERS[parent]}:
                yield f"{parent}.{part}: a part without a layer"


def test_the_source_follows_the_rules(graph):
    assert list(violations(graph)) == []


GUARDED = re.compile(r'if "(\w+)" in parts\(\):\n +from (extensions\.\1[\w.]*) import (\w+)')


@pytest.fixture
def unguarded(built):
    """The graph of imports without those below `if "NAME" in parts():`."""
    graph = copy.deepcopy(built)
    for file in (ROOT / "src" / "extensions").rglob("*.py"):
        module = ".".join(file.relative_to(ROOT / "src").with_suffix("").parts)
        for _, package, name in GUARDED.findall(file.read_text()):
            for imported in {package, f"{package}.{name}"} & graph.modules:
                graph.remove_import(importer=module, imported=imported)
    return graph


def with_needs(names):
    """The names of parts, and of those that they need."""
    return {*names}.union(*(with_needs(parts()[name].needs) for name in names if name in parts()))


def undeclared(graph):
    """Yield (part, another one) if the first needs the second and does not say so."""
    for name, declared in parts().items():
        own = PACKAGES_OF_PARTS[name]
        inside = {module for module in graph.modules if module.startswith(f"{own}.")}
        for other in parts().keys() - with_needs([name]):
            commands = [each for each in declared.commands.values() if each.module]
            allowed = {each.module for each in commands if other in with_needs(each.needs)}
            if "benchmark" in parts()[other].commands:  # which alone loads rows of others
                allowed |= {f"{own}.bench"} & inside
            for module in set(allowed):
                allowed |= graph.find_upstream_modules(module)
            # Modules by which it is entered where the other one is absent.
            entered = {each.module for each in commands if other not in with_needs(each.needs)}
            entered |= {f"{own}.{module}" for module in ("part", "kinds")}
            for module in (inside - allowed) | (entered & inside):
                reached = graph.find_upstream_modules(module)
                if any(each.startswith(f"{PACKAGES_OF_PARTS[other]}.") for each in reached):
                    yield name, other


def test_a_part_imports_those_that_it_declares(unguarded):
    assert list(undeclared(unguarded)) == []


# Names that are also keys of the config or of its common fields, which the engine declares.
KEYS = {"scenes", "variants"}
for _group in vars(scene).values():
    KEYS |= getattr(_group, "model_fields", {}).keys()


def names_of_parts():
    """The names that parts declare: of themselves, stages, kinds, scenes, commands and folders."""
    found = set(parts()) | KINDS.keys() | SETTINGS.keys()
    for part in parts().values():
        for declared in ("stages", "sets", "commands"):
            found |= getattr(part, declared).keys() - COMMANDS.keys()
        found |= {each.key for each in part.sets.values()}
        found |= {each.folder for each in part.sets.values()}
        found |= {*part.folders}
    keys = {each.key for each in SETS.values()}
    for file in files("scenes.yaml").values():
        for key, block in yaml.safe_load(file.read_text()).items():
            found |= {*block} if key in keys else set()
    return found - KEYS - {""}


def test_the_engine_has_no_name_of_a_part():
    names = names_of_parts()
    words = {name for name in names if name.isalpha()}  # in prose they have their usual meaning
    plain, quoted = ("|".join(map(re.escape, sorted(each))) for each in (names - words, words))
    pattern = re.compile(rf"""(?<![\w-])({plain})(?![\w-])|["']({quoted})["']""")
    engine = [ROOT / "Snakefile", ROOT / "workflow" / "rules" / "common.smk"]
    engine += [f for each in (ROOT / "src").glob("snakemake_*") for f in each.rglob("*.py")]
    engine += (ROOT / "src" / "pipeline").rglob("*.py")
    found = [
        f"{file.relative_to(ROOT)}: {line.strip()}"
        for file in engine
        for line in file.read_text().splitlines()
        if pattern.search(line)
    ]
    assert found == []


# Where packages that are not in the lock are imported, and the file in requirements/ that has them;
# those of packages._ON_DEMAND may be imported anywhere.
ADDED = {
    "src/extensions/publication/site/conf.py": "site",
    "src/extensions/atlas/gpu/card.py": "gpu",
    "src/study/methods/libraries.py": "study",
    "src/extensions/explorer/page.py": "explorer",
    "src/extensions/publication/article/typesetting.py": "article",
}
# Modules whose package has another name.
PACKAGES = {"PIL": "pillow", "flint": "python-flint", "minify": "tdewolff-minify"}
PACKAGES |= {
    "typing_extensions": "typing-extensions",
    "yaml": "pyyaml",
    "annotated_types": "annotated-types",
    "py_mini_racer": "mini-racer",
    "cuda": "cuda-core",
}
for _kind in ("logger", "executor"):
    PACKAGES[f"snakemake_interface_{_kind}_plugins"] = f"snakemake-interface-{_kind}-plugins"


def packages_of(source):
    """The packages that a source imports, also inside functions."""
    for node in ast.walk(ast.parse(source)):
        names = [name.name for name in node.names] if isinstance(node, ast.Import) else []
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            names = [node.module]
        for name in {name.partition(".")[0] for name in names} - sys.stdlib_module_names:
            if not (ROOT / "src" / name).is_dir() and name != "__future__":
                yield PACKAGES.get(name, name)


SOURCES = {str(f.relative_to(ROOT)): f.read_text() for f in (ROOT / "src").rglob("*.py")}


def test_every_imported_package_is_named_in_the_list_of_the_commands_that_reach_it():
    """And no other package is, so that a run installs what the sources need and what that needs."""
    on_demand = {PACKAGES.get(name, name): each for name, each in packages._ON_DEMAND.items()}
    imported, lists = {}, {*on_demand.values(), *ADDED.values(), "main"}
    for file, source in SOURCES.items():
        for name in packages_of(source):
            imported.setdefault(on_demand.get(name) or ADDED.get(file, "main"), set()).add(name)
    named = {each: {*requested(each)} for each in lists}
    common = set().union(*(named[each] for each in ("main", *on_demand.values())))
    for each, names in imported.items():
        assert {name.lower() for name in names} <= named[each] | common, each
    used = {name.lower() for name in imported["main"]}
    if (ROOT / "src" / "extensions").is_dir():  # some packages are for parts alone
        assert named["main"] - used == {"contourpy"}  # held back


def test_no_figure_of_the_paper_needs_a_package_that_is_installed_on_demand():
    specs = config.load(SHIPPED).build_specs([MAIN]).values()
    files = {file for spec in specs for file in spec.sources if file.endswith(".py")}
    names = {name for file in files for name in packages_of(SOURCES[file])}
    assert names and names.isdisjoint(PACKAGES.get(name, name) for name in packages._ON_DEMAND)


def test_the_wheel_demands_the_packages_that_it_imports_and_no_others():
    """Those that `verified` alone imports are an extra."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    imported = {True: set(), False: set()}
    for file, source in SOURCES.items():
        if file.startswith("src/pseudorigid/"):
            imported[file.startswith("src/pseudorigid/verified/")] |= {*packages_of(source)}

    def names(demands):
        return {demand.partition(" ")[0].replace("_", "-").lower() for demand in demands}

    imported = {kind: names(found) for kind, found in imported.items()}
    by_xarray = {"netcdf4"}  # imported by Dataset.to_netcdf
    assert imported[False] | by_xarray == names(project["dependencies"])
    assert imported[True] - imported[False] == names(project["optional-dependencies"]["verified"])
    bounds = [*project["dependencies"], *project["optional-dependencies"]["verified"]]
    assert all(" >= " in demand for demand in bounds)


# What a drawing may import of the numerics: the logarithm of its axes, sine and cosine of the
# section's outline, closed formulas, what the paper prints, and the names of variables.
DRAWN_WITH = {
    *(f"src/pseudorigid/dynamics/{n}.py" for n in ("__init__", "paper", "variables")),
    *(f"src/pseudorigid/kernel/{n}.py" for n in ("__init__", "arithmetic", "closed_forms")),
    "src/pseudorigid/kernel/compiled.py",
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_drawing_computes_nothing(kind):
    """No edit of a stage, or of the kernel's map, draws a picture again whose data it keeps."""
    names = KINDS[kind].drawn_by, KINDS[kind].reported_by
    modules = {name.rpartition(".")[0] for name in names}
    found = source_files("pipeline.jobs.draw", *filter(find_spec, modules))
    numerics = re.compile("src/pseudorigid/(dynamics|kernel)/")
    assert {file for file in found if numerics.match(file)} <= DRAWN_WITH


LIBRARIES = ("numpy", "numba", "xarray", "matplotlib", "netCDF4")


def test_the_start_of_a_run_loads_no_library_of_the_science():
    load = f"import pipeline.cli.running, pipeline.config as c; c.load({str(SHIPPED)!r})"
    program = f"import sys\n{load}\nprint(*(n for n in {LIBRARIES} if n in sys.modules))"
    result = run(sys.executable, "-c", program, env=os.environ | {"PYTHONPATH": str(ROOT / "src")})
    assert result.stdout == "\n", result.stderr
