"""The tutorial, read literally: its blocks are pasted where it says, and it leaves nothing."""

import re
import shutil

import pytest
import yaml

from helpers.project import ROOT, SHIPPED, Tree, run
from pipeline import config

PAGE = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
# The paragraph before an indented block, and the block.
_STEP = re.compile(r"((?:^(?! {4}).+\n)+)\n((?:    .*\n|\n(?=    ))+)", re.MULTILINE)
STEPS = [(words, re.sub("(?m)^    ", "", block)) for words, block in _STEP.findall(PAGE)]


def pasted(text, paragraph, block):
    """Return config.yaml after a step that edits it, else None."""
    words = " ".join(paragraph.split())
    if below := re.search(r"below the line `(\S+)`$", words):
        assert text.count(f"\n{below[1]}\n") == 1
        return text.replace(f"\n{below[1]}\n", f"\n{below[1]}\n{block}", 1)
    if line := re.search(r"In the block `(\w+:)`, replace the line `(.+)` by this one:$", words):
        before, after = text.split(f"\n  {line[1]}\n")
        replaced = f"    {line[2]}\n"
        assert replaced in after.partition("\n\n")[0]
        return f"{before}\n  {line[1]}\n" + after.replace(replaced, block, 1)
    return None


def test_each_block_of_the_config_can_be_pasted_where_the_tutorial_says():
    text, edits = SHIPPED.read_text(encoding="utf-8"), 0
    for paragraph, block in STEPS:
        edited = pasted(text, paragraph, block)
        text, edits = edited or text, edits + bool(edited)
    assert edits == 4
    checked = config.check(yaml.safe_load(text))
    assert checked.faulty == {}
    assert {"shell", "gravity-0p02", "gravity-0p06"} <= {*checked.variants}
    assert checked.scenes["fig3"].energy == 0.012 and checked.scenes["middle"].energy == 0.004


@pytest.mark.slow
def test_the_tutorial_leaves_no_trace(tmp_path):
    folder = tmp_path / "clone"
    names = (".venv", ".git", "results", ".snakemake", "__pycache__", ".*_cache")
    shutil.copytree(ROOT, folder, symlinks=True, ignore=shutil.ignore_patterns(*names))
    shutil.copy(SHIPPED, folder / "config.yaml")
    if (ROOT / "results/paper").is_dir():
        shutil.copytree(ROOT / "results/paper", folder / "results/paper")
    tree = Tree(folder, cold=True)
    tree.succeed()
    tree.succeed("accept")  # of whatever is edited here
    git = ["git", "-c", "user.name=x", "-c", "user.email=x@example.org"]
    for words in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "x"]):
        assert run(*git, *words, cwd=folder).returncode == 0
    said = dict[str, str]()
    for paragraph, block in STEPS:
        if edited := pasted(tree.config.read_text(), paragraph, block):
            tree.config.write_text(edited)
        elif block.startswith("from "):
            assert tree.python("-c", block).stdout.startswith("[0.2")
        else:
            for line in block.splitlines():
                words = line.partition("#")[0].split()
                if words[0] == "git":
                    result = run(*words, cwd=folder)
                    assert result.returncode == 0, result.stderr
                    said[line] = result.stdout
                else:
                    said[line.partition("#")[0].strip()] = tree.succeed(*words[1:])
    assert re.search(r"^fig3 .* differs$", said["./reproduce fig3"], re.MULTILINE)
    assert "paper_figures/middle.png: removed" in said["./reproduce accept"]
    assert "nothing to commit, working tree clean" in said["git status"]
    assert said["./reproduce verify"].splitlines()[-1].endswith("files identical")
