"""Archives, records and manifests that somebody else wrote are refused or harmless."""

import gzip
import hashlib
import json
import subprocess
import tarfile
from contextlib import suppress

import pytest
from hypothesis import given, settings

from extensions.publication import archive
from helpers.parts.archives import DATA, against, forge
from helpers.random_documents import FUZZ, JSON, edited
from helpers.slowly import slowly
from helpers.verdicts import accepting, verified
from pipeline import config
from pipeline.checks import manifest
from pipeline.checks.verify import verify
from pipeline.records.files import FileError
from pipeline.records.provenance import Freshness, log_path, record_path

DRAWING = "results/paper/figures/fig3.png"
FIG3 = "paper_figures/fig3.png"


# ---- archives ----


def entry(name, data=b"x", kind=tarfile.REGTYPE, form=tarfile.USTAR_FORMAT, size=None):
    """Return the bytes of one entry of a tar."""
    about = tarfile.TarInfo(name)
    about.type, about.linkname = kind, "/etc/passwd" if kind in b"12" else ""
    about.size = len(data) if size is None else size
    return about.tobuf(form) + data + bytes(-len(data) % 512)


def whole(*entries):
    """Return a tar of entries with a correct end."""
    data = b"".join(entries) + bytes(1024)
    return data + bytes(-len(data) % tarfile.RECORDSIZE)


def with_sums(*names):
    """Return a tar with files of these names and correct checksums."""
    digest = hashlib.sha256(b"x").hexdigest()
    sums = "".join(f"{digest}  {name}\n" for name in names).encode()
    files = [entry(f"pseudorigid/{name}") for name in names]
    return whole(*files, entry("pseudorigid/SHA256SUMS", sums))


HOSTILE = {
    "absolute": with_sums("//tmp/absolute.txt"), "above": with_sums("../above.txt"),
    "dots": with_sums("a/../../above.txt"), "control characters": with_sums("a\x1b[2J\nb"),
    "a long name": whole(entry(f"pseudorigid/{'n' * 300}", form=tarfile.GNU_FORMAT)),
    "huge": whole(entry("pseudorigid/x", size=10**12, form=tarfile.GNU_FORMAT)),
    "a huge header": entry("x", size=10**12, kind=tarfile.XHDTYPE, form=tarfile.GNU_FORMAT),
    "many": b"".join(entry(f"pseudorigid/{i}", b"") for i in range(10_050)),
    "compressed": gzip.compress(whole(entry("pseudorigid/x"))),
    "no text": whole(entry("pseudorigid/x").replace(b"pseudorigid/x", b"pseudorigid/\xff")),
    "zeros": bytes(10240), "no sums": whole(entry("pseudorigid/a")),
    **{
        f"of type {kind}": whole(entry("pseudorigid/x", b"", kind))
        for kind in (b"1", b"2", b"3", b"5", b"S", b"x")
    },
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_archive_is_one_line(accepted, tmp_path, name):
    path = tmp_path / "h.tar"
    path.write_bytes(HOSTILE[name])
    with pytest.raises(archive.ArchiveError, match=r"^\S+h.tar: [^\n\x1b]{10,200}$"):
        against(accepted, path)


# ---- folders ----


def test_the_files_of_a_folder_are_compared(accepted, packed, tmp_path):
    other = accepted.copy(tmp_path / "other")
    assert against(accepted, other.path)[0] == 0
    subprocess.run(["tar", "-xf", packed, "-C", tmp_path], check=True)
    status, rows, lines = against(accepted, tmp_path / "pseudorigid")
    assert (status, lines[-1]) == (0, f"{len(rows)} identical")
    for file in (DATA, FIG3):
        (other.path / file).write_text("garbage")
    (other.path / "paper_figures" / "fig7.svg").unlink()
    status, rows, lines = against(accepted, other.path)
    assert status == 1 and rows[FIG3] == rows[DATA] == "differs"
    assert rows["paper_figures/fig7.svg"] == "not in the folder"
    text = "\n".join(lines)
    assert f"drawing: the other {FIG3}: damaged, or not a picture" in text
    assert f"data: the other {DATA}: damaged, or not netCDF" in text


# ---- results that were changed together with their records ----


@pytest.mark.parametrize(("path", "like", "wrong", "words"), [
    (DATA, None, {"fig3.png", "fig3.svg"}, "data: {}: variable strain differs"),
    (DRAWING, "paper_figures/fig4.png", {"fig3.png"}, "drawing: {}: "),
])  # fmt: skip
def test_a_result_with_a_fitting_record_differs_in_its_layer(moved, path, like, wrong, words):
    forge(moved, path, like and (moved.path / like).read_bytes())
    specs = config.load(moved.config).build_specs(["paper"])
    assert path not in Freshness(moved.path, specs).outdated()
    found = verified(moved)
    assert (found.status, set(found.wrong)) == (1, wrong)
    assert all(lines[0].startswith(words.format(path)) for lines in found.wrong.values())


# ---- folders in place of files ----

MANIFEST = "paper_figures/MANIFEST.json"
IN_PLACE = "a folder is in its place: move it away"


@pytest.mark.parametrize("file", [DATA, FIG3, *slowly(MANIFEST)])
def test_a_folder_in_place_of_a_file_is_one_line(moved, tmp_path, file):
    (moved.path / file).unlink()
    (moved.path / file).mkdir()
    said = f"{file}: {IN_PLACE}"
    found = verified(moved)
    assert found.status == 1 and any(said in line for line in found.lines)
    if file != MANIFEST:
        status, (line,) = accepting(moved)
        assert status == 1 and line.startswith(f"reproduce accept: {said}")
    with pytest.raises(archive.ArchiveError, match=f"^{said}"):
        archive.write(moved.path, config.load(moved.config), tmp_path / "a.tar")


@pytest.mark.parametrize("file", [record_path(DATA), log_path(DATA), "config.yaml"])
def test_a_folder_beside_a_result_or_as_config_is_one_line(moved, file):
    for path in (DATA, file):
        (moved.path / path).unlink(missing_ok=True)
    (moved.path / file).parent.mkdir(exist_ok=True)
    (moved.path / file).mkdir()
    result = moved.run("fig3")
    said = f"{file}: {IN_PLACE}\n"
    assert result.returncode == 1 and result.stdout.removeprefix("reproduce: ") == said


# ---- random content ----


@pytest.mark.slow
@pytest.mark.parametrize("place", [record_path(DATA), MANIFEST])
def test_any_record_and_any_manifest(moved, place):
    """Also a manifest with the checksum that fits, which anybody can compute."""
    checked, path, folder = config.load(moved.config), moved.path / place, moved.path.parent
    (folder / "victim.nc").write_text("mine")

    @settings(FUZZ, max_examples=10)
    @given(content=edited(json.loads(path.read_text())) | JSON)
    def trial(content):
        if isinstance(content, dict) and "checksum" in content:
            with suppress(ValueError):
                content["checksum"] = manifest._checksum(content)
        path.write_text(json.dumps(content))
        for findings in verify(moved.path, checked):
            assert all(isinstance(line, str) for line in findings.report())
        accepting(moved)
        with suppress(archive.ArchiveError, FileError):
            archive.write(moved.path, checked, moved.path / "a.tar")
        assert {file.name for file in folder.iterdir()} == {"victim.nc", moved.path.name}
        assert (folder / "victim.nc").read_text() == "mine"

    trial()
