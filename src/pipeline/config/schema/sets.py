"""The sets of scenes: the paper's, the study's and those of extensions."""

from ...declaration import SceneSet, extensions

PAPER, STUDY = "paper", "study"
SETS = {  # by their folders in results/
    PAPER: SceneSet("paper_figures", "./reproduce", "The paper's figures", key="scenes"),
    STUDY: SceneSet(
        "more_figures/study", "./reproduce study", "Accuracy and speed of methods", key="study"
    ),
}
for _extension in extensions().values():
    SETS |= _extension.sets
PUBLISHED = {name: each.folder for name, each in SETS.items() if each.folder}
