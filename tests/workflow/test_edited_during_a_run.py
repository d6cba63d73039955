"""Files that change during a run are not recorded as what made its results."""

import pytest

DRAWING = "results/paper/figures/fig3.png"
AGAIN = "changed during the run; run ./reproduce again"
STYLE = "src/pseudorigid/figures/canvas/style.py"


def plant(tree, kind, code):
    """Have the drawings of a kind run a line of code when their module is loaded, by the job."""
    with (tree.path / f"src/paper/figures/{kind}.py").open("a") as file:
        file.write(f"import pathlib; root = pathlib.Path({str(tree.path)!r}); {code}\n")


def append(path):
    """Return code that edits a file."""
    return f"open(root / {path!r}, 'a').write('_UNUSED = 1\\n')"


@pytest.mark.slow
def test_changes_of_data_config_and_an_edit_that_is_undone_are_reported(done):
    """A job loads an edited file, which was loaded before it was forked; the edit is undone."""
    data, edited = "results/paper/orbits_fig2.nc", "src/pseudorigid/figures/edited.py"
    plant(done, "portrait", append(data))
    (done.path / edited).write_text("VALUE = 1\n")
    undone = f"p = root / {edited!r}; p.write_text('VALUE = 2\\n'); "
    undone += "from pseudorigid.figures import edited; p.write_text('VALUE = 1\\n')"
    plant(done, "motion", undone)
    plant(done, "exponents", append("config.yaml").replace("_UNUSED = 1", "# edited"))
    drawings = ("fig2.png", "fig3.png", "fig7.png")
    result = done.run(*(f"paper_figures/{name}" for name in drawings))
    assert result.returncode == 1 and "Traceback" not in result.stdout
    rows = {line.split()[0]: line for line in result.stdout.splitlines() if " kB  " in line}
    assert f"paper_figures/fig2.png: not made: {data} {AGAIN}" in result.stdout
    assert f"paper_figures/fig3.png: not made: {edited} {AGAIN}" in result.stdout
    assert " recomputed " in rows["fig7"]
    assert result.stdout.splitlines()[-1] == f"reproduce: config.yaml {AGAIN}"


@pytest.mark.slow
def test_what_was_drawn_before_an_edit_is_not_called_current(done):
    """The process that forks jobs has loaded the edited file beforehand."""
    for file in (done.path / DRAWING).parent.glob("fig3.*"):
        file.unlink()
    plant(done, "motion", f"[*root.glob('results/paper/figures/fig3.*')] and {append(STYLE)}")
    result = done.run("fig3", "--cores", "1")
    assert result.returncode == 1
    states = sorted(
        line.partition(": ")[2]
        for line in result.stdout.splitlines()
        if line.startswith("paper_figures/fig3.")
    )
    assert states == [
        f"not current: made by other code than this tree's: {STYLE} differs",
        f"not made: {STYLE} {AGAIN}",
    ]
