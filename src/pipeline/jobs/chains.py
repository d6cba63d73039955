"""Follow births of chains, and their losses of stability, over the plane of a sweep."""

from pseudorigid.sweep.chains import chains

from ..records import artifacts
from ..records.build_spec import BuildSpec


def make(spec: BuildSpec) -> None:
    """Compute the curves over the plane of the specification's sweep."""
    title = artifacts.title_of(chains)
    artifacts.save(chains(spec.config), spec.result, spec.config, title=title)
