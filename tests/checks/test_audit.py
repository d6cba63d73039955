"""The records of what made each result, and accept, which renews the contract."""

import json
import os
import shutil
import subprocess

from verdicts import findings, say

from pipeline.checks.verify import accept, verify

PERIODIC = "results/paper/periodic_fig3.nc"
ORBITS = "results/paper/orbits_fig2.nc"


def test_a_record_says_what_made_its_result(accepted):
    path = accepted.path / "results" / "paper" / "provenance" / "motion_fig3.nc.json"
    record = json.loads(path.read_text())
    assert record["config"]["duration"] == 16
    assert set(record["inputs"]) == {PERIODIC}
    assert {"src/pseudorigid/orbits.py", "workflow/scripts/motion.py"} <= set(record["sources"])
    assert "src/pseudorigid/lyapunov.py" not in record["sources"]
    assert {"numpy", "numba", "xarray"} <= set(record["environment"])
    assert record["output"]["file"] == "results/paper/motion_fig3.nc"
    assert {"commit", "dirty"} <= set(record)


# ---- the records ----


def test_a_result_without_its_record_or_with_a_broken_one(moved):
    record = moved.path / "results" / "paper" / "provenance" / "orbits_fig2.nc.json"
    text = record.read_text()
    record.unlink()
    assert findings(moved) == ({}, [f"{ORBITS}: no record of what made it"])
    for content in ("", "[]", "{}", text.replace('"sources"', '"sauces"')):
        record.write_text(content)
        said = f"{ORBITS}: its record results/paper/provenance/orbits_fig2.nc.json is broken"
        assert findings(moved) == ({}, [said])


def test_deleted_records_come_back(moved):
    shutil.rmtree(moved.path / "results" / "paper" / "provenance")
    assert moved.run("results/paper/provenance/motion_fig3.nc.json").returncode == 0
    assert findings(moved)[1][0].startswith("results/paper/orbits_fig2.nc, ")
    record = "results/paper/provenance/motion_fig3.nc.json"
    assert (moved.path / record).exists()


def test_a_result_made_by_other_code(moved):
    """The module is edited, the result made, the edit taken back: snakemake looks at times only."""
    module = moved.path / "src" / "pseudorigid" / "lyapunov.py"
    text, then = module.read_text(), module.stat()
    with module.open("a") as file:
        file.write("# edited\n")
    target = "results/paper/lyapunov_fig7.nc"
    assert moved.run(target).returncode == 0
    module.write_text(text)
    os.utime(module, ns=(then.st_atime_ns, then.st_mtime_ns))
    said = f"{target}: made by other code than this tree's: src/pseudorigid/lyapunov.py differs"
    assert findings(moved) == ({}, [said])


def test_a_run_killed_between_result_and_record_does_both_again(moved):
    """Everything dies, snakemake too, where the result is whole and its record not yet there."""
    result, module = moved.path / ORBITS, moved.path / "src" / "pseudorigid" / "provenance.py"
    text, then = module.read_text(), module.stat()
    result.unlink()
    end = "    about = {"
    assert text.count(end) == 1
    module.write_text(text.replace(end, f"    os.killpg(os.getpgrp(), 9)\n{end}"))
    os.utime(module, ns=(then.st_atime_ns, then.st_mtime_ns))
    # One job, in a group of its own that dies with it.
    run = subprocess.Popen(
        moved.command(ORBITS, "--rerun-triggers", "mtime"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    assert run.wait() == -9
    module.write_text(text)
    os.utime(module, ns=(then.st_atime_ns, then.st_mtime_ns))
    assert result.exists()
    assert findings(moved) == ({}, [f"{ORBITS}: no record of what made it"])
    assert moved.run(ORBITS).returncode == 0
    assert say(verify, moved)[0] == 0


def test_a_result_made_from_another_input(moved):
    path = moved.path / "results" / "paper" / "provenance" / "motion_fig3.nc.json"
    record = json.loads(path.read_text())
    record["inputs"][PERIODIC] = "0" * 64
    path.write_text(json.dumps(record))
    said = f"results/paper/motion_fig3.nc: made from another {PERIODIC}"
    assert findings(moved) == ({}, [said])


# ---- accept ----


def test_accept_says_what_changed_and_repeats_itself(moved):
    assert say(accept, moved) == (0, "nothing changed\n")
    moved.edit("fig7", impacts=61)
    status, refusal = say(accept, moved)
    assert status == 1
    assert "made from another config: impacts: 60 then, 61 now" in refusal
    assert len(refusal.splitlines()) == 1
    assert moved.run().returncode == 0
    figures, _ = findings(moved)
    assert set(figures) == {"fig7.png", "fig7.svg"}
    status, text = say(accept, moved)
    assert status == 0
    lines = text.splitlines()
    assert lines[0] == "fig7.png  config: impacts: 60 in the manifest, 61 in config.yaml"
    assert any(line.startswith("fig7.png  data: results/paper/lyapunov_fig7.nc") for line in lines)
    assert any(line.startswith("fig7.svg  drawing: ") for line in lines)
    assert not any(line.startswith("fig2.png") for line in lines)
    assert say(verify, moved)[0] == 0


def test_accept_without_results_is_one_line(moved):
    shutil.rmtree(moved.path / "results")
    before = moved.published()
    status, text = say(accept, moved)
    assert status == 1
    assert len(text.splitlines()) == 1
    assert "is missing: run ./reproduce first" in text
    assert moved.published() == before
