"""The sets of results whose files are published, and the folders where users find these."""

PAPER = "paper"
# Sets of scenes: the paper's own, and those that are drawn on request and have no variants.
PUBLISHED = {
    PAPER: "paper_figures",
    "claims": "more_figures/claims",
    "families": "more_figures/families",
    "proofs": "more_figures/proofs",
}
# All sets by their folders in results/.
FOLDERS = PUBLISHED | {"study": "more_figures/study", "sweep": "more_figures/atlas"}
