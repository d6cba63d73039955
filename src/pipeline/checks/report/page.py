"""The page: everything in one file that asks nothing of a network.

But for the seconds and the commit in its last section it has the same bytes wherever the results
behind it have.
"""

import base64
import hashlib
import struct
from pathlib import Path

import jinja2

from ...config import build_specs, paths
from ...config.schema.kinds import KINDS
from ...records.artifacts import load
from ...records.files import file_hash, read_bytes, read_text
from ...records.pictures import PictureError
from ...records.record import read_record, record_path
from .. import manifest, published_sets
from ..checksums import ChecksumError, known_sums
from ..claims import ledger
from ..claims.schema import CORRECTED, FALSE
from ..difference import not_as_made
from ..freshness import MISSING, Freshness
from . import numbers

_PNG = b"\x89PNG\r\n\x1a\n"
_TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


def render(root, checked, absent) -> str:
    """The page of the tree at `root`; `absent` has variant -> scene -> why it has no figure.

    Raises
    ------
    ValueError
        A result that cannot be read; it is named.
    """
    page = _Page(root, checked, absent)
    figures = page.variant(paths.PAPER)
    shown = {name: page.variant(name) for name in page.variants if name not in paths.PUBLISHED}
    made = {name: found for name, found in shown.items() if any(one["image"] for one in found)}
    return _TEMPLATES.get_template("page.html").render(
        figures=figures,
        variants=made,
        unmade=[name for name in shown if name not in made],
        more=page.on_request(),
        claims=page.claims(),
        corrected=(FALSE, CORRECTED),
        results=list(page.provenance()),
    )


class _Page:
    def __init__(self, root, checked, absent):
        self.root, self.checked, self.absent = root, checked, absent
        self.variants = checked["variants"]
        self.artifact_paths = paths.artifact_paths(self.variants)
        self.build_specs = build_specs.of_variants(self.variants)
        self.outdated = Freshness(root, self.build_specs).outdated()
        self.published = {each.folder: each for each in published_sets.committed_sets(checked)}
        paper = self.published[paths.PUBLISHED[paths.PAPER]]
        self.outdated |= not_as_made(root, paper)
        self.shown = {}  # every result behind what the page shows, in order

    def variant(self, name):
        """Each scene of a set: its picture where that is current, in words and in numbers."""
        found = []
        for scene, block in self.variants[name].items():
            file = paths.drawn(scene, "png", name)
            why = self.absent.get(name, {}).get(scene) or self._not_current(file)
            about = self._about(scene, block) | {"id": f"{name}-{scene}", "missing": why}
            about |= {"image": None, "rows": [], "headline": None}
            if not why:
                about |= self._measured(name, scene)
                about |= {"image": self._read(file), "file": self._file(name, scene)}
                behind = [self.artifact_paths[name, scene, stage] for stage in paths.stages(block)]
                self.shown |= dict.fromkeys([*behind, file])
            found.append(about)
        return found

    def on_request(self):
        """Pictures of claims, proofs, study and atlas: (what makes them, pictures) of each set."""
        found = []
        for published_set in self.published.values():
            if published_set.on_request:
                outdated = not_as_made(self.root, published_set)
                names = [name for name in published_set.drawn if name.endswith(".png")]
                names += published_set.measured
                pictures = [self._on_request(published_set, name, outdated) for name in names]
                found.append((published_set.command, [each for each in pictures if each]))
        return found

    def _on_request(self, published_set, name, outdated):
        """The picture of a name: that of this tree, else the committed one, or None."""
        published, drawing = f"{published_set.folder}/{name}", published_set.drawn.get(name)
        scene = published_set.scenes.get(name, name.removesuffix(".png"))
        variant = Path(published_set.results).name
        block = self.variants.get(variant, {}).get(scene)
        about = self._about(scene, block) if block else _chart(scene)
        about |= {"headline": None, "image": None, "id": published.replace("/", "-")}
        if drawing and drawing not in outdated:
            about |= self._measured(variant, scene) if block else {}
            self.shown |= dict.fromkeys([*published_set.data[scene].values(), drawing])
            return about | {"image": self._read(drawing), "file": published}
        if not (self.root / published).is_file():
            return None
        data = read_bytes(self.root / published)
        wanted = known_sums(self.root, published_set.folder).get(name)
        same = drawing is None or hashlib.sha256(data).hexdigest() == wanted
        if not (same and data.startswith(_PNG)):
            missing = f"{published} is not the committed one, nor made by this tree"
            return about | {"missing": missing}
        said = "as SHA256SUMS has it" if drawing else "no hash of measurements is kept"
        # A caption has the values of config.yaml.
        if block and not self._made_of(published_set, scene):
            about |= {"shows": "", "see": ""}
            said += "; made from other values than config.yaml's"
        said = f"{published}: the committed one ({said}), not made by this tree"
        return about | {"image": _image(data), "file": said}

    def _made_of(self, published_set, scene):
        """Whether the committed picture of a scene was made from the values in config.yaml."""
        try:
            scenes = manifest.read(self.root, published_set.folder)["scenes"]
            return scenes[scene]["config"] == published_set.config[scene]
        except (ChecksumError, KeyError, TypeError):
            return False

    def claims(self):
        """The rows of CLAIMS.json in the order of CLAIMS.md, or none."""
        try:
            verdicts = ledger.read_json(read_text(self.root / paths.LEDGER_DATA))
        except (OSError, ValueError):
            return []
        return [row for rows in ledger.by_verdict(verdicts).values() for row in rows]

    def provenance(self):
        """Yield file, sha256, commit, packages and seconds, if known, of each result shown."""
        for path in self.shown:
            record = read_record(self.root, record_path(path))
            seconds = record.get("seconds")
            commit = str(record.get("commit") or "no commit")[:12]
            yield {
                "path": path,
                "sha256": record["output"]["sha256"],
                "commit": commit + (", with changes" if record.get("dirty") else ""),
                "packages": ", ".join(f"{n} {v}" for n, v in record["environment"].items()),
                "seconds": seconds if isinstance(seconds, float) else None,
            }

    def _not_current(self, file):
        why = self.outdated.get(file)
        return why and ("not made" if why == MISSING else f"not current: {why}")

    def _measured(self, variant, scene):
        """The rows of a scene's numbers, and the one that tells."""
        block = self.variants[variant][scene]
        data = {stage: self.artifact_paths[variant, scene, stage] for stage in paths.stages(block)}
        try:
            ours = numbers.measured(block, lambda stage: load(self.root / data[stage]))
        except (LookupError, TypeError, AttributeError, ArithmeticError):
            files = ", ".join(data.values())
            raise ValueError(f"not datasets of {scene}: delete {files} and run again") from None
        rows = numbers.beside(scene, ours)
        headline = KINDS[block["picture"]].headline
        return {"rows": rows, "headline": next(row for row in rows if row[0] == headline)}

    def _about(self, scene, block):
        kind = KINDS[block["picture"]]
        caption = jinja2.Template(kind.caption(), finalize=_written).render(s=block)
        shows, _, see = (" ".join(part.split()) for part in caption.partition("What to see:"))
        number = scene.removeprefix("fig")
        name = f"Figure {number}" if number.isdigit() and number != scene else scene
        title = kind.__doc__.partition("\n")[0]
        return {"name": name, "title": title, "shows": shows, "see": see[:1].upper() + see[1:]}

    def _read(self, file):
        """Read a drawing of this tree: its bytes as text, and its size in pixels."""
        data = read_bytes(self.root / file)
        if len(data) < 24:
            raise PictureError(f"{file}: damaged, or not a picture")
        return _image(data)

    def _file(self, variant, scene):
        """Where a picture is published, and whether it is the committed one."""
        drawn = paths.drawn(scene, "png", variant)
        if variant != paths.PAPER:
            return drawn
        folder = paths.PUBLISHED[variant]
        wanted = known_sums(self.root, folder).get(f"{scene}.png")
        same = "identical to" if wanted == file_hash(self.root / drawn) else "not"
        words = f"{same} the committed one" if wanted else "not among the committed ones"
        return f"{folder}/{scene}.png: {words}"


def _chart(name):
    """A picture in words that is no scene of a kind."""
    title = numbers.CHARTS.get(name, "a picture made on request")
    return {"name": name, "title": title, "shows": "", "see": ""}


def _image(data):
    """A PNG's bytes as text, and its size in pixels."""
    wide, high = struct.unpack(">II", data[16:24])
    return {"data": base64.b64encode(data).decode(), "wide": wide, "high": high}


def _written(value):
    """A value as a caption has it: whole numbers with commas."""
    return f"{value:,}" if type(value) is int else value
