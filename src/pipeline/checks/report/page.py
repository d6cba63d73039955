"""The page: everything in one file that asks nothing of a network.

But for the seconds and the commit in its last section it has the same bytes wherever the results
behind it have.
"""

import base64
import hashlib
import struct
from pathlib import Path

import jinja2

from ...config import expected, places
from ...config.declared.kinds import KINDS
from ...records.artifacts import load
from ...records.files import file_hash, read_bytes, read_text
from ...records.pictures import PictureError
from ...records.record import read_record, record_path
from .. import contracts, manifest
from ..claims import render as claims
from ..claims.ledger import CORRECTED, FALSE
from ..currency import MISSING, Currency
from ..difference import not_as_made
from ..sums import ContractError, known_sums
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
    """The page of the tree at `root`.

    Parameters
    ----------
    root : pathlib.Path
    checked : dict
        The checked config.
    absent : dict
        Variant -> scene -> why its figure cannot exist.

    Raises
    ------
    ValueError
        A result that cannot be read; it is named.
    """
    page = _Page(root, checked, absent)
    figures = page.variant(places.PAPER)
    made = {name: page.variant(name) for name in page.variants if name not in places.PUBLISHED}
    more = page.on_request()
    return _TEMPLATES.get_template("page.html").render(
        figures=figures,
        variants={name: shown for name, shown in made.items() if _any_made(shown)},
        unmade=[name for name, shown in made.items() if not _any_made(shown)],
        more=more,
        claims=page.claims(),
        corrected=(FALSE, CORRECTED),
        results=page.provenance(),
    )


def _any_made(shown):
    return any(figure["image"] for figure in shown)


class _Page:
    def __init__(self, root, checked, absent):
        self.root, self.checked, self.absent = root, checked, absent
        self.variants = checked["variants"]
        self.serves = places.served(self.variants)
        self.expected = expected.of_variants(self.variants)
        self.outdated = Currency(root, self.expected).outdated()
        self.contracts = {each.folder: each for each in contracts.committed(checked)}
        paper = self.contracts[places.PUBLISHED[places.PAPER]]
        self.outdated |= not_as_made(root, paper)
        self.shown = {}  # every result behind what the page shows, in order

    def variant(self, name):
        """Each scene of a set: its picture where that is current, in words and in numbers."""
        found = []
        for scene, block in self.variants[name].items():
            file = places.drawn(scene, "png", name)
            why = self.absent.get(name, {}).get(scene) or self._not_current(file)
            about = self._about(scene, block) | {"id": f"{name}-{scene}", "missing": why}
            about |= {"image": None, "rows": [], "telling": None}
            if not why:
                about |= self._measured(name, scene)
                about |= {"image": self._read(file), "file": self._file(name, scene)}
                behind = [self.serves[name, scene, stage] for stage in places.stages(block)]
                self.shown |= dict.fromkeys([*behind, file])
            found.append(about)
        return found

    def on_request(self):
        """Pictures of claims, proofs, study and atlas: (what makes them, pictures) of each set.

        Those that this tree has not made are the committed ones.
        """
        found = []
        for contract in self.contracts.values():
            if not contract.on_request:
                continue
            outdated = not_as_made(self.root, contract)
            made, folder = [], Path(contract.results).name
            for name, file in contract.drawn.items():
                if not name.endswith(".png"):
                    continue
                if file in outdated:
                    made += self._committed(contract, name)
                    continue
                scene = contract.scenes[name]
                block = self.variants.get(folder, {}).get(scene)
                about = self._about(scene, block) if block else self._chart(scene)
                about |= self._measured(folder, scene) if block else {"telling": None}
                about |= {"image": self._read(file), "file": f"{contract.folder}/{name}"}
                made.append(about | {"id": f"{contract.folder}/{name}".replace("/", "-")})
                self.shown |= dict.fromkeys([*contract.data[scene].values(), file])
            for name in contract.measured:
                made += self._committed(contract, name)
            found.append((contract.command, made))
        return found

    def _committed(self, contract, name):
        """The committed picture of a name, in a list that is empty where there is none.

        Its caption has the values of config.yaml: it has one only if it was made from them.
        """
        file, measured = f"{contract.folder}/{name}", name in contract.measured
        if not (self.root / file).is_file():
            return []
        data = read_bytes(self.root / file)
        scene = contract.scenes.get(name, name.removesuffix(".png"))
        block = self.variants.get(Path(contract.results).name, {}).get(scene)
        about = self._about(scene, block) if block else self._chart(scene)
        about |= {"telling": None, "image": None, "id": file.replace("/", "-")}
        wanted = known_sums(self.root, contract.folder).get(name)
        same = measured or hashlib.sha256(data).hexdigest() == wanted
        if not (same and data.startswith(_PNG)):
            return [about | {"missing": f"{file} is not the committed one, nor made by this tree"}]
        said = "no hash of measurements is kept" if measured else "as SHA256SUMS has it"
        if block and not self._made_of(contract, scene):
            about |= {"shows": "", "see": ""}
            said += "; made from other values than config.yaml's"
        said = f"{file}: the committed one ({said}), not made by this tree"
        return [about | {"image": _image(data), "file": said}]

    def _made_of(self, contract, scene):
        """Whether the committed picture of a scene was made from the values in config.yaml."""
        try:
            scenes = manifest.read(self.root, contract.folder)["scenes"]
            return scenes[scene]["config"] == contract.config[scene]
        except (ContractError, KeyError, TypeError):
            return False

    def claims(self):
        """The rows of CLAIMS.md, or none."""
        try:
            return claims.read(read_text(self.root / places.LEDGER))
        except (OSError, ValueError):
            return []

    def provenance(self):
        """What made each result shown: file, sha256, commit, packages, and seconds if known."""
        found = []
        for path in self.shown:
            record = read_record(self.root, record_path(path))
            seconds = record.get("seconds")
            commit = str(record.get("commit") or "no commit")[:12]
            found.append(
                {
                    "path": path,
                    "sha256": record["output"]["sha256"],
                    "commit": commit + (", with changes" if record.get("dirty") else ""),
                    "packages": ", ".join(f"{n} {v}" for n, v in record["environment"].items()),
                    "seconds": seconds if isinstance(seconds, float) else None,
                }
            )
        return found

    def _not_current(self, file):
        why = self.outdated.get(file)
        return why and ("not made" if why == MISSING else f"not current: {why}")

    def _measured(self, variant, scene):
        """The rows of a scene's numbers, and the one that tells."""
        block = self.variants[variant][scene]
        data = {stage: self.serves[variant, scene, stage] for stage in places.stages(block)}
        try:
            ours = numbers.measured(block, lambda stage: load(self.root / data[stage]))
        except (LookupError, TypeError, AttributeError, ArithmeticError):
            files = ", ".join(data.values())
            raise ValueError(f"not datasets of {scene}: delete {files} and run again") from None
        rows = numbers.beside(scene, ours)
        telling = KINDS[block["picture"]].telling
        return {"rows": rows, "telling": next(row for row in rows if row[0] == telling)}

    def _about(self, scene, block):
        kind = KINDS[block["picture"]]
        caption = jinja2.Template(kind.caption(), finalize=_written).render(s=block)
        shows, _, see = (" ".join(part.split()) for part in caption.partition("What to see:"))
        number = scene.removeprefix("fig")
        name = f"Figure {number}" if number.isdigit() and number != scene else scene
        title = kind.__doc__.partition("\n")[0]
        return {"name": name, "title": title, "shows": shows, "see": see[:1].upper() + see[1:]}

    def _chart(self, name):
        return {
            "name": name,
            "title": numbers.CHARTS.get(name, "a picture made on request"),
            "shows": "",
            "see": "",
        }

    def _read(self, file):
        """Read a drawing of this tree: its bytes as text, and its size in pixels."""
        data = read_bytes(self.root / file)
        if len(data) < 24:
            raise PictureError(f"{file}: damaged, or not a picture")
        return _image(data)

    def _file(self, variant, scene):
        """Where a picture is published, and whether it is the committed one."""
        drawn = places.drawn(scene, "png", variant)
        if variant != places.PAPER:
            return drawn
        folder = places.PUBLISHED[variant]
        wanted = known_sums(self.root, folder).get(f"{scene}.png")
        same = {
            None: "not among the committed ones",
            file_hash(self.root / drawn): "identical to the committed one",
        }.get(wanted, "not the committed one")
        return f"{folder}/{scene}.png: {same}"


def _image(data):
    """A PNG's bytes as text, and its size in pixels."""
    wide, high = struct.unpack(">II", data[16:24])
    return {"data": base64.b64encode(data).decode(), "wide": wide, "high": high}


def _written(value):
    """A value as a caption has it: whole numbers with commas."""
    return f"{value:,}" if type(value) is int else value
