"""Which results a run makes, in a copy of the project with tiny scenes."""

import os
import re
import shutil

from helpers.runs import FIG3, contents, rows
from pipeline.cli.table import WHAT_TO_DO

PAPER = "results/paper"


def published(*names):
    return {f"paper_figures/{name}" for name in names}


def recomputed(output):
    return {file for file, state in rows(output).items() if state == "recomputed"}


def test_a_fresh_clone_computes_everything_whatever_the_file_times(tree, finished):
    for file in sorted(p for p in tree.path.rglob("*") if p.is_file()):
        if "paper_figures" not in file.parts:
            os.utime(file, (0, 0))
    assert tree.planned("paper_figures/fig3.png") == FIG3
    made = {path for path in (finished.path / PAPER).rglob("*.*") if path.suffix != ".json"}
    results = {str(path.relative_to(finished.path)) for path in made if path.suffix != ".log"}
    assert tree.planned() == results
    output = (finished.path / "first run").read_text()
    assert set(rows(output)) == recomputed(output) == published(*finished.published())
    assert b"committed" not in contents(finished).values()


def test_a_plan_is_in_our_words_and_makes_nothing(done):
    done.edit("fig2", energy=0.0098)
    done.edit("fig7", records=5)
    before = done.published()
    fig7 = "fig7: records 6 -> 5: lyapunov, drawing\n"
    result = done.run("-n", "--cores", "1")
    assert result.returncode == 0
    assert result.stdout == f"fig2: energy 0.01 -> 0.0098: orbits, drawing\n{fig7}"
    assert done.run("fig7", "-n").stdout == fig7 and done.published() == before


def test_a_second_run_has_nothing_to_do_and_each_says_what_axes_hide(done):
    done.edit("fig2", energy=0.03)
    done.edit("fig3", duration=30)
    lines = [
        "fig2: axes.x.limits [-0.2, 0.6] cut the energy surface at E = 0.03, and hide ",
        "fig2: axes.udot.limits [-0.2, 0.4] cut the energy surface at E = 0.03, and hide ",
        "fig3: axes.t.limits [0, 16] hide 46.7 % of the lines: widen them to [0.0, 30.0], or ",
    ]
    said = done.run("fig2", "fig3").stdout
    for line, start in zip(said.splitlines()[-3:], lines, strict=True):
        assert line.startswith(start)
    before = done.published()
    shutil.rmtree(done.path / ".snakemake")
    again = done.run()
    assert set(rows(again.stdout).values()) == {"current"} and done.published() == before
    assert not list((done.path / ".snakemake" / "log").glob("*"))  # snakemake is not started
    assert again.stdout.splitlines()[-4:-1] == said.splitlines()[-3:]  # the last is Figure 7's
    assert sum(" axes." in line for line in again.stdout.splitlines()) == 4


def test_each_edit_makes_again_what_uses_it_alone(done):
    """Edit a stage's field, an axis, the formats, and a module without a change of its time."""
    done.edit("fig7", impacts=61)
    other = {"limits": [-1, 17], "ticks": [0]}
    done.edit("fig3", axes={"t": other, "displacement": other})
    done.edit("fig4", formats=["png", "svg", "pdf"])
    dynamics = done.path / "src" / "pseudorigid" / "dynamics"
    (dynamics / "orbits.py").touch()
    then = (dynamics / "manifolds.py").stat()
    done.append("pseudorigid/dynamics/manifolds.py")
    os.utime(dynamics / "manifolds.py", ns=(then.st_atime_ns, then.st_mtime_ns))
    shutil.rmtree(done.path / ".snakemake")  # its memory of parameters and times
    drawings = {f"fig{number}.png" for number in (3, 5, 6, 7)}
    drawings |= {f"fig{number}.svg" for number in (3, 5, 6, 7)} | {"fig4.pdf"}
    data = {"lyapunov_fig7.nc", "manifolds_fig5.nc", "manifolds_fig6.nc"}
    made = data | {f"figures/{name}" for name in drawings}
    assert done.planned() == {f"{PAPER}/{name}" for name in made}


def test_results_alone_are_enough_and_only_what_differs_is_made(edited, accepted):
    output = (edited.path / "output").read_text()
    again = published("fig3.png", "fig3.svg", "fig4.png", "fig4.svg", "fig7.png", "fig7.svg")
    again |= published("fig2.png", "fig2.svg", "fig8.svg")  # whose data are made again
    assert recomputed(output) == again | published("again.png", "fig8.png")
    same = {name for name in contents(accepted) if not re.search("fig[347]|MANIFEST", name)}
    assert len(same) > 3
    assert all(contents(edited)[name] == contents(accepted)[name] for name in same)


def test_a_plan_names_what_an_edit_of_a_source_outdates(edited):
    words = "made by other code than this tree's: src/pseudorigid/dynamics/orbits.py differs"
    plan = (edited.path / "plan").read_text().splitlines()
    assert {f"{name}: {words}: orbits, drawing" for name in ("fig2", "fig8")} <= {*plan}
    assert edited.planned("paper_figures/fig2.png", "paper_figures/fig8.png") == set()


def test_the_closing_table_and_the_list_say_what_is_committed(edited):
    output = (edited.path / "output").read_text()
    row = r"^(fig\d) +(?:png|svg) .* (identical|differs)$"
    state = dict(re.findall(row, output, re.MULTILINE))
    assert {"fig2", "fig8"} < set(state)
    assert {name for name in state if state[name] == "differs"} == {"fig3", "fig4", "fig7"}
    assert "paper_figures/fig9.png: no scene makes it: delete it, or put" in output
    listed = edited.run("list").stdout
    assert WHAT_TO_DO in output and listed.count(WHAT_TO_DO) == 1
    assert "./reproduce: paper_figures/" in listed.splitlines()
    row = r"^(fig[27]) +png svg +(identical|differs)$"
    assert re.findall(row, listed, re.M) == [("fig2", "identical"), ("fig7", "differs")]


def test_a_figure_that_cannot_exist_is_left_out(edited):
    words = "no inverse hyperbolic orbit of period 1 at energy 0.01 (found: elliptic)"
    words += "; periods up to 12 with one: 6, 7, 8, 9"
    lines = (edited.path / "output").read_text().splitlines()
    step, row = [line for line in lines if re.match("absent .*(not made|cannot exist)", line)]
    assert step.endswith(f"not made: {words}") and row.endswith("cannot exist")
    assert f"paper_figures/absent.png: cannot exist: {words}" in lines
    again = edited.run("absent")
    assert again.returncode == 1 and "absent  periodic" not in again.stdout  # it is not tried again
