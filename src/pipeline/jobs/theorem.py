"""Check a theorem."""

from pseudorigid.proofs.theorems.statements import theorem_verdict

from ..records import artifacts
from ..records.build_spec import BuildSpec


def make(spec: BuildSpec) -> None:
    """Check the theorem that the specification names, and save the verdict."""
    title = artifacts.title_of(theorem_verdict)
    dataset = theorem_verdict(spec.config["theorem"])
    artifacts.save(dataset, spec.result, spec.config, stage="theorem", title=title)
