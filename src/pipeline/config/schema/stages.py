"""The stages that parts declare: function, inputs, fields that decide the data."""

from collections.abc import Iterable

from ...declaration import Stage, parts

STAGES: dict[str, Stage] = {}
for _part in parts().values():
    STAGES |= _part.stages


def upstream(stages: Iterable[str]) -> list[str]:
    """Return these stages and those whose datasets they take, each after its inputs."""
    ordered: dict[str, None] = {}
    for stage in stages:
        ordered |= dict.fromkeys((*upstream(STAGES[stage].inputs), stage))
    return list(ordered)
