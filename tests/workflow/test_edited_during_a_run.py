"""Files that change during a run are not recorded as what made its results."""

import subprocess
import sys

import pytest

DRAWING = "results/paper/figures/fig3.png"
AGAIN = "changed during the run; run ./reproduce again"
MOTION = "src/pseudorigid/figures/kinds/motion.py"  # not loaded by the server of jobs


def plant(tree, code):
    """Have the drawing of fig3 run a line of code when its module is loaded, by the job."""
    file = tree.path / MOTION
    line = f"import pathlib; root = pathlib.Path({str(tree.path)!r}); {code}\n"
    file.write_text(file.read_text() + line)


def append(path):
    """Return code that edits a file."""
    return f"open(root / {path!r}, 'a').write('# edited\\n')"


@pytest.mark.parametrize(
    "path",
    [
        "src/pseudorigid/figures/canvas/style.py",  # loaded beforehand by the server of jobs
        "results/paper/motion_fig3.nc",
    ],
)
def test_a_file_that_changes_fails_the_job(done, path):
    plant(done, append(path))
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 1
    assert f"not made: {path} {AGAIN}" in result.stdout
    assert "Traceback" not in result.stdout


def test_an_edit_that_is_undone_fails_the_job_that_loaded_it(done):
    """A job loads the edited file, which the server has loaded before, then the edit is undone."""
    edited = "src/pseudorigid/figures/edited.py"
    (done.path / edited).write_text("VALUE = 1\n")
    plant(
        done,
        f"p = root / {edited!r}; p.write_text('VALUE = 2\\n'); "
        "from pseudorigid.figures import edited; p.write_text('VALUE = 1\\n')",
    )
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 1
    assert f"not made: {edited} {AGAIN}" in result.stdout
    assert "its source changed: " in done.run("-n", "fig3").stdout


def test_what_was_drawn_before_an_edit_is_not_called_current(done):
    for file in (done.path / DRAWING).parent.glob("fig3.*"):
        file.unlink()
    edit = f"open(root / {MOTION!r}, 'a').write('_UNUSED = 1\\n')"
    plant(done, f"[*root.glob('results/paper/figures/fig3.*')] and {edit}")
    result = done.run("fig3", "--cores", "1")
    assert result.returncode == 1
    states = sorted(
        line.split("fig3.", 2)[-1][3:].strip()
        for line in result.stdout.splitlines()
        if "paper_figures/fig3." in line
    )
    assert states == [
        f"not current: made by other code than this tree's: {MOTION} differs",
        f"not made: {MOTION} {AGAIN}",
    ]


def test_a_run_reports_that_the_config_changed(done):
    plant(done, append("config.yaml"))
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 1
    assert result.stdout.splitlines()[-1] == f"reproduce: config.yaml {AGAIN}"
    assert done.run("paper_figures/fig3.png").returncode == 0


def test_a_job_of_plain_snakemake_fails_too(done):
    plant(done, append("src/pipeline/jobs/draw.py"))
    (done.path / DRAWING).unlink()
    result = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1", DRAWING],
        cwd=done.path,
        env=done.environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 1
    log = done.path / "results/paper/logs/fig3.png.log"
    line = f"pseudorigid: fig3: src/pipeline/jobs/draw.py {AGAIN}"
    assert log.read_text().splitlines()[-1] == line
