"""The block `prove` of config.yaml."""

from pipeline.config.schema.fields import LARGEST, Block, whole


class Prove(Block):
    """a mapping with the key impacts"""

    impacts: int = whole(1, LARGEST)
    """Number of impacts to prove in each figure whose data have millions of them. The impacts of
    the other figures are all proved."""
