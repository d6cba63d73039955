"""The workflow as a user runs it, in a copy whose scenes are tiny."""

import fcntl
import os
import shutil
import signal
import subprocess
import time

import pytest
from conftest import ROOT, fresh_tree

from pipeline.records import sources

FIG3 = {
    "results/paper/periodic_fig3.nc",
    "results/paper/motion_fig3.nc",
    "results/paper/figures/fig3.png",
    "paper_figures/fig3.png",
}
FIG7 = {
    *(f"results/paper/figures/fig7.{extension}" for extension in ("png", "svg")),
    *(f"paper_figures/fig7.{extension}" for extension in ("png", "svg")),
}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A copy in which everything was made once, from the state of a fresh clone."""
    tree = fresh_tree(tmp_path_factory.mktemp("workflow") / "a folder with spaces")
    tree.first = tree.run()
    assert tree.first.returncode == 0, tree.first.stdout
    return tree


@pytest.fixture
def done(finished):
    """The finished copy, its config and sources put back afterwards."""
    yield finished
    finished.restore()


def rows(result):
    """File -> recomputed or current, from the table at the end."""
    lines = (line.split() for line in result.stdout.splitlines())
    return {line[1]: line[-1] for line in lines if line and line[-1] in ("recomputed", "current")}


def no_traceback(result):
    assert "Traceback" not in result.stdout
    return result.stdout.splitlines()[-1]


def test_a_fresh_clone_computes_everything_whatever_the_file_times(finished):
    table = rows(finished.first)
    assert set(table.values()) == {"recomputed"}
    assert {f"paper_figures/{name}" for name in finished.published()} == set(table)
    assert b"committed" not in {content for content, _, _ in finished.published().values()}


def test_a_second_run_has_nothing_to_do(finished):
    before = finished.published()
    start = time.monotonic()
    again = finished.run()
    assert time.monotonic() - start < 20
    assert "Nothing to be done" in again.stdout
    assert set(rows(again).values()) == {"current"}
    assert finished.published() == before


def test_a_figure_of_a_fresh_clone_needs_only_its_orbit(tree):
    assert tree.planned("paper_figures/fig3.png") == FIG3


def test_everything_of_a_fresh_clone_is_planned(tree, finished):
    for file in sorted(p for p in tree.path.rglob("*") if p.is_file()):
        if "paper_figures" not in file.parts:
            os.utime(file, (0, 0))
    made = {
        p for p in (finished.path / "results").rglob("*.*") if p.suffix not in (".log", ".json")
    }
    made |= set((finished.path / "paper_figures").iterdir())
    assert tree.planned() == {str(p.relative_to(finished.path)) for p in made}


def test_editing_the_exponents_reruns_them_alone(done):
    done.edit("fig7", impacts=61)
    assert done.planned() == FIG7 | {"results/paper/lyapunov_fig7.nc"}


def test_editing_axes_only_draws_again(done):
    axes = {"limits": [-0.5, 0.5], "ticks": [0]}
    done.edit("fig7", axes={"impact": {"limits": [0, 200000], "ticks": [0]}, "exponent": axes})
    assert done.planned() == FIG7


def test_adding_a_format_makes_that_file_alone(done):
    done.edit("fig7", formats=["png", "svg", "pdf"])
    assert done.planned() == {"results/paper/figures/fig7.pdf"}


def test_editing_a_module_reruns_what_uses_it(done):
    with (done.path / "src" / "pseudorigid" / "lyapunov.py").open("a") as file:
        file.write("# edited\n")
    assert done.planned() == FIG7 | {"results/paper/lyapunov_fig7.nc"}


def test_touching_a_module_reruns_nothing(done):
    (done.path / "src" / "pseudorigid" / "lyapunov.py").touch()
    assert done.planned() == set()


def test_what_was_deleted_comes_back(done):
    for name in ("fig3.png", "fig7.svg"):
        (done.path / "results" / "paper" / "figures" / name).unlink()
    artifact = done.path / "results" / "paper" / "periodic_fig3.nc"
    content = artifact.read_bytes()
    artifact.unlink()
    before = {name: content for name, (content, _, _) in done.published().items()}
    single = done.run("paper_figures/fig3.png")
    assert single.returncode == 0
    assert rows(single) == {"paper_figures/fig3.png": "recomputed"}
    assert artifact.read_bytes() == content
    again = rows(done.run())
    assert again.pop("paper_figures/fig7.svg") == "recomputed"
    assert again.pop("paper_figures/fig3.png") == "current"
    assert {name: content for name, (content, _, _) in done.published().items()} == before
    assert done.planned() == set()


def test_a_published_figure_that_is_not_its_drawing_is_published_again(done):
    before = {name: content for name, (content, _, _) in done.published().items()}
    for name in ("fig3.png", "fig7.svg"):
        figure = done.path / "paper_figures" / name
        figure.write_text("x")
        os.utime(figure, (4e9, 4e9))
    assert done.planned() == {"paper_figures/fig3.png", "paper_figures/fig7.svg"}
    single = done.run("paper_figures/fig3.png")
    assert rows(single) == {"paper_figures/fig3.png": "current"}
    assert done.planned() == {"paper_figures/fig7.svg"}
    everything = done.run()
    assert set(rows(everything).values()) == {"current"}
    assert {name: content for name, (content, _, _) in done.published().items()} == before
    assert done.planned() == set()


def test_a_damaged_drawing_is_made_again_and_not_published(done):
    before = {name: content for name, (content, _, _) in done.published().items()}
    drawing = done.path / "results" / "paper" / "figures" / "fig3.png"
    drawing.write_bytes(drawing.read_bytes()[:300])
    result = done.run()
    assert result.returncode == 0
    no_traceback(result)
    assert "figures/fig3.png: changed after it was made, made again" in result.stdout
    assert {name: content for name, (content, _, _) in done.published().items()} == before
    assert drawing.read_bytes() == before["fig3.png"]


def test_a_damaged_artifact_is_one_line_that_says_how_to_go_on(done):
    artifact = done.path / "results" / "paper" / "periodic_fig4.nc"
    whole = artifact.read_bytes()
    artifact.write_bytes(whole[:5000])
    result = done.run("-k")
    assert result.returncode == 1
    last = no_traceback(result)
    assert last.startswith("pseudorigid: fig4, fig5, fig6: results/paper/periodic_fig4.nc: damaged")
    assert last.endswith("; delete it and run ./reproduce again")
    artifact.unlink()
    assert done.run().returncode == 0
    assert artifact.read_bytes() == whole


def test_a_setting_for_windows_does_not_matter(done, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "no such backend")
    (done.path / "results" / "paper" / "figures" / "fig3.png").unlink()
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize(
    "file", ["src/pseudorigid/config/__init__.py", "src/snakemake/cli.py", "Snakefile"]
)
def test_interrupting_the_start_is_no_traceback(tree, file):
    reached = tree.path / "reached"
    path = tree.path / file
    if "snakemake" in file:  # a stand-in, found first
        path.parent.mkdir()
        (path.parent / "__init__.py").touch()
    with path.open("a") as module:
        module.write(f"\nimport time\nopen({str(reached)!r}, 'w').close()\ntime.sleep(60)\n")
    run = subprocess.Popen(
        tree.command("-n"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        # A job in the background of a shell would ignore it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )
    for _ in range(600):
        if reached.exists():
            break
        time.sleep(0.1)
    run.send_signal(signal.SIGINT)
    output, _ = run.communicate(timeout=30)
    assert run.returncode != 0
    assert "Traceback" not in output


def test_an_orbit_that_does_not_exist_ends_in_one_line(done):
    before = done.published()
    done.edit("fig3", type="inverse hyperbolic")
    result = done.run("paper_figures/fig3.png")
    assert result.returncode == 1
    last = no_traceback(result)
    assert last.startswith("pseudorigid: fig3: ")
    assert "inverse hyperbolic" in last
    assert done.published() == before


def test_a_bug_in_a_stage_ends_in_one_line_that_names_the_log(done):
    before = done.published()
    with (done.path / "src" / "pseudorigid" / "lyapunov.py").open("a") as file:
        file.write("\n\ndef scene_exponents(*_, **__):\n    return 1 / 0\n")
    result = done.run("paper_figures/fig7.png")
    assert result.returncode == 1
    last = no_traceback(result)
    log = "results/paper/logs/lyapunov_fig7.log"
    assert last == f"pseudorigid: fig7: ZeroDivisionError: division by zero (traceback in {log})"
    assert "Traceback" in (done.path / log).read_text()
    assert done.published() == before
    done.restore()
    assert done.run().returncode == 0


def test_a_failing_publication_leaves_the_figures_as_they_were(done):
    before = {name: content for name, (content, _, _) in done.published().items()}
    rule = done.path / "workflow" / "rules" / "publish.smk"
    rule.write_text(rule.read_text().replace("(cp ", "(false; cp "))
    assert done.run("paper_figures/fig3.png").returncode == 1
    assert {name: content for name, (content, _, _) in done.published().items()} == before
    done.restore()
    assert done.run().returncode == 0


@pytest.mark.parametrize("everyone", [False, True])
def test_a_killed_run_leaves_whole_files_and_no_lock(done, everyone):
    before = {name: content for name, (content, _, _) in done.published().items()}
    results = done.path / "results"
    results.rename(done.path / "saved")
    targets = [f"paper_figures/fig{n}.{extension}" for n in (3, 4) for extension in ("png", "svg")]
    command = done.command(*targets)
    run = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    )
    try:
        for _ in range(600):
            if list(results.glob("paper/figures/*.*")):
                break
            time.sleep(0.1)
        assert run.poll() is None
        (os.killpg if everyone else os.kill)(run.pid, signal.SIGKILL)
        run.wait()
        assert {name: content for name, (content, _, _) in done.published().items()} == before
        again = done.run(*targets)
        assert again.returncode == 0, again.stdout
        assert set(rows(again)) == set(targets)
    finally:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
        shutil.rmtree(results)
        (done.path / "saved").rename(results)
    assert {name: content for name, (content, _, _) in done.published().items()} == before


def test_two_runs_do_not_meet(done):
    with (done.path / ".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        result = done.run("-n")
    assert result.returncode == 1
    assert result.stdout == "reproduce: another ./reproduce is running in this folder\n"
    assert done.run("-n").returncode == 0  # the file is still there, and locks nothing


def test_a_bad_config_is_one_line_and_starts_nothing(tree):
    tree.edit("fig5", energy=0.9)
    line = (
        "config.yaml: scenes.fig5.energy: 0.9 is not allowed: expected a number below "
        "k/2 - g = 0.06, where the ball could flatten to nothing\n"
    )
    result = tree.run()
    assert (result.returncode, result.stdout) == (1, line)
    bare = subprocess.run(
        [*tree.command()[:1], "-m", "snakemake", "-n"],
        cwd=tree.path,
        env=os.environ | {"PYTHONPATH": str(tree.path / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (bare.returncode, bare.stderr) == (1, line)
    assert not (tree.path / "results").exists()


def test_settings_on_the_command_line_are_refused(tree):
    result = tree.run("-n", "--config", "energy=0.3")
    assert result.returncode == 1
    assert result.stdout.splitlines()[-1].endswith("not used here: edit config.yaml")


def test_the_graph_is_printed(tree):
    result = tree.run("paper_figures/fig3.png", "--dag")
    assert result.returncode == 0
    assert "digraph snakemake_dag" in result.stdout


def used(script):
    """Names of the package's files behind a script of the workflow."""
    files = sources.closure(ROOT / "workflow" / "scripts" / script)
    return {str(file.relative_to(sources.PACKAGE)) for file in files}


def test_a_script_depends_on_what_it_imports_and_no_more():
    assert {"__init__.py", "lyapunov.py", "impact.py", "arithmetic.py"} <= used("lyapunov.py")
    assert not used("lyapunov.py") & {"manifolds.py", "periodic.py", "config/__init__.py"}
    assert not {name for name in used("orbits.py") if name.startswith("figures")}
    assert "figures/portrait.py" not in used("draw.py")


def test_imports_are_followed_wherever_they_stand(tmp_path, monkeypatch):
    package = tmp_path / "pseudorigid"
    (package / "inner").mkdir(parents=True)
    for name, text in {
        "__init__.py": "",
        "a.py": "def f():\n    from .inner import b\n",
        "inner/__init__.py": "HERE = 1",
        "inner/b.py": "from ..c import value\nimport os, pseudorigid.d",
        "c.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from . import unused",
        "d.py": "from . import a\nfrom .inner import HERE",
        "unused.py": "",
        "lazy.py": "from . import Ball",
        "lost.py": "from .nowhere import x",
    }.items():
        (package / name).write_text(text)
    monkeypatch.setattr(sources, "PACKAGE", package)
    found = [str(file.relative_to(package)) for file in sources.closure("pseudorigid.a")]
    assert found == ["__init__.py", "a.py", "c.py", "d.py", "inner/__init__.py", "inner/b.py"]
    with pytest.raises(ValueError, match="import Ball from its module"):
        sources.closure("pseudorigid.lazy")
    with pytest.raises(ValueError, match=r"no module pseudorigid\.nowhere"):
        sources.closure("pseudorigid.lost")


def shell_tools(folder, *tools):
    """A folder with nothing on it but these tools."""
    folder.mkdir()
    for tool in ("dirname", "cat", "cksum", "uname", "cut", "tail", "mkdir", "rm", *tools):
        (folder / tool).symlink_to(shutil.which(tool))
    return folder


@pytest.mark.parametrize(
    ("python", "line"),
    [
        (None, "reproduce: no python3 found: please install Python 3.11 or newer\n"),
        (
            "#!/bin/sh\ncase $2 in *platform*) echo 3.9.2;; *) exit 1;; esac\n",
            "reproduce: needs Python 3.11 or newer, but python3 is 3.9.2\n",
        ),
        (
            "#!/bin/sh\ncase $2 in *ensurepip*) exit 1;; *) exit 0;; esac\n",
            "reproduce: python3 lacks the venv module: "
            "please install it (Debian, Ubuntu: apt install python3-venv)\n",
        ),
    ],
)
def test_an_unsuitable_python_is_one_line(tree, tmp_path, python, line):
    path = shell_tools(tmp_path / "bin", "sh")
    if python:
        (path / "python3").write_text(python)
        (path / "python3").chmod(0o755)
    result = subprocess.run(
        [str(tree.path / "reproduce")],
        env={"PATH": str(path)},
        cwd="/",
        capture_output=True,
        text=True,
        check=False,
    )
    assert (result.returncode, result.stdout, result.stderr) == (1, "", line)
    assert not (tree.path / ".venv").exists()
