"""Source files of results, read from import statements, and their syntax hashes."""

import re

import pytest

from helpers.project import ROOT, SHIPPED
from pipeline.config import load
from pipeline.records import sources


def test_a_job_depends_on_what_it_imports_and_no_more():
    stage = sources.source_files("pipeline.jobs.stage", "pseudorigid.dynamics.lyapunov")
    assert "src/pseudorigid/kernel/arithmetic.py" in stage
    assert not [file for file in stage if "/figures/" in file or "periodic" in file]
    drawing = sources.source_files("pipeline.jobs.draw", "paper.figures.motion")
    assert "src/paper/figures/motion.py" in drawing
    assert not [file for file in drawing if "pipeline/config" in file or "portrait" in file]


def test_imports_are_followed_wherever_they_stand(tmp_path, monkeypatch):
    package = tmp_path / "pseudorigid"
    (package / "inner").mkdir(parents=True)
    for name, text in {
        "__init__.py": "\ndef __getattr__(name): ...",
        "a.py": "def f():\n    from .inner import b\n", "inner/__init__.py": "HERE = 1",
        "inner/b.py": "from ..c import value\nimport os, pseudorigid.d", "c.py": "import math",
        "d.py": "from . import a\nfrom .inner import HERE", "unused.py": "",
        "lazy.py": "from . import Ball", "lost.py": "from .nowhere import x",
    }.items():  # fmt: skip
        (package / name).write_text(text)
    monkeypatch.setattr(sources, "SRC", tmp_path)
    monkeypatch.setattr(sources, "ROOT", package)
    found = sources.source_files("pseudorigid.a")
    assert found == ["a.py", "c.py", "d.py", "inner/__init__.py", "inner/b.py"]
    with pytest.raises(ValueError, match="import Ball from its module"):
        sources.source_files("pseudorigid.lazy")
    with pytest.raises(ValueError, match=r"no module pseudorigid\.nowhere"):
        sources.source_files("pseudorigid.lost")


def of_all():
    """Build specifications of every result of the shipped config."""
    return load(SHIPPED).build_specs()


def test_no_source_of_a_result_reads_docstrings_or_imports_by_unknown_names():
    files = {file for spec in of_all().values() for file in spec.sources}
    dynamic = {f"src/pipeline/jobs/{name}.py" for name in ("draw", "stage")}
    # A signature's names are in the hash.
    words = r"__doc__|getdoc|inspect\.(?!signature)|get_type_hints|__annotations__"
    for file in sorted(files):
        text = (ROOT / file).read_text(encoding="utf-8")
        if file.endswith(".py"):
            assert not re.search(words, text), file
            found = re.search(r"import_module|__import__|importlib\.i|exec\(|eval\(", text)
            # Nothing may import the names that a package with __getattr__ imports lazily.
            assert not found or file in dynamic or "\ndef __getattr__" in text, file
    assert len(files) > 40


def test_bookkeeping_is_no_source_of_any_result():
    specs, tree = of_all(), {str(file.relative_to(ROOT)) for file in ROOT.glob("src/**/*.py")}
    for module in sources.BOOKKEEPING:
        name = f"src/{module.replace('.', '/')}"
        (file,) = {f"{name}.py", f"{name}/__init__.py"} & tree
        assert not [path for path, spec in specs.items() if file in spec.sources]
    # Other modules of `records` are sources of a drawing.
    drawing = specs["results/paper/figures/fig3.png"].sources
    assert "src/pipeline/records/artifacts.py" in drawing


TEXT = '''"""A module."""

from dataclasses import dataclass

SCALE = 0.5  # of lengths


@dataclass
class Point:
    """A point."""

    x: float
    y: float = 1.0


def far(point, *, more=None):
    """Whether it is far."""
    size: float = abs(point.x) + SCALE * 1e3
    match point:
        case Point(x=0):
            return {**more, "é\\U0001fae8": b"\\xff"}
    return f"{size:.{3}f} and" f" {point.y!r:}" "!", -1, 1j, ...
'''


def hash_of(text, name="x.py"):
    return sources.parsed(name, text.encode()).syntax_hash


WITHOUT_EFFECT = [
    ("# of lengths", "# what lengths are multiplied by"),
    ('"""A module."""', '"""What a module is.\n\nAt length."""'),
    ('"""A point."""', '"""A point of the plane."""'),
    ('"""Whether it is far."""\n', "\n"),
    ("size: float = ", "size = "),
    ("size: float = ", "size: int = "),
    ("SCALE * 1e3", "(\n        SCALE * 1000.0\n    )"),
    ('"{size:.{3}f} and" f" {point.y!r:}" "!"', '"{size:.{3}f} and {point.y!r}!"'),
    ("point, *, more=None", "point,\n    *,\n    more=None,\n"),
]
WITH_EFFECT = [
    ("SCALE = 0.5", "SCALE = 0.25"), ("SCALE = 0.5", "SCALE: float = 0.5"),
    ("    x: float\n", "    x: int\n"), ("    x: float\n", ""),
    ("y: float = 1.0", "y = 1.0"), ("y: float = 1.0", "y: float = 1"), ("@dataclass\n", ""),
    ("more=None", "more: dict = None"), ("point.y!r:", "point.y!s:"), ("f} and", "f} And"),
    (", -1,", ", +1,"), ("1j", "2j"), ("...", "None"), ("**more, ", ""),
    ("Point(x=0)", "Point(x=False)"), ("abs(point.x)", "abs(point.y)"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new"), WITHOUT_EFFECT + WITH_EFFECT)
def test_an_edit_changes_the_hash_if_it_has_an_effect(old, new):
    assert TEXT.count(old) == 1
    assert (hash_of(TEXT.replace(old, new)) != hash_of(TEXT)) == ((old, new) in WITH_EFFECT)


def test_hashes_do_not_depend_on_pythons_version():
    """These were computed under Python 3.11, 3.12 and 3.13."""
    assert hash_of(TEXT)[:16] == "5fdb88b11fb526e4"
    assert hash_of("a: 1\n", "x.toml")[:16] == "9b7acdf56d4776c2"


def test_files_that_are_no_python_are_hashed_by_their_bytes():
    assert hash_of("def f(:\n") != hash_of("def f(:\n\n")
    assert hash_of("a = 1", "x.toml") != hash_of("a  = 1", "x.toml")


@pytest.mark.parametrize("damage", ["value", "import", "cut", "folder"])
def test_a_damaged_store_of_hashes_is_not_used(tmp_path, monkeypatch, damage):
    store = tmp_path / "hashes.json"
    monkeypatch.setattr(sources, "_STORE", store)
    stored, results = sources._results.__wrapped__, {}
    monkeypatch.setattr(sources, "_results", lambda: results)
    found = sources.parsed("module.py", b"import os\n\nVALUE = 1\n")
    sources._store_results()
    assert [*stored().values()] == [[found.syntax_hash, [[0, "os", []]]]]
    text = store.read_text()
    if damage == "folder":
        store.unlink()
        store.mkdir()
    elif damage == "cut":
        store.write_text(text[:-1])
    else:
        edits = {"value": (found.syntax_hash, "0" * 64), "import": ('"os"', '"re"')}
        store.write_text(text.replace(*edits[damage]))
        assert store.read_text() != text
    assert stored() == {}


def test_a_module_depends_on_the_packages_around_it(tmp_path):
    inner = tmp_path / "pseudorigid" / "deep"
    inner.mkdir(parents=True)
    files = [inner.parent / "__init__.py", inner / "__init__.py", inner / "module.py"]
    for file in files:
        file.write_text("")
    assert sources.import_closure(tmp_path, "pseudorigid.deep.module") == sorted(files)
