"""Make the outdated blocks of sweeps on a card; other processes write them, with their records."""

from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import numpy as np

from extensions.processors.build import CompiledFile
from pipeline.config import Config
from pipeline.jobs import forks
from pipeline.jobs.heartbeat import Heartbeat
from pipeline.records.provenance import BuildSpec, Freshness, failure
from pipeline.records.sources import ROOT, source_files, syntax_hash
from pseudorigid.dynamics.ensemble import threads

from .card import Card, CardError
from .cells import classified, fixed_points, orbits_at_once

KERNEL = CompiledFile(Path(__file__).with_name("kernel.ptx"), f"{__package__}.orbit", "ptx")


def make_blocks(config: Config, datasets: Iterable[str], cores: str) -> None:
    """Make the outdated blocks of some datasets of sweeps.

    Raises CardError before anything is made if no card can be used, and if a block was not made.
    """
    freshness = Freshness(ROOT, config.build_specs())
    specs = freshness.build_specs
    paths = dict.fromkeys(block for path in datasets for block in specs[path].inputs)
    blocks = [specs[path] for path in freshness.outdated(paths)]
    if not blocks:
        return
    context = forks.forking()  # before CUDA starts
    files = [*source_files(f"{__package__}.cells"), str(KERNEL.path.relative_to(ROOT))]
    way = {file: syntax_hash(ROOT / file) for file in files}
    card = Card(KERNEL.content())
    kinds = {(spec.config["starts"], spec.config["impacts"]) for spec in blocks}
    rooms = {kind: orbits_at_once(card, *kind) for kind in kinds}
    about = {"device": card.name, "driver": card.driver, "way": way}
    futures: list[Future[None]] = []

    def write(spec: BuildSpec, *judged: np.ndarray) -> None:
        if not forks.run(context, spec, {"judged": judged}, about):
            raise CardError(f"{spec.result}: {failure(spec.result) or 'not made'}")

    def progress() -> str:
        left = len(blocks) - sum(each.done() for each in futures)
        return f"{card.name}: {left} of {len(blocks)} blocks left"

    jobs = threads() if cores == "all" else int(cores)
    with closing(Heartbeat(progress)), ThreadPoolExecutor(jobs) as pool:
        try:
            for batch, (starts, impacts) in _batches(blocks, rooms):
                cells = np.array([cell for spec in batch for cell in spec.config["cells"]])
                fixed = fixed_points(cells)
                verdicts = _verdicts(card, cells, fixed, starts, impacts, rooms[starts, impacts])
                for each in futures:  # so that two batches at most are in memory
                    each.result()
                last = 0
                for spec in batch:
                    first, last = last, last + len(spec.config["cells"])
                    judged = fixed[first:last], verdicts[first * starts : last * starts]
                    futures.append(pool.submit(write, spec, *judged))
            for each in futures:
                each.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _verdicts(
    card: Card, cells: np.ndarray, fixed: np.ndarray, starts: int, impacts: int, room: int
) -> np.recarray:
    """Return the verdicts on the orbits of cells, as many orbits at once as there is room for."""
    places, step = np.column_stack([cells, fixed[:, [0, 2]]]), room // starts
    pieces = [places[first : first + step] for first in range(0, len(places), step)]
    try:
        found = [classified(card, piece, starts, impacts) for piece in pieces]
    except Exception as error:  # cuda-core raises many types
        between = f"cells {cells[0].tolist()} to {cells[-1].tolist()}"
        raise CardError(f"--gpu: {between}: {' '.join(str(error).split())}") from error
    return np.concatenate(found).view(np.recarray)


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
