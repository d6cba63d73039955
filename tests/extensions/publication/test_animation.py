"""The moving picture: the ball's true motion, and a GIF that repeats."""

from io import BytesIO

import numpy as np
import pytest
from PIL import Image, ImageSequence

from extensions.publication.figures.animation import draw, moving
from extensions.publication.frames import scene_frames
from helpers.project import ROOT
from helpers.readable import assert_readable
from pipeline.checks import manifest
from pipeline.records.files import FileError
from pipeline.records.pictures import drawing_hash, picture_difference
from pseudorigid import Ball, motion
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas.render import gif, pixels

BALL, STARTS, IMPACTS, FRAMES = Ball(k=0.2, g=0.04), [0.3, -0.4], [30, 50], [4, 5]
SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01}


@pytest.fixture(scope="module")
def data():
    orbits = scene_orbits(BALL, 0.01, STARTS, IMPACTS)
    return orbits, scene_frames(BALL, 0.01, orbits, FRAMES)


@pytest.fixture(scope="module")
def content(data):
    return gif(moving(SCENE, *data))


def test_the_ball_is_where_the_motion_from_the_first_impact_has_it(data):
    """The times of the frames are not kept: they are found again from the steps' constant ratio."""
    orbits, frames = data
    first = [float(orbits[name][0]) for name in ("x", "xdot", "udot")]
    impact_t = np.append(0.0, np.cumsum(orbits["tau"].values[1:30]))
    moved = motion(BALL, first, float(impact_t[-1]))
    assert frames["impacts"][:4].values[[0, -1]].tolist() == [1, 30]
    assert frames["impacts"][4:].values[[0, -1]].tolist() == [1, 50]
    for i in range(4):
        position, strain = (float(frames[name][i]) for name in ("position", "strain"))
        here = int(frames["impacts"][i]) - 1
        until = impact_t[here + 1] if here < 29 else np.inf
        during = (moved["t"] >= impact_t[here] - 1e-9) & (moved["t"] <= until + 1e-9)
        away = np.hypot(moved["position"] - position, moved["strain"] - strain).where(during)
        assert float(away.min()) < 0.01


def test_steps_in_time_grow_from_half_a_unit_to_the_last_impact():
    from extensions.publication.frames import _growing

    steps = np.diff(_growing(200.0, 12))
    assert steps[0] == 0.5 and steps.sum() == pytest.approx(200.0, rel=1e-14)
    ratio = steps[1:] / steps[:-1]
    assert ratio == pytest.approx(np.full(10, ratio[0]), rel=1e-9) and ratio[0] > 1
    assert np.diff(_growing(1.0, 5)) == pytest.approx(np.full(4, 0.25))


@pytest.mark.slow
def test_the_gif_repeats_on_white_and_has_the_same_bytes_twice(data, content):
    assert gif(moving(SCENE, *data)) == content
    image = Image.open(BytesIO(content))
    shown = [np.asarray(frame.convert("RGB")) for frame in ImageSequence.Iterator(image)]
    seconds = [frame.info["duration"] / 1000 for frame in ImageSequence.Iterator(image)]
    assert image.info["loop"] == 0 and sum(seconds) == pytest.approx(0.08 * (10 + 10 + 6))
    assert all((frame[:5] == 255).all() for frame in shown)
    still = pixels(draw(SCENE, *data)).astype(int)
    assert np.abs(shown[8].astype(int) - still).mean() < 1
    last, first = shown[-1].astype(int), shown[0].astype(int)
    assert np.abs(last - first).mean() < 0.5 * np.abs(shown[-7].astype(int) - first).mean()


def test_it_says_what_is_seen_and_that_it_begins_again(data):
    orbits, frames = data
    assert orbits["type"].values.tolist() == ["chaotic", "regular"]
    said = [[text.get_text() for text in figure.texts] for figure in moving(SCENE, orbits, frames)]
    assert all("one impact, one dot" in texts for texts in said)
    assert all("Ball 1 of 2: chaotic, its dots fill a region" in texts for texts in said[:4])
    regular = "New ball, 2 of 2: regular, its dots form closed curves"
    assert all(regular in texts for texts in said[4:9])
    assert len(said) == 10 and "It begins again." in said[9] and regular not in said[9]


def test_its_still_can_be_read(data):
    assert_readable(draw(SCENE, *data))


def test_the_manifest_names_what_encodes_a_gif_beside_what_decides_all_pictures():
    committed = manifest.read(ROOT, "more_figures/publication")
    gif, png = (
        manifest.record_of(committed, f"results/publication/figures/bounce.{suffix}")["environment"]
        for suffix in ("gif", "png")
    )
    assert gif.keys() - png.keys() == {"pillow"} and png.keys() <= gif.keys()


@pytest.mark.slow
def test_two_gifs_are_compared_frame_by_frame(content, data, tmp_path):
    paths = [tmp_path / name for name in ("a.gif", "b.gif", "c.gif")]
    orbits, frames = data
    other = frames.assign(strain=frames["strain"].where(frames["frame"] != 4, 0.0))
    contents = content, gif(moving(SCENE, orbits, other)), content[:900]
    for path, written in zip(paths, contents, strict=True):
        path.write_bytes(written)
    assert drawing_hash(paths[0]) != drawing_hash(paths[1])
    image = tmp_path / "difference.png"
    words = picture_difference(paths[0], paths[1], image)
    assert words.endswith(f" pixels differ: see {image}") and image.is_file()
    with pytest.raises(FileError, match="damaged"):
        drawing_hash(paths[2])
