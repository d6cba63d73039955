"""Variants: what is overridden and shared, what cannot exist, and the copy scaled by two."""

import copy
import os
import signal
import subprocess
import time

import numpy as np
import pytest
import yaml
from conftest import ROOT, fresh_tree

from pipeline import config
from pipeline.records.artifacts import load
from pseudorigid.figures.axes.limits import of_data

BASE = yaml.safe_load((ROOT / "config.yaml").read_text())
LENGTHS = {"x", "xdot", "udot", "position", "strain", "impact_position"}


def with_variants(**variants):
    """The committed document with these variants instead of its own, parsed and checked."""
    return config.check(copy.deepcopy(BASE) | {"variants": variants})["variants"]


def complaint(name, block):
    with pytest.raises(config.ConfigError) as raised:
        with_variants(**{name: block})
    line = str(raised.value)
    assert "\n" not in line
    return line


# ---- the config ----


def test_the_paper_comes_first_and_variants_are_complete():
    variants = with_variants(thin={"ball": {"k": 0.3}})
    assert list(variants) == ["paper", "thin"]
    assert variants["thin"]["fig2"]["ball"] == {"k": 0.3, "g": 0.04}
    assert variants["thin"].keys() == variants["paper"].keys() == BASE["scenes"].keys()


def test_mappings_merge_and_lists_are_replaced():
    change = {"resolution": {"bend": 20}, "starts": [0.1], "impacts": [5]}
    scene = with_variants(v={"scenes": {"fig5": change}})["v"]["fig5"]
    assert scene["resolution"] == {"distance": 0.01, "bend": 20}
    assert scene["starts"] == [0.1]
    scene = with_variants(v={"scenes": {"fig5": {"ball": {"k": 0.3}}}})["v"]["fig5"]
    assert scene["ball"] == {"k": 0.3, "g": 0.04}


def test_a_scene_s_energy_goes_before_the_variant_s():
    scenes = with_variants(v={"energy": 0.002, "scenes": {"fig8": {"energy": 0.003}}})["v"]
    assert (scenes["fig2"]["energy"], scenes["fig8"]["energy"]) == (0.002, 0.003)


@pytest.mark.parametrize(
    ("change", "scene", "kept"),
    [
        ({"energy": 0.002}, "fig2", False),
        ({"ball": {"k": 0.3}}, "fig7", False),
        ({"scale": 2}, "fig8", False),
        ({"scenes": {"fig3": {"duration": 30}}}, "fig3", False),
        ({"scenes": {"fig7": {"impacts": 1000}}}, "fig7", False),
        ({"scenes": {"fig6": {"window": {"x": [-0.1, 0.1]}}}}, "fig6", False),
        ({"scenes": {"fig2": {"impacts": [9] * 8}}}, "fig2", True),
        ({"scenes": {"fig6": {"length": 0.5}}}, "fig6", True),
        ({"energy": 0.01}, "fig2", True),
    ],
)
def test_the_paper_s_axes_are_left_where_they_no_longer_fit(change, scene, kept):
    assert ("axes" in with_variants(v=change)["v"][scene]) == kept


def test_a_variant_s_own_axes_stay():
    axes = {"t": {"limits": [0, 8], "ticks": [0, 8]}}
    change = {"energy": 0.002, "scenes": {"fig3": {"axes": axes}}}
    assert with_variants(v=change)["v"]["fig3"]["axes"] == axes


@pytest.mark.parametrize(
    ("name", "block", "parts"),
    [
        ("a/b", {"energy": 0.002}, ["variants: 'a/b'", "letters, digits, - and _"]),
        ("-n", {"energy": 0.002}, ["variants: '-n'", "not begin with -"]),
        ("a b", {"energy": 0.002}, ["variants: 'a b'"]),
        ("", {"energy": 0.002}, ["variants: ''"]),
        ("paper", {"energy": 0.002}, ["variants: 'paper'", "other than paper, study"]),
        ("study", {"energy": 0.002}, ["variants: 'study'"]),
        ("v", None, ["variants.v: nothing", "ball, energy, method, scenes and"]),
        ("v", {}, ["variants.v: {}"]),
        ("v", {"bal": {"k": 0.3}}, ["variants.v.bal: unknown key: did you mean ball?"]),
        ("v", {"ball": {"q": 1}}, ["variants.v.ball.q: unknown key", "k, g"]),
        ("v", {"ball": {"k": 1.5}}, ["variants.v.ball.k: 1.5", "0 < k <= 1"]),
        ("v", {"ball": {"g": 0.3}}, ["variants.v.ball.g: 0.3", "0 < g < k = 0.2"]),
        ("v", {"ball": {"k": 0.01}}, ["variants.v.ball.g: 0.04", "0 < g < k = 0.01"]),
        ("v", {"energy": 0.06}, ["variants.v.energy: 0.06", "below k/2 - g = 0.06"]),
        ("v", {"energy": "1e-3"}, ["variants.v.energy: '1e-3'", "write 0.001"]),
        ("v", {"ball": {"g": 0.095}}, ["variants.v.scenes.fig2.energy: 0.01", "k/2 - g = 0.005"]),
        ("v", {"scale": 0}, ["variants.v.scale: 0", "every length"]),
        ("v", {"scenes": {"figg2": {}}}, ["variants.v.scenes.figg2: no scene", "mean fig2?"]),
        ("v", {"scenes": {"fig2": 3}}, ["variants.v.scenes.fig2: 3", "a mapping"]),
        ("v", {"scenes": {"fig2": {"energie": 1}}}, ["v.scenes.fig2.energie: unknown", "energy?"]),
        ("v", {"scenes": {"fig2": {"energy": 1}}}, ["v.scenes.fig2.energy: 1 ", "k/2 - g"]),
        ("v", {"scenes": {"fig2": {"starts": [2]}}}, ["variants.v.scenes.fig2.starts[0]: 2"]),
        ("v", {"scenes": {"fig2": {"sea": [8]}}}, ["variants.v.scenes.fig2.sea: 8"]),
        ("v", {"scenes": {"fig5": {"resolution": {"bend": 0}}}}, ["fig5.resolution.bend: 0"]),
        ("v", {"scenes": {"fig3": {"picture": "tangle"}}}, ["fig3.picture: 'tangle'", "motion"]),
    ],
)
def test_a_bad_variant_is_refused_in_one_line(name, block, parts):
    line = complaint(name, block)
    for part in parts:
        assert part in line


def test_equal_stages_of_variants_are_computed_once():
    variants = with_variants(
        first={"scenes": {"fig8": {"impacts": [9] * 6}}},
        second={"scenes": {"fig8": {"impacts": [9] * 6, "sea": []}}},
    )
    serves = config.served(variants)
    assert serves["second", "fig8", "orbits"] == "results/first/orbits_fig8.nc"
    assert serves["second", "fig2", "orbits"] == "results/paper/orbits_fig2.nc"
    assert serves["second", "fig4", "periodic"] == "results/paper/periodic_fig4.nc"


def test_a_scale_is_exact():
    scenes = with_variants(double={"scale": 2}, triple={"scale": 3})
    for name, block in scenes["double"].items():
        paper = scenes["paper"][name]
        assert block["ball"] == {"k": 0.2, "g": 2.0 * paper["ball"]["g"]}
        assert block["energy"] == 4.0 * paper["energy"]
    assert scenes["triple"]["fig2"]["energy"] == 0.09  # of the decimals: 9.0 * 0.01 is more


# ---- axes of the data ----


@pytest.mark.parametrize("low", [-0.37, 0.0, 1e-9, 12345.6])
@pytest.mark.parametrize("span", [1e-12, 3e-4, 0.99, 1.0, 7e5])
@pytest.mark.parametrize("margin", [0.0, 0.08])
def test_axes_hold_the_data_and_have_ticks(low, span, margin):
    axis = of_data(np.array([low, low + span, np.nan]), margin=margin)
    start, end = axis["limits"]
    assert start <= low
    assert low + span <= end
    if span > 1e-9 * abs(low):
        assert end - start <= 1.6 * span
    assert 2 <= len(axis["ticks"]) <= 8
    assert all(start <= tick <= end for tick in axis["ticks"])
    assert axis["ticks"] == sorted(set(axis["ticks"]))


def test_limits_and_ticks_are_round_numbers():
    axis = of_data(np.array([-0.174, 0.573]), most=6)
    assert axis == {"limits": [-0.2, 0.6], "ticks": [-0.2, 0.0, 0.2, 0.4, 0.6]}
    assert of_data([0, 200000], room=0.0)["limits"] == [0, 200000]


# ---- the workflow ----


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A copy with four small scenes in which the paper and two variants were made."""
    tree = fresh_tree(tmp_path_factory.mktemp("variants") / "a folder with spaces")
    path = tree.path / "config.yaml"
    document = yaml.safe_load(path.read_text())
    document["scenes"] = {
        name: block | {"formats": ["png"]}
        for name, block in document["scenes"].items()
        if name in ("fig4", "fig5", "fig6", "fig7")
    }
    document["variants"] = {
        "thin": {"ball": {"k": 0.3333333333333333}},
        "doubled": {"scale": 2},
    }
    path.write_text(yaml.safe_dump(document, sort_keys=False))
    tree.original[path] = path.read_bytes()
    tree.runs = {}
    for name in ("doubled", "thin"):
        tree.runs[name] = tree.run("variant", name)
        assert tree.runs[name].returncode == 0, tree.runs[name].stdout
    paper = tree.run()
    assert paper.returncode == 0, paper.stdout
    return tree


@pytest.fixture
def done(made):
    yield made
    made.restore()


def edit(tree, name, block):
    path = tree.path / "config.yaml"
    document = yaml.safe_load(path.read_text())
    document["variants"][name] = block
    path.write_text(yaml.safe_dump(document, sort_keys=False))


def figures_of(tree, name):
    return {path.name for path in (tree.path / "results" / name / "figures").iterdir()}


@pytest.mark.parametrize(
    "name",
    [
        "orbits_fig5",
        "periodic_fig4",
        "motion_fig4",
        "manifolds_fig5",
        "manifolds_fig6",
        "lyapunov_fig7",
    ],
)
def test_the_copy_scaled_by_two_is_equal_in_every_bit(made, name):
    paper, doubled = (
        load(made.path / "results" / variant / f"{name}.nc") for variant in ("paper", "doubled")
    )
    assert doubled.attrs["g"] == 2.0 * paper.attrs["g"]
    assert doubled.attrs["energy"] == 4.0 * paper.attrs["energy"]
    assert set(paper.variables) == set(doubled.variables)
    for key, variable in paper.variables.items():
        ours = doubled.variables[key].values
        scaled = variable.values * 2.0 if key in LENGTHS else variable.values
        assert ours.dtype == scaled.dtype
        assert ours.shape == scaled.shape
        if ours.dtype.kind == "O":
            assert ours.tolist() == scaled.tolist()
        else:
            assert ours.tobytes() == scaled.tobytes(), key
    lengths = {"window_x", "window_xdot", "point_x", "point_xdot"}
    for key in set(paper.attrs) - {"g", "energy", "config"}:
        value = np.asarray(paper.attrs[key])
        assert np.array_equal(doubled.attrs[key], value * 2.0 if key in lengths else value), key


def test_a_figure_that_cannot_exist_is_named_and_the_rest_is_drawn(made):
    assert figures_of(made, "thin") == {"fig5.png", "fig6.png", "fig7.png"}
    assert figures_of(made, "doubled") == {"fig4.png", "fig5.png", "fig6.png", "fig7.png"}
    last = made.runs["thin"].stdout.splitlines()[-1]
    assert last.startswith("fig4  cannot exist: no elliptic orbit of period 6 at energy 0.01")


def test_a_second_run_has_nothing_to_do(done):
    again = done.run("variant", "thin")
    assert again.returncode == 0
    assert "Nothing to be done" in again.stdout
    assert again.stdout.count("current") == 3
    assert "fig4  cannot exist: " in again.stdout


def test_a_variant_s_figures_are_not_published(made):
    published = {name for name in made.published() if made.published()[name][0] != b"committed"}
    assert published == {"fig4.png", "fig5.png", "fig6.png", "fig7.png"}
    data = (made.path / "results" / "paper" / "figures" / "fig7.png").read_bytes()
    assert (made.path / "paper_figures" / "fig7.png").read_bytes() == data


def test_a_deleted_file_of_a_variant_comes_back(done):
    figure = done.path / "results" / "thin" / "figures" / "fig7.png"
    data = done.path / "results" / "thin" / "lyapunov_fig7.nc"
    before = figure.read_bytes(), data.read_bytes()
    figure.unlink()
    data.unlink()
    assert done.run("variant", "thin").returncode == 0
    assert (figure.read_bytes(), data.read_bytes()) == before


def test_a_figure_that_can_no_longer_exist_is_removed(done):
    edit(done, "doubled", {"scale": 2, "scenes": {"fig4": {"period": 5}}})
    assert "fig4.png" in figures_of(done, "doubled")
    result = done.run("variant", "doubled")
    assert result.returncode == 0, result.stdout
    assert result.stdout.splitlines()[-1].startswith("fig4  cannot exist: no elliptic orbit")
    assert figures_of(done, "doubled") == {"fig5.png", "fig6.png", "fig7.png"}
    done.restore()
    assert done.run("variant", "doubled").returncode == 0
    assert "fig4.png" in figures_of(done, "doubled")


def test_what_is_shared_is_not_computed_again(done):
    edit(done, "more", {"scenes": {"fig7": {"impacts": 50}}})
    before = {p: p.stat().st_mtime_ns for p in (done.path / "results" / "paper").glob("*.nc")}
    result = done.run("variant", "more")
    assert result.returncode == 0, result.stdout
    made = {path.name for path in (done.path / "results" / "more").glob("*.nc")}
    assert made == {"lyapunov_fig7.nc"}
    assert {p: p.stat().st_mtime_ns for p in before} == before
    fresh = (done.path / "results" / "more" / "figures" / "fig5.png").read_bytes()
    assert fresh == (done.path / "results" / "paper" / "figures" / "fig5.png").read_bytes()


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (
            ("thinn",),
            "reproduce: no variant thinn: did you mean thin? config.yaml has thin, doubled",
        ),
        (("a/b",), "reproduce: no variant a/b: config.yaml has thin, doubled"),
        (("paper",), "reproduce: no variant paper: config.yaml has thin, doubled"),
        ((), "reproduce: variant needs a name: config.yaml has thin, doubled"),
        (("-n",), "reproduce: variant needs a name: config.yaml has thin, doubled"),
    ],
)
def test_a_name_that_is_no_variant_is_one_line(made, words, line):
    result = made.run("variant", *words)
    assert (result.returncode, result.stdout) == (1, line + "\n")


def test_a_bad_variant_starts_nothing_whatever_is_asked_for(done):
    edit(done, "bad", {"energy": 0.9})
    line = "config.yaml: variants.bad.energy: 0.9 is not allowed: expected a number below k/2 - g"
    for words in ((), ("variant", "thin"), ("variant", "bad"), ("verify",)):
        result = done.run(*words)
        assert result.returncode == 1
        assert result.stdout.startswith(line)
        assert result.stdout.count("\n") == 1


def test_damaged_findings_and_drawings_are_made_again(done):
    absent = done.path / "results" / "thin" / "absent.json"
    drawing = next((done.path / "results" / "thin" / "figures").glob("*.png"))
    before = absent.read_bytes(), drawing.read_bytes()
    absent.write_text("{")
    drawing.write_bytes(before[1][:200])
    result = done.run("variant", "thin")
    assert result.returncode == 0, result.stdout
    assert (absent.read_bytes(), drawing.read_bytes()) == before
    assert f"{drawing.name}: changed after it was made, made again" in result.stdout


def test_a_damaged_artifact_is_no_absent_orbit(done):
    artifact = done.path / "results" / "thin" / "periodic_fig4.nc"
    whole, status = artifact.read_bytes(), artifact.stat()
    artifact.write_bytes(whole[:5000])
    result = done.run("variant", "thin")
    assert result.returncode == 1
    assert "damaged" in result.stdout.splitlines()[-1]
    assert "Traceback" not in result.stdout
    artifact.write_bytes(whole)
    os.utime(artifact, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert done.run("variant", "thin").returncode == 0


@pytest.mark.slow
def test_a_killed_run_is_taken_up_again(done):
    folder = done.path / "results" / "thin"
    before = {path.name: path.read_bytes() for path in (folder / "figures").iterdir()}
    saved = done.path / "saved"
    folder.rename(saved)
    run = subprocess.Popen(
        done.command("variant", "thin"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        for _ in range(1200):
            if list(folder.glob("figures/*.png")):
                break
            time.sleep(0.05)
        assert run.poll() is None
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        again = done.run("variant", "thin")
        assert again.returncode == 0, again.stdout
        assert {path.name: path.read_bytes() for path in (folder / "figures").iterdir()} == before
    finally:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
