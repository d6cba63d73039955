"""Make the outdated blocks of sweeps on a card; other processes write them, with their records."""

import os
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from pipeline.checks.freshness import Freshness
from pipeline.config import Config
from pipeline.jobs import forks
from pipeline.jobs.heartbeat import Heartbeat
from pipeline.processors.build import CompiledFile
from pipeline.records.build_spec import BuildSpec
from pipeline.records.record import failure
from pipeline.records.sources import ROOT, source_files

from .card import Card, CardError
from .cells import classified, fixed_points, orbits_at_once

KERNEL = CompiledFile(Path(__file__).with_name("kernel.ptx"), f"{__package__}.orbit", "ptx")


def make_blocks(config: Config, datasets: Iterable[str], cores: str) -> None:
    """Make the outdated blocks of some datasets of sweeps.

    Raises CardError before anything is made if no card can be used, and if a block was not made.
    """
    specs = config.build_specs()
    freshness = Freshness(ROOT, specs)
    blocks = [specs[block] for path in datasets for block in specs[path].inputs]
    blocks = [spec for spec in blocks if freshness.direct_reason(spec.result)]
    if not blocks:
        return
    context = forks.forking(data=True)  # before CUDA starts
    card = Card(KERNEL.content())
    kinds = {(spec.config["starts"], spec.config["impacts"]) for spec in blocks}
    rooms = {kind: orbits_at_once(card, *kind) for kind in kinds}
    way = [*source_files(f"{__package__}.cells"), str(KERNEL.path.relative_to(ROOT))]
    about = {"device": card.name, "driver": card.driver}
    left = len(blocks)
    Heartbeat(lambda: f"{card.name}: {left} of {len(blocks)} blocks left" if left else "")
    workers = (os.cpu_count() or 1) if cores == "all" else int(cores)

    def write(spec: BuildSpec, *judged: np.ndarray) -> None:
        nonlocal left
        whole = spec._replace(sources=[*dict.fromkeys([*spec.sources, *way])])
        if not forks.run(context, whole, {"judged": judged}, about):
            raise CardError(failure(spec.result) or f"{spec.result}: not made")
        left -= 1

    with ThreadPoolExecutor(workers) as pool:
        before: list[Any] = []
        for batch, (starts, impacts) in _batches(blocks, rooms):
            cells = np.array([cell for spec in batch for cell in spec.config["cells"]])
            fixed = fixed_points(cells)
            places, step = np.column_stack([cells, fixed[:, [0, 2]]]), rooms[starts, impacts]
            step //= starts
            try:
                verdicts = np.concatenate(
                    [
                        classified(card, places[first : first + step], starts, impacts)
                        for first in range(0, len(places), step)
                    ]
                ).view(np.recarray)
            except Exception as error:  # cuda-core raises many types
                raise CardError(f"--gpu: {card.name}: {' '.join(str(error).split())}") from error
            for each in before:
                each.result()
            before, last = [], 0
            for spec in batch:
                first, last = last, last + len(spec.config["cells"])
                judged = fixed[first:last], verdicts[first * starts : last * starts]
                before.append(pool.submit(write, spec, *judged))
        for each in before:
            each.result()


def _batches(
    blocks: list[BuildSpec], rooms: dict[tuple[int, int], int]
) -> Iterator[tuple[list[BuildSpec], tuple[int, int]]]:
    """Yield blocks that a card takes at once, with the starts and impacts of their cells."""
    batch: list[BuildSpec] = []
    orbits, kind = 0, (0, 0)
    for spec in blocks:
        own = spec.config["starts"], spec.config["impacts"]
        more = len(spec.config["cells"]) * own[0]
        if batch and (own != kind or orbits + more > rooms[kind]):
            yield batch, kind
            batch, orbits = [], 0
        batch.append(spec)
        orbits, kind = orbits + more, own
    yield batch, kind


def renewed() -> dict[str, str]:
    """Compile the kernel again if its meaning was edited; no other file is generated here."""
    KERNEL.renew()
    return {}
