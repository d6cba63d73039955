"""A result whose record does not fit this tree is reported with the reason."""

import json
import os
import shutil

import pytest
from verdicts import verified

from pipeline.records.record import record_path

PERIODIC = "results/paper/periodic_fig3.nc"
ORBITS = "results/paper/orbits_fig2.nc"
TARGET = "results/paper/motion_fig3.nc"
MOTION = "src/pseudorigid/dynamics/motion.py"


def finding(tree):
    """Return the first finding about results; all figures must be as committed."""
    found = verified(tree)
    assert (found.status, found.wrong) == (1, {})
    return found.findings[0].removesuffix(": run ./reproduce")


def test_a_record_says_what_made_its_result(accepted):
    record = json.loads((accepted.path / record_path(TARGET)).read_text())
    assert record["config"]["duration"] == 16
    assert set(record["inputs"]) == {PERIODIC}
    assert {MOTION, "src/pipeline/jobs/stage.py"} <= set(record["sources"])
    assert "src/pseudorigid/dynamics/lyapunov.py" not in record["sources"]
    assert {"numpy", "numba", "xarray"} <= set(record["environment"])
    assert record["output"]["file"] == TARGET
    assert {"commit", "dirty"} <= set(record)


def test_a_result_whose_record_does_not_fit(moved):
    path = moved.path / record_path(ORBITS)
    text = path.read_text()
    path.unlink()
    assert finding(moved) == f"{ORBITS}: no record of what made it"
    for content in ("", "[]", "{}", text.replace('"sources"', '"sauces"')):
        path.write_text(content)
        assert finding(moved) == f"{ORBITS}: its record {record_path(ORBITS)} cannot be read"
    path.write_text(text)
    path = moved.path / record_path(TARGET)
    record = json.loads(path.read_text())
    record["inputs"][PERIODIC] = "0" * 64
    path.write_text(json.dumps(record))
    assert finding(moved) == f"{TARGET}: made from another {PERIODIC}"


def test_deleted_records_come_back(moved):
    folder = moved.path / "results" / "paper" / "provenance"
    kept = {path.name for path in folder.iterdir()}
    shutil.rmtree(folder)
    assert moved.run("paper_figures/fig3.png").returncode == 0
    made = {"periodic_fig3.nc.json", "motion_fig3.nc.json", "fig3.png.json"}
    assert {path.name for path in folder.iterdir()} == made <= kept
    found = verified(moved)
    assert not [line for line in found.findings if "fig3.png" in line]
    assert "no record of what made it" in found.findings[0]


def test_a_result_made_by_other_code(moved):
    """Edit the module, make the result, and undo the edit with its time."""
    module = moved.path / MOTION
    text, then = module.read_text(), module.stat()
    with module.open("a") as file:
        file.write("_EDITED = 1\n")
    moved.warm()
    assert moved.run(TARGET).returncode == 0
    module.write_text(text)
    os.utime(module, ns=(then.st_atime_ns, then.st_mtime_ns))
    assert finding(moved) == f"{TARGET}: made by other code than this tree's: {MOTION} differs"


@pytest.mark.slow
def test_a_run_killed_between_result_and_record_does_both_again(moved):
    """All processes die after the result is written and before its record is."""
    result, record = moved.path / ORBITS, moved.path / record_path(ORBITS)
    module = moved.path / "src" / "pipeline" / "records" / "record.py"
    text = module.read_text()
    result.unlink()
    record.unlink()
    end = "    output = {"
    assert text.count(end) == 1
    module.write_text(text.replace(end, f"    os.killpg(os.getpgrp(), 9)\n{end}"))
    # The process group of this run dies with its job.
    run = moved.start(ORBITS, start_new_session=True)
    assert run.wait() == -9
    module.write_text(text)
    assert result.exists() and not record.exists()
    assert ORBITS in finding(moved)
    assert moved.run(ORBITS).returncode == 0
    assert verified(moved)[:3] == (0, {}, [])
