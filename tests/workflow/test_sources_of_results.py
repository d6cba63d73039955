"""Records name what jobs load, and edits without an effect outdate nothing."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from helpers.project import ROOT, fresh_tree, of_scenes, shipped
from pipeline.records.sources import BOOKKEEPING

# Put into jobs/job.py: when a result is made, write the names of the loaded files.
NOTES = """
_make = make


def make(spec, *given):
    import json, os

    _make(spec, *given)
    files = [getattr(module, "__file__", None) or "" for module in sys.modules.values()]
    with open(os.path.join(os.environ["NOTES"], spec.result.replace("/", " ")), "w") as file:
        json.dump(files, file)


if __name__"""


def loaded(tree, folder, *targets):
    """Return {result: files of the tree that its job, in a Python of its own, had loaded}."""
    job = tree.path / "src/pipeline/jobs/job.py"
    job.write_text(job.read_text().replace("if __name__", NOTES))
    notes = folder / "notes"
    notes.mkdir()
    result = tree.python("-m", "snakemake", "--cores", "2", *targets, NOTES=str(notes))
    assert result.returncode == 0, result.stderr
    src = f"{tree.path.resolve()}/"
    return {
        note.name.replace(" ", "/"): {
            file.removeprefix(src) for file in json.loads(note.read_text()) if file.startswith(src)
        }
        for note in notes.iterdir()
    }


def bookkeeping():
    names = [f"src/{name.replace('.', '/')}" for name in BOOKKEEPING]
    return {f"{name}.py" for name in names} | {f"{name}/__init__.py" for name in names}


def undeclared(tree, loaded_files):
    """Yield results with the files that their jobs loaded and their records do not name."""
    for result, files in loaded_files.items():
        _, variant, *_, name = Path(result).parts
        record = tree.path / "results" / variant / "provenance" / f"{name}.json"
        named = set(json.loads(record.read_text())["sources"])
        if rest := files - named - bookkeeping():
            yield result, rest


@pytest.mark.slow
def test_a_job_loads_what_its_record_names(tmp_path):
    """Make and draw every kind of scene of the paper, theorems, a claim and a sweep."""
    whole = shipped()
    few = of_scenes("fig2", "fig3", "fig5", "fig7")
    few["proofs"] = whole["proofs"]
    few["claims"] = {"jumps": whole["claims"]["jumps"] | {"sides": 100}}
    few["sweeps"] = {"line": whole["sweeps"]["line"] | {"starts": 60, "impacts": 200}}
    few["sweeps"]["line"]["energy"] = {"from": 1.0, "to": 2.0, "count": 2}
    tree = fresh_tree(tmp_path / "tree", few)
    drawn = [f"paper/figures/fig{number}" for number in (2, 3, 5, 7)]
    drawn += ["proofs/figures/horseshoe", "proofs/figures/twist", "claims/figures/jumps"]
    targets = [f"results/{name}.png" for name in (*drawn, "atlas/figures/line")]
    loaded_files = loaded(tree, tmp_path, *targets)
    assert len(loaded_files) >= 19 and dict(undeclared(tree, loaded_files)) == {}
    assert all("src/pipeline/records/provenance.py" in files for files in loaded_files.values())


def test_comments_formatting_and_docstrings_outdate_nothing(done):
    python = [*(done.path / "src").rglob("*.py"), *(done.path / "workflow").rglob("*.py")]
    rules = [done.path / "Snakefile", *(done.path / "workflow").rglob("*.smk")]
    for file in (*python, *rules):
        file.write_text(f"{file.read_text()}\n\n# edited\n")
    stage = done.path / "src/pseudorigid/dynamics/motion.py"
    text = stage.read_text()
    stage.write_text(re.sub(r'^"""', '"""In other words: ', text, count=1))
    assert stage.read_text() != text
    format_ = [sys.executable, "-m", "ruff", "format", "-q", "--isolated", "--line-length", "88"]
    subprocess.run([*format_, str(done.path / "src"), str(done.path / "workflow")], check=True)
    changed = [f for f in python if f.read_text() != (ROOT / f.relative_to(done.path)).read_text()]
    assert len(changed) > 0.7 * len(python)  # others need no change
    result = done.run("-n")
    assert (result.returncode, result.stdout) == (0, "nothing to make\n")
