"""Which results a run makes, in a copy of the project with tiny scenes."""

import os
import re
import shutil

from project import ROOT, SHIPPED, fresh_tree
from runs import FIG3, contents, rows

from pipeline.config import build_specs, load
from pipeline.config.schema import study


def test_a_fresh_clone_computes_everything_whatever_the_file_times(finished):
    table = rows((finished.path / "first run").read_text())
    assert set(table.values()) == {"recomputed"}
    assert {f"paper_figures/{name}" for name in finished.published()} == set(table)
    assert b"committed" not in contents(finished).values()


def test_a_first_run_is_short_and_each_step_names_its_scene(finished):
    output = (finished.path / "first run").read_text().splitlines()
    steps = [line.split() for line in output if re.search(r" \d+ of \d+$", line)]
    assert {step[0] for step in steps} == set(finished.document()["scenes"])
    assert [step[-3] for step in steps] == [str(i + 1) for i in range(len(steps))]
    assert {step[-1] for step in steps} == {str(len(steps))}
    assert len(output) + 2 <= 60  # with the lines of the installation
    # steps, an empty line, the header, the files: nothing else
    assert len(output) == len(steps) + 2 + len(finished.published())


def test_a_plan_is_in_our_words_and_makes_nothing(done):
    done.edit("fig2", energy=0.0098)
    done.edit("fig7", records=5)
    before = done.published()
    result = done.run("-n", "--cores", "1")
    assert result.returncode == 0
    assert result.stdout == (
        "fig2: energy 0.01 -> 0.0098: orbits, drawing\nfig7: records 6 -> 5: lyapunov, drawing\n"
    )
    assert done.run("fig7", "-n").stdout == "fig7: records 6 -> 5: lyapunov, drawing\n"
    assert done.run("fig3", "-n").stdout == "nothing to make\n"
    assert done.published() == before


def test_figures_by_name(done):
    for name in ("fig3.png", "fig3.svg", "fig7.png"):
        (done.path / "results" / "paper" / "figures" / name).unlink()
    made = rows(done.run("fig3", "fig4").stdout)
    again = {"paper_figures/fig3.png", "paper_figures/fig3.svg"}
    assert {file for file in made if made[file] == "recomputed"} == again
    assert set(made) - again == {"paper_figures/fig4.png", "paper_figures/fig4.svg"}
    assert not (done.path / "results" / "paper" / "figures" / "fig7.png").exists()
    assert set(rows(done.run("all", "fig3").stdout)) == {
        f"paper_figures/{name}" for name in done.published()
    }


def test_the_closing_table_and_the_list_say_what_is_committed(accepted, tmp_path):
    done = accepted.copy(tmp_path / "done")
    done.edit("fig7", records=5)
    output = done.run().stdout
    state = dict(re.findall(r"(paper_figures/\S+) .* (identical|differs)$", output, re.MULTILINE))
    assert set(state) == {
        f"paper_figures/{f}" for f in done.published() if "." in f and f != "MANIFEST.json"
    }
    differs = {file for file in state if state[file] == "differs"}
    assert differs == {"paper_figures/fig7.png", "paper_figures/fig7.svg"}
    done.edit("fig3", duration=15)
    listed = done.run("list").stdout
    assert "fig2  paper_figures/fig2.png  identical to the committed one\n" in listed
    assert "fig3  paper_figures/fig3.png  stale: duration 16 -> 15\n" in listed
    assert "fig7  paper_figures/fig7.png  not the committed one\n" in listed


def test_data_that_keep_their_bytes_have_nothing_drawn_from_them(done):
    """An edit of a source leaves the numbers as they are; another edit changes them."""
    module = done.path / "src" / "pseudorigid" / "dynamics" / "motion.py"
    text = module.read_text()
    module.write_text(f"{text}\n_UNUSED = 1\n")
    plan = "fig3: its source changed: motion.py: motion; perhaps drawing\n"
    assert done.run("fig3", "-n").stdout == plan
    drawings = [*(done.path / "results" / "paper" / "figures").glob("fig3.*")]
    before = [file.stat().st_ino for file in drawings]
    output = done.run("fig3").stdout
    steps = re.findall(r"^fig3  +(\w+).* (as it was|s) +\d+ of \d+$", output, re.MULTILINE)
    assert {step for step, duration in steps if duration == "s"} == {"motion"}
    assert {step for step, duration in steps if duration != "s"} == {"drawing"}
    assert set(rows(output).values()) == {"current"}
    assert [file.stat().st_ino for file in drawings] == before
    assert done.planned("paper_figures/fig3.png") == set()
    module.write_text(
        f"{text}\n_MOTION = scene_motion\n\n\n"
        "def scene_motion(*given, **fields):\n"
        "    found = _MOTION(*given, **fields)\n"
        "    return found.assign(strain=found['strain'] * 1.01)\n"
    )
    assert set(rows(done.run("fig3").stdout).values()) == {"recomputed"}


def test_a_missing_result_waits_for_inputs_that_may_keep_their_bytes(done):
    """An outdated dataset keeps its bytes, so the next one stays, and the drawing is made."""
    paper = done.path / "results" / "paper"
    module = done.path / "src/pseudorigid/dynamics/periodic.py"
    module.write_text(f"{module.read_text()}\n_UNUSED = 1\n")
    motion = (paper / "motion_fig3.nc").stat().st_ino
    (paper / "figures" / "fig3.png").unlink()
    result = done.run("fig3")
    assert result.returncode == 0, result.stdout
    assert (paper / "figures" / "fig3.png").is_file()
    assert (paper / "motion_fig3.nc").stat().st_ino == motion
    assert done.planned("paper_figures/fig3.png") == set()


def test_a_second_run_has_nothing_to_do(done):
    before = done.published()
    shutil.rmtree(done.path / ".snakemake")
    again = done.run()
    assert not list((done.path / ".snakemake" / "log").glob("*"))  # snakemake is not started
    assert set(rows(again.stdout).values()) == {"current"}
    assert done.published() == before


def test_a_fresh_clone_needs_what_a_run_makes(tree, finished):
    for file in sorted(p for p in tree.path.rglob("*") if p.is_file()):
        if "paper_figures" not in file.parts:
            os.utime(file, (0, 0))
    assert tree.planned("paper_figures/fig3.png") == FIG3
    results = (finished.path / "results").rglob("*.*")
    made = {path for path in results if path.suffix not in (".log", ".json")}
    assert tree.planned() == {str(p.relative_to(finished.path)) for p in made}


def test_each_edit_makes_again_what_uses_it_alone(done):
    """Edit a stage's field, an axis, the formats, and a module without a change of its time."""
    done.edit("fig7", impacts=61)
    other = {"limits": [-1, 17], "ticks": [0]}
    done.edit("fig3", axes={"t": other, "displacement": other})
    done.edit("fig4", formats=["png", "svg", "pdf"])
    dynamics = done.path / "src" / "pseudorigid" / "dynamics"
    (dynamics / "orbits.py").touch()
    then = (dynamics / "manifolds.py").stat()
    with (dynamics / "manifolds.py").open("a") as file:
        file.write("_EDITED = 1\n")
    os.utime(dynamics / "manifolds.py", ns=(then.st_atime_ns, then.st_mtime_ns))
    shutil.rmtree(done.path / ".snakemake")  # its memory of parameters and times
    drawings = {f"fig{number}.png" for number in (3, 5, 6, 7)}
    drawings |= {f"fig{number}.svg" for number in (3, 6, 7)} | {"fig4.pdf"}
    data = {"lyapunov_fig7.nc", "manifolds_fig5.nc", "manifolds_fig6.nc"}
    made = data | {f"figures/{name}" for name in drawings}
    assert done.planned() == {f"results/paper/{name}" for name in made}


def test_axes_that_hide_what_was_edited_are_told(done):
    done.edit("fig3", duration=30)
    line = "fig3: duration 30 lies outside axes.t.limits [0, 16]: widen them, or leave axes.t out"
    assert line in done.run("fig3", "-n").stdout.splitlines()


def test_what_was_deleted_comes_back(done):
    for name in ("fig3.png", "fig7.svg"):
        (done.path / "results" / "paper" / "figures" / name).unlink()
    artifact = done.path / "results" / "paper" / "periodic_fig3.nc"
    content = artifact.read_bytes()
    artifact.unlink()
    before = contents(done)
    # Settings in a user's shell do not reach a run; numba would refuse its ones.
    hostile = {"MPLBACKEND": "no such backend", "SNAKEMAKE_PROFILE": "none such"}
    hostile |= {"NUMBA_NUM_THREADS": "0", "NUMBA_OPT": "none", "NUMBA_THREADING_LAYER": "none"}
    single = done.run("paper_figures/fig3.png", "paper_figures/fig7.svg", **hostile)
    assert single.returncode == 0, single.stdout
    made = {f"paper_figures/{name}": "recomputed" for name in ("fig3.png", "fig7.svg")}
    assert rows(single.stdout) == made
    assert artifact.read_bytes() == content
    assert contents(done) == before


def test_a_published_figure_that_is_not_its_drawing_is_published_again(done):
    before = contents(done)
    for name in ("fig3.png", "fig7.svg"):
        figure = done.path / "paper_figures" / name
        figure.write_text("x")
        os.utime(figure, (4e9, 4e9))
    single = done.run("paper_figures/fig3.png")
    assert rows(single.stdout) == {"paper_figures/fig3.png": "current"}
    assert contents(done) == before | {"fig7.svg": b"x"}
    everything = done.run()
    assert set(rows(everything.stdout).values()) == {"current"}
    assert contents(done) == before


def test_results_alone_are_enough_and_times_say_nothing(done, tmp_path):
    """A fresh clone with results from a cache makes only what differs, at any times of files."""
    fresh = fresh_tree(tmp_path / "elsewhere")
    shutil.copytree(done.path / "results", fresh.path / "results", copy_function=shutil.copy)
    for i, file in enumerate(sorted(fresh.path.glob("src/**/*.py"))):
        os.utime(file, (4e9, 4e9) if i % 2 else (0, 0))
    fresh.edit("fig7", records=5)
    result = fresh.run()
    assert result.returncode == 0, result.stdout
    table = rows(result.stdout)
    again = {f"paper_figures/fig7.{extension}" for extension in ("png", "svg")}
    assert {file for file, state in table.items() if state == "recomputed"} == again
    same = contents(done).items() - {(n, b) for n, b in contents(done).items() if "fig7" in n}
    assert same <= contents(fresh).items()


def test_a_figure_that_cannot_exist_is_left_out_and_the_rest_is_drawn(done):
    before = contents(done)
    done.edit("fig3", type="inverse hyperbolic")
    done.edit("fig7", records=5)
    result = done.run()
    assert result.returncode == 1
    step, *states = [line for line in result.stdout.splitlines() if line.startswith("fig3")]
    words = "no inverse hyperbolic orbit of period 1 at energy 0.01 (found: elliptic)"
    assert step.endswith(f"not made: {words}")
    assert len(states) == 2
    assert all(line.endswith(f"cannot exist: {words}") for line in states)
    assert "fig3    periodic" not in done.run("fig3").stdout  # it is not tried again
    table = rows(result.stdout)
    assert {file for file in table if table[file] == "recomputed"} == {
        "paper_figures/fig7.png",
        "paper_figures/fig7.svg",
    }
    assert len(table) == len(before) - 2


def test_long_jobs_begin_first_and_only_two_parts_of_the_study_run_alone(tree):
    parts = [f"results/study/{part}.nc" for part in (*study.FIXED, *study.MEASURED)]
    output = tree.run(*parts, "-n", "--cores", "3", "--quiet", "host").stdout
    jobs = {
        re.search(r"output: results/(\S+)\.nc ", job)[1]: job
        for job in re.split(r"^rule ", output, flags=re.MULTILINE)[1:]
    }
    alone = {name for name, job in jobs.items() if "threads: 3" in job}
    assert alone == {"study/verdicts", "study/work_all"}
    assert len(jobs) > len(parts)
    assert "priority: 190" in jobs["study/verdicts"]
    assert "priority: 90" in jobs["study/needs"]
    assert "priority: 90" in jobs["paper/manifolds_fig5"]
    assert "priority" not in jobs["study/edges"]


def test_the_long_jobs_are_jobs():
    rules = (ROOT / "workflow" / "rules" / "results.smk").read_text(encoding="utf-8")
    long = re.findall(r'"(results/\S+)": \d+,', rules)
    assert len(long) > 5
    assert set(long) <= set(build_specs.of_all(load(SHIPPED)))
