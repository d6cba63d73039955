"""./reproduce families: follow families of periodic orbits, and draw them."""

from .. import figures
from ..arguments import Arguments
from ..session import locked


def run(args: Arguments) -> int:
    """Compute the families of each scene of the block, and publish their pictures."""
    with locked():
        wanted = figures.of_scenes(args.checked, "families")
        return figures.make(args.checked, "families", wanted, args.options)
