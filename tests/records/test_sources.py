"""Source files of a job, read from import statements."""

import pytest

from pipeline.config.schema.stages import STAGES
from pipeline.records import sources


def of_stage(name):
    """Return the files of pseudorigid behind a stage, from its folder."""
    files = sources.source_files("pipeline.jobs.stage", STAGES[name].function.rpartition(".")[0])
    return {file.removeprefix("src/pseudorigid/") for file in files if "pseudorigid" in file}


def test_a_job_depends_on_what_it_imports_and_no_more():
    used = of_stage("lyapunov")
    wanted = {
        "dynamics/lyapunov.py",
        "kernel/impact.py",
        "kernel/arithmetic.py",
        "kernel/__init__.py",
    }
    assert wanted <= used
    assert not used & {"dynamics/manifolds.py", "dynamics/periodic.py"}
    assert not {name for name in of_stage("orbits") if name.startswith("figures")}
    drawing = sources.source_files("pipeline.jobs.draw", "pseudorigid.figures.kinds.motion")
    assert "src/pseudorigid/figures/kinds/motion.py" in drawing
    assert "src/pseudorigid/figures/kinds/portrait.py" not in drawing
    assert not [file for file in drawing if file.startswith("src/pipeline/config")]


def test_imports_are_followed_wherever_they_stand(tmp_path, monkeypatch):
    package = tmp_path / "pseudorigid"
    (package / "inner").mkdir(parents=True)
    for name, text in {
        "__init__.py": "\ndef __getattr__(name): ...",
        "a.py": "def f():\n    from .inner import b\n",
        "inner/__init__.py": "HERE = 1",
        "inner/b.py": "from ..c import value\nimport os, pseudorigid.d",
        "c.py": "import math",
        "d.py": "from . import a\nfrom .inner import HERE",
        "unused.py": "",
        "lazy.py": "from . import Ball",
        "lost.py": "from .nowhere import x",
    }.items():
        (package / name).write_text(text)
    monkeypatch.setattr(sources, "SRC", tmp_path)
    monkeypatch.setattr(sources, "ROOT", package)
    found = sources.source_files("pseudorigid.a")
    assert found == ["a.py", "c.py", "d.py", "inner/__init__.py", "inner/b.py"]
    with pytest.raises(ValueError, match="import Ball from its module"):
        sources.source_files("pseudorigid.lazy")
    with pytest.raises(ValueError, match=r"no module pseudorigid\.nowhere"):
        sources.source_files("pseudorigid.lost")
