"""README and docs: short where promised; links, files and commands in them are there and work."""

import os
import re
import shutil
import subprocess
from fnmatch import fnmatch

import pytest
from project import ROOT, Tree, shipped

DOCUMENTS = sorted(
    str(file.relative_to(ROOT)) for file in [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")]
)
# Words that take minutes, or packages that only they need: of these only the arguments are read.
LONG = ("test", "study", "benchmark", "claims", "atlas", "sweep", "accept")
LONG_PARTS = ("prove --impacts", "prove --search", "prove --pictures", "variant exact", "--slurm")
# Where the history speaks of files that are gone.
OF_THE_PAST = ("CHANGELOG.md",)
# What there is, apart from what is made.
FOLDERS = (
    "src",
    "tests",
    "docs",
    "workflow",
    "profiles",
    "requirements",
    "paper_figures",
    "more_figures",
)
FILES = [
    str(file.relative_to(ROOT))
    for folder in (*FOLDERS, ".github")
    for file in (ROOT / folder).rglob("*")
    if file.is_file()
] + [file.name for file in ROOT.iterdir() if file.is_file()]
ENDS = r"\.(?:py|md|yaml|yml|toml|json|txt|png|svg|cff|nc|smk|tar)"


def text_of(document):
    return (ROOT / document).read_text(encoding="utf-8")


def blocks(document):
    """The indented blocks of a document, as text without the indent."""
    found = re.findall(r"(?:^|\n)\n((?:    .*\n|\n(?=    ))+)", text_of(document))
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip("\n") for block in found]


def commands(document):
    """The ./reproduce lines of its blocks, without comments."""
    lines = [line for block in blocks(document) for line in block.splitlines()]
    lines = [re.sub(r"\s+# .*", "", line).strip() for line in lines]
    return [line for line in lines if line.startswith("./reproduce") and "..." not in line]


ALL = sorted({line for document in DOCUMENTS for line in commands(document)})


def is_long(command):
    word = [*command.split()[1:], ""][0]
    return word in LONG or command == "./reproduce prove" or any(p in command for p in LONG_PARTS)


def test_the_readme_is_short():
    assert len(text_of("README.md").splitlines()) <= 150


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_to_files(document):
    folder = (ROOT / document).parent
    for link in re.findall(r"\]\(([^)\s]+)\)", text_of(document)):
        if not link.startswith(("http:", "https:")):
            assert (folder / link.partition("#")[0]).exists(), link


@pytest.mark.parametrize("document", [d for d in DOCUMENTS if d not in OF_THE_PAST])
def test_named_files_are_there(document):
    """Paths, and names in backquotes; of a name that is cut, a file whose path ends so."""
    text = re.sub(r"https?://\S+", "", text_of(document))
    words = re.findall(rf"[\w./*-]*/[\w./*-]*{ENDS}\b", text)
    words += re.findall(rf"`([\w-]+{ENDS})`", text)
    for word in words:
        name = word.removeprefix("../")
        if not (name.startswith("results/") or name.endswith(".nc") or "NAME" in name):
            assert any(fnmatch(f"/{file}", f"*/{name}") for file in FILES), word


def test_the_long_ones_and_the_rest():
    """Neither list is empty, so that what is below runs something."""
    assert {"./reproduce", "./reproduce verify", "./reproduce -n", "./reproduce report"} <= set(ALL)
    assert sum(map(is_long, ALL)) >= 5 and sum(not is_long(command) for command in ALL) >= 8


@pytest.fixture(scope="module")
def clone(shared, accepted):
    """A finished copy that runs with this folder's packages, as ./reproduce finds them."""

    def make(folder):
        tree = accepted.copy(folder)
        (tree.path / ".venv").mkdir(exist_ok=True)  # compiled code may be in it
        for name in ("bin", "lib", "lib64", "pyvenv.cfg", "stamp", "contents"):
            (tree.path / ".venv" / name).symlink_to(ROOT / ".venv" / name)
        (tree.path / ".venv" / "place").write_text(str(tree.path / ".venv"))
        shutil.copy(ROOT / "CLAIMS.json", tree.path)
        tree.write(tree.document() | {"variants": shipped()["variants"]})

    return Tree(shared("a clone for the documents", make))


@pytest.mark.slow
@pytest.mark.skipif(not (ROOT / ".venv" / "stamp").is_file(), reason="not set up by ./reproduce")
def test_every_command(clone):
    """Each in the order of the documents, in one copy; exit 0 and no traceback."""
    for document in DOCUMENTS:
        for written in commands(document):
            command = f"./reproduce {written.split()[1]} --help" if is_long(written) else written
            if written.startswith("./reproduce clean"):
                command += " --yes"
            result = subprocess.run(
                ["sh", "-c", command],
                cwd=clone.path,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                check=False,
            )
            assert result.returncode == 0, f"{document}: {command}\n{result.stdout}"
            assert "Traceback (most" not in result.stdout


@pytest.mark.slow
def test_the_script_for_ci(clone, tmp_path):
    """The lines of docs/bytes.md, with this copy for the repository, without and with a cache."""
    (script,) = (block for block in blocks("docs/bytes.md") if "CACHE" in block)
    assert len(script.splitlines()) <= 10
    place = "git clone <this repository> pseudorigid"
    assert place in script
    script = script.replace(place, f'cp -a "{clone.path}" pseudorigid; rm -rf pseudorigid/results')
    for folder in ("first", "second"):
        (tmp_path / folder).mkdir()
        result = subprocess.run(
            ["sh", "-c", script],
            cwd=tmp_path / folder,
            env=os.environ | {"CACHE": str(tmp_path / "a cache")},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
        assert result.returncode == 0, result.stdout + result.stderr
        assert "11 of 11 figures identical" in result.stdout
    assert (tmp_path / "a cache" / "results" / "paper").is_dir()


@pytest.mark.parametrize("document", ["README.md"])
def test_python_blocks(document):
    (block,) = (text for text in blocks(document) if text.startswith("from pseudorigid import"))
    names = {}
    exec(block, names)
    assert abs(float(names["hyperbolic"]["multiplier"]) - 2.0417) < 5e-5
    assert "its multiplier is 2.0417" in block
    assert names["hyperbolic"]["type"].item() == "hyperbolic"


def test_the_variant_of_the_readme_is_read():
    import yaml

    from pipeline import config

    (block,) = (text for text in blocks("README.md") if text.startswith("variants:"))
    document = yaml.safe_load(text_of("config.yaml"))
    document["variants"] = yaml.safe_load(block)["variants"]
    made = config.check(document)["variants"]["lower-energy"]
    assert made["fig3"]["duration"] == 30 and made["fig2"]["energy"] == 0.0098
