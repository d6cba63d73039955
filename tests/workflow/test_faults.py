"""Faults of a run: damaged files, failing jobs, interrupts and kills."""

import fcntl
import os
import shutil
import signal
import subprocess
import time

import pytest
from runs import contents, last_line, rows


def test_a_damaged_drawing_is_made_again_and_not_published(done):
    before = contents(done)
    drawing = done.path / "results" / "paper" / "figures" / "fig3.png"
    drawing.write_bytes(drawing.read_bytes()[:300])
    result = done.run()
    assert result.returncode == 0
    last_line(result)
    assert "figures/fig3.png: changed after it was made, made again" in result.stdout
    assert contents(done) == before
    assert drawing.read_bytes() == before["fig3.png"]


def test_a_damaged_artifact_is_one_line_that_says_how_to_go_on(done):
    artifact = done.path / "results" / "paper" / "periodic_fig4.nc"
    whole = artifact.read_bytes()
    artifact.write_bytes(whole[:5000])
    result = done.run("-k")
    assert result.returncode == 1
    last = last_line(result)
    assert last.startswith("pseudorigid: fig4, fig5, fig6: results/paper/periodic_fig4.nc: damaged")
    assert last.endswith("; delete it and run ./reproduce again")
    artifact.unlink()
    assert done.run().returncode == 0
    assert artifact.read_bytes() == whole


def test_an_orbit_that_does_not_exist_ends_in_one_line(done):
    before = done.published()
    done.edit("fig3", type="inverse hyperbolic")
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 1
    last = last_line(result)
    assert last.startswith("pseudorigid: fig3: ")
    assert "inverse hyperbolic" in last
    assert done.published() == before


def test_a_bug_in_a_stage_ends_in_one_line_that_names_the_log(done):
    before = done.published()
    module = done.path / "src" / "pseudorigid" / "dynamics" / "lyapunov.py"
    text = module.read_text()
    module.write_text(f"{text}\n\ndef scene_exponents(*_, **__):\n    return 1 / 0\n")
    result = done.run("paper_figures/fig7.png")
    assert result.returncode == 1
    log = "results/paper/logs/lyapunov_fig7.log"
    said = f"pseudorigid: fig7: ZeroDivisionError: division by zero (traceback in {log})"
    assert last_line(result) == said
    assert "Traceback" in (done.path / log).read_text()
    assert done.published() == before
    module.write_text(text)
    assert done.run().returncode == 0


def test_a_failing_publication_leaves_the_figures_as_they_were(done):
    before = contents(done)
    rule = done.path / "workflow" / "rules" / "publish.smk"
    text = rule.read_text()
    rule.write_text(text.replace("(cp ", "(false; cp "))
    assert done.run("paper_figures/fig3.png").returncode == 1
    assert contents(done) == before
    rule.write_text(text)
    assert done.run().returncode == 0


@pytest.mark.parametrize("everyone", [False, True])
def test_a_killed_run_leaves_whole_files_and_no_lock(done, everyone):
    before = contents(done)
    results = done.path / "results"
    shutil.rmtree(results)
    targets = [f"paper_figures/fig{n}.{extension}" for n in (3, 4) for extension in ("png", "svg")]
    run = done.start(*targets, start_new_session=True)
    try:
        for _ in range(600):
            if list(results.glob("paper/figures/*.*")):
                break
            time.sleep(0.1)
        assert run.poll() is None
        (os.killpg if everyone else os.kill)(run.pid, signal.SIGKILL)
        run.wait()
        assert contents(done) == before
        again = done.run(*targets)
        assert again.returncode == 0, again.stdout
        assert set(rows(again.stdout)) == set(targets)
    finally:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
    assert contents(done) == before


@pytest.mark.parametrize(
    "file", ["src/pipeline/config/__init__.py", "src/snakemake/cli.py", "Snakefile"]
)
def test_interrupting_the_start_is_no_traceback(tree, file):
    reached = tree.path / "reached"
    path = tree.path / file
    if "snakemake" in file:  # a stand-in, found first
        path.parent.mkdir()
        (path.parent / "__init__.py").touch()
    with path.open("a") as module:
        module.write(f"\nimport time\nopen({str(reached)!r}, 'w').close()\ntime.sleep(60)\n")
    run = tree.start(
        "-n",
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        # A job in the background of a shell would ignore it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    for _ in range(600):
        if reached.exists():
            break
        time.sleep(0.1)
    run.send_signal(signal.SIGINT)
    output, _ = run.communicate(timeout=30)
    assert run.returncode != 0
    assert "Traceback" not in output


def test_two_runs_do_not_meet(tree):
    with (tree.path / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        result = tree.run("-n")
    assert result.returncode == 1
    assert result.stdout == "reproduce: another ./reproduce is running in this folder\n"
    assert tree.run("-n").returncode == 0  # the file is still there, and locks nothing
