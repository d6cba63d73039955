"""A result whose record does not fit this tree is reported with the reason."""

import json

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
    text = path.read_text()
    for part, file, reason in (
        ("inputs", PERIODIC, f"made from another {PERIODIC}"),
        ("sources", MOTION, f"made by other code than this tree's: {MOTION} differs"),
    ):
        record = json.loads(text)
        record[part][file] = "0" * 64
        path.write_text(json.dumps(record))
        assert finding(moved) == f"{TARGET}: {reason}"


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
