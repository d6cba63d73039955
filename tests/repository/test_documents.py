"""Links, files, commands and examples in README and docs exist and work."""

import os
import re
import shutil
from fnmatch import fnmatch

import pytest
import yaml
from project import ROOT, Tree, run, shipped
from slowly import slowly

from pipeline import config
from pipeline.checks import datasets
from pipeline.config import reference
from pipeline.publication import metadata

DOCUMENTS = sorted(
    str(file.relative_to(ROOT)) for file in [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")]
)
# Commands that take minutes, or packages of their own: of these only --help is run.
LONG = ("test", "study", "benchmark", "claims", "families", "atlas", "sweep", "accept", "article")
LONG_PARTS = ("prove --impacts", "prove --search", "prove --pictures", "variant exact", "--slurm")
LONG_PARTS += ("--with-packages",)
# Folders of the repository; results and .venv are left out.
FOLDERS = (".github", "src", "tests", "config", "docs", "workflow", "profiles", "requirements")
FOLDERS += ("paper_figures", "more_figures")
FILES = [
    str(file.relative_to(ROOT))
    for files in (ROOT.glob("*"), *((ROOT / folder).rglob("*") for folder in FOLDERS))
    for file in files
    if file.is_file()
]
SUFFIX = r"\.(?:py|md|yaml|yml|toml|json|txt|png|svg|cff|nc|smk|tar)"


# Files that a module writes: python -m MODULE renews them.
GENERATED = {"docs/config.md": reference} | dict.fromkeys(metadata.pages(), metadata)


def text_of(document):
    return (ROOT / document).read_text(encoding="utf-8")


def blocks(document):
    """The indented blocks of a document, without the indent."""
    found = re.findall(r"(?:^|\n)\n((?:    .*\n|\n(?=    ))+)", text_of(document))
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip("\n") for block in found]


def commands(document):
    """The ./reproduce lines of its blocks, without comments."""
    lines = [line for block in blocks(document) for line in block.splitlines()]
    lines = [re.sub(r"\s+# .*", "", line).strip() for line in lines]
    return [line for line in lines if line.startswith("./reproduce") and "..." not in line]


def is_long(command):
    word = [*command.split()[1:], ""][0]
    return word in LONG or command == "./reproduce prove" or any(p in command for p in LONG_PARTS)


def shell(script, folder, **environment):
    return run("sh", "-c", f"({script}) 2>&1", cwd=folder, env=os.environ | environment)


@pytest.mark.parametrize(
    ("file", "module"), [*GENERATED.items(), *slowly(("docs/data.md", datasets))]
)
def test_a_generated_file_is_up_to_date(file, module):
    text = module.pages()[file] if module is metadata else module.page()
    assert text_of(file) == text, f"renew it: python -m {module.__name__}"


def test_the_readme_is_short():
    assert len(text_of("README.md").splitlines()) <= 150


@pytest.mark.parametrize("document", ["README.md", "CONTRIBUTING.md", "docs/api.md"])
def test_lines_are_short(document):
    lines = text_of(document).splitlines()
    assert [line for line in lines if len(line) > 100 and not line.startswith("|")] == []


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_to_files(document):
    folder = (ROOT / document).parent
    for link in re.findall(r"\]\(([^)\s]+)\)", text_of(document)):
        if not link.startswith(("http:", "https:")):
            assert (folder / link.partition("#")[0]).exists(), link


@pytest.mark.parametrize("document", [name for name in DOCUMENTS if name != "CHANGELOG.md"])
def test_named_files_exist(document):
    """Paths, and names in backquotes, are those of a file or the end of its path."""
    text = re.sub(r"https?://\S+", "", text_of(document))
    words = re.findall(rf"[\w./*-]*/[\w./*-]*{SUFFIX}\b", text)
    words += re.findall(rf"`([\w-]+{SUFFIX})`", text)
    for word in words:
        name = word.removeprefix("../")
        if not (name.startswith("results/") or name.endswith(".nc") or "NAME" in name):
            assert any(fnmatch(f"/{file}", f"*/{name}") for file in FILES), word


def test_commands_are_found_in_the_documents():
    found = {line for document in DOCUMENTS for line in commands(document)}
    assert {"./reproduce", "./reproduce verify", "./reproduce -n", "./reproduce report"} <= found
    long = sum(map(is_long, found))
    assert long >= 5 and len(found) - long >= 8


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
    """Each command runs, in the order of the documents and in one copy."""
    for document in DOCUMENTS:
        for written in commands(document):
            command = f"./reproduce {written.split()[1]} --help" if is_long(written) else written
            if written.startswith("./reproduce clean"):
                command += " --yes"
            result = shell(command, clone.path)
            assert result.returncode == 0, f"{document}: {command}\n{result.stdout}"
            assert "Traceback (most" not in result.stdout


@pytest.mark.slow
def test_the_script_for_ci(clone, tmp_path):
    """The script in docs/bytes.md runs without a cache and with one; this copy is cloned."""
    (script,) = (block for block in blocks("docs/bytes.md") if "CACHE" in block)
    assert len(script.splitlines()) <= 10
    line = "git clone <this repository> pseudorigid"
    assert line in script
    script = script.replace(line, f'cp -a "{clone.path}" pseudorigid; rm -rf pseudorigid/results')
    for folder in ("first", "second"):
        (tmp_path / folder).mkdir()
        result = shell(script, tmp_path / folder, CACHE=str(tmp_path / "a cache"))
        assert result.returncode == 0, result.stdout
        assert "11 of 11 figures identical" in result.stdout
    assert (tmp_path / "a cache" / "results" / "paper").is_dir()


def test_the_python_of_the_readme():
    (block,) = (text for text in blocks("README.md") if text.startswith("from pseudorigid import"))
    names = {}
    exec(block, names)
    assert f"its multiplier is {float(names['hyperbolic']['multiplier']):.4f}" in block
    assert names["hyperbolic"]["type"].item() == "hyperbolic"


def test_the_variant_of_the_readme():
    (block,) = (text for text in blocks("README.md") if text.startswith("variants:"))
    document = yaml.safe_load(text_of("config.yaml")) | yaml.safe_load(block)
    variant = config.check(document)["variants"]["lower-energy"]
    assert variant["fig3"]["duration"] == 30 and variant["fig2"]["energy"] == 0.0098
