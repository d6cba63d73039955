"""./reproduce compare A B: figure by figure, what differs between two variants.

Nothing is computed here: both must have their results.
"""

from ... import config
from ...records.artifacts import load
from ...records.differences import brief, differing_keys
from . import cycles, exponents, norms, picture


def compare(root, variants, names, absent):
    """Print what differs between two variants and save their figures side by side.

    Args:
        root: the project's folder.
        variants: the checked variants of the config, name -> scene -> block.
        names: the two of them, the paper's own name included.
        absent: for each of the two, scene -> why its figure cannot exist.
    """
    serves = config.served(variants)

    def data(which, scene, stage):
        return load(root / serves[names[which], scene, stage])

    pairs = {scene: [variants[name][scene] for name in names] for scene in variants[names[0]]}
    print(f"{names[0]} | {names[1]}")
    for scene, blocks in pairs.items():
        print(f"\n{scene}")
        for line in _differences(*blocks):
            print(f"  {line}")
        missing = [absent[which].get(scene) for which in (0, 1)]
        for name, reason in zip(names, missing, strict=True):
            if reason:
                print(f"  cannot exist in {name}: {reason}")
        if not any(missing):
            for stage in config.stages(blocks[0]):
                if stage != "periodic":
                    both = [data(which, scene, stage) for which in (0, 1)]
                    _indented(stage, norms.table(*both, names))
        image = root / picture_path(names, scene)
        if all(missing):
            image.unlink(missing_ok=True)
            continue
        drawings = [
            None if missing[i] else root / config.drawn(scene, "png", names[i]) for i in (0, 1)
        ]
        picture.side_by_side(drawings, names, image)
        print(f"  side by side: {image.relative_to(root)}")
    _periodic(pairs, serves, names, data)
    for scene, blocks in pairs.items():
        if "lyapunov" in config.stages(blocks[0]):
            both = [data(which, scene, "lyapunov") for which in (0, 1)]
            print(
                f"\nLyapunov exponents of {scene}: mean over its orbits ± their standard deviation"
            )
            for line in exponents.table(*both, names):
                print(f"  {line}")


def picture_path(names, scene):
    """Where two figures are saved side by side, from the root."""
    return f"results/compare/{names[0]}..{names[1]}/{scene}.png"


def _differences(one, other):
    """A line for each key of the config that differs."""
    lines = [
        f"{key}: {brief(before)} | {brief(after)}"
        for key, before, after in differing_keys(config.drawing(one), config.drawing(other))
        if key != "axes"  # left out where they are those of the data
    ]
    return lines or ["the same config"]


def _indented(stage, lines):
    for i, line in enumerate(lines):
        print(f"  {stage if i == 0 else '':10}  {line}")


def _periodic(pairs, serves, names, data):
    """Print what became of the periodic orbits, once for each pair of artifacts."""
    groups = {}
    for scene, blocks in pairs.items():
        if "periodic" in config.stages(blocks[0]):
            files = tuple(serves[name, scene, "periodic"] for name in names)
            groups.setdefault(files, []).append(scene)
    if groups:
        print(
            "\nPeriodic orbits, and how far in section radii"
            " (an orbit further than "
            f"{cycles.REACH:g} away counts as another)"
        )
    for scenes in groups.values():
        both = [data(which, scenes[0], "periodic") for which in (0, 1)]
        print(f"  {', '.join(scenes)}")
        for line in cycles.table(*both, names):
            print(f"    {line}")
