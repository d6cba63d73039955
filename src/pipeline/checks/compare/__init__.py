"""./reproduce compare A B: figure by figure, what differs between two variants.

Nothing is computed here: both must have their results.
"""

from ...config import paths
from ...records.artifacts import canonical_json, load
from ...records.differences import brief, differing_keys
from . import cycles, exponents, norms, orbits, picture


def compare(root, variants, names, absent, scenes, everything):
    """Print what differs between two variants and save their figures side by side.

    Parameters
    ----------
    root : pathlib.Path
        The project's folder.
    variants : dict
        The checked variants of the config, name -> scene -> block.
    names : list of str
        The two of them, the paper's own name included.
    absent : list of dict
        For each of the two, scene -> why its figure cannot exist.
    scenes : list of str
        Those of their scenes that are looked at.
    everything : bool
        Whether each variable and each orbit that differs has a line; else each stage has.
    """
    artifact_paths = paths.artifact_paths(variants)

    def data(scene, stage):
        return [load(root / artifact_paths[name, scene, stage]) for name in names]

    pairs = {scene: [variants[name][scene] for name in names] for scene in scenes}
    print(f"{names[0]} | {names[1]}")
    for scene, blocks in pairs.items():
        print(f"\n{scene}")
        for line in _differences(*blocks):
            print(f"  {line}")
        missing = [reasons.get(scene) for reasons in absent]
        for name, reason in zip(names, missing, strict=True):
            if reason:
                print(f"  cannot exist in {name}: {reason}")
        if not any(missing):
            for stage in paths.stages(blocks[0]):
                if stage != "periodic":
                    lines = _of_stage(stage, data(scene, stage), names, everything)
                    for i, line in enumerate(lines):
                        print(f"  {'' if i else stage:10}  {line}")
        image = root / picture_path(names, scene)
        if all(missing):
            image.unlink(missing_ok=True)
            continue
        drawings = [
            None if reason else root / paths.drawn(scene, "png", name)
            for name, reason in zip(names, missing, strict=True)
        ]
        picture.side_by_side(drawings, names, image)
        print(f"  side by side: {image.relative_to(root)}")
    _periodic(pairs, names, data)
    for scene, blocks in pairs.items():
        if "lyapunov" in paths.stages(blocks[0]):
            said = "mean over its orbits ± their standard deviation"
            print(f"\nLyapunov exponents of {scene}: {said}")
            for line in exponents.table(*data(scene, "lyapunov"), names):
                print(f"  {line}")


def picture_path(names, scene):
    """Where two figures are saved side by side, from the root."""
    return f"results/compare/{names[0]}..{names[1]}/{scene}.png"


def _of_stage(stage, pair, names, everything):
    """Lines about how the two datasets of a stage differ."""
    lines = norms.table(*pair, names) if everything else [norms.summary(*pair, names)]
    if stage == "orbits":
        lines += orbits.table(*pair) if everything else orbits.summary(*pair)
    return lines


def _differences(one, other):
    """A line for each key of the config that differs."""
    lines = [
        f"{key}: {brief(before)} | {brief(after)}"
        for key, before, after in differing_keys(paths.drawing(one), paths.drawing(other))
        if key != "axes"  # left out where they are those of the data
    ]
    return lines or ["the same config"]


def _periodic(pairs, names, data):
    """Print what became of the periodic orbits, once for all scenes with the same ones."""
    groups = {}
    for scene, blocks in pairs.items():
        if "periodic" in paths.stages(blocks[0]):
            orbits_of = canonical_json([paths.stages(block)["periodic"] for block in blocks])
            groups.setdefault(orbits_of, []).append(scene)
    if groups:
        far = f"an orbit further than {cycles.REACH:g} away counts as another"
        print(f"\nPeriodic orbits, and how far in section radii ({far})")
    for scenes in groups.values():
        print(f"  {', '.join(scenes)}")
        for line in cycles.table(*data(scenes[0], "periodic"), names):
            print(f"    {line}")
