"""The sets of a proved graph on the section, and the connections between them."""

from ..fields import YamlMapping
from ..scene import Dataset, OfOrbits


class Graph(OfOrbits):
    """the sets of a proved graph of coverings, and the connections between them"""

    stages = ("graph", "orbits")
    headline = "entropy"

    @staticmethod
    def numbers(block: YamlMapping, graph: Dataset, orbits: Dataset) -> dict[str, str]:
        """Count the sets and the connections, and give the entropy's proved lower bound."""
        inner = int((graph["connection"].values < 0).sum())
        return {
            "sets": f"{inner} and {graph.sizes['set'] - inner} on the way",
            "connections": f"{graph.sizes['connection']}",
            "entropy": f"above {float(graph['entropy']):.4f} per impact",
        }
