"""The report as one HTML file that needs no network.

Its bytes depend on the results alone, except for the seconds and the commit in its last section.
"""

import base64
import hashlib
import io
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import jinja2
import numpy as np
import numpy.typing as npt
from PIL import Image

from paper.numbers import printed
from pipeline.checks.captions import caption_of
from pipeline.checks.freshness import CURRENT, Freshness
from pipeline.checks.published_sets import IDENTICAL, committed_sets, committed_state
from pipeline.checks.quantities import facts, measured
from pipeline.checks.section import Section
from pipeline.checks.verify import Findings, inspect
from pipeline.config import MAIN, PUBLISHED, Config
from pipeline.config.results import drawn
from pipeline.config.schema import scene as schema
from pipeline.config.schema.sets import SETS
from pipeline.declaration import SceneSet, parts
from pipeline.records.pictures import pixels
from pipeline.records.record import read_record, record_path

from .links import Links

_TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
_THUMBNAIL_STEP = 5  # pixels of a picture per pixel of its thumbnail
_SHADES = 16  # of each colour in the page: more would double its size
Picture = dict[str, Any]  # what the template shows of a picture


def render(root: Path, config: Config, beside: Mapping[str, str] | None = None) -> str:
    """Return the page of the tree at `root`.

    `beside` maps names in the menu to files in the page's folder, if it stands beside them. Raises
    ValueError, which names the file, if a result cannot be read.
    """
    links = Links(root, in_site=beside is not None)
    modules = [each.report for each in parts().values() if each.report]
    sections = [import_module(name).section(config, root, links) for name in modules]
    page = _Page(root, config, sections)
    figures = page.pictures_of(MAIN)
    variants = {name: page.pictures_of(name) for name in config.own_variants}
    made = {name: shown for name, shown in variants.items() if any(p["image"] for p in shown)}
    on_request = page.sets_on_request()
    shown = [figures, *variants.values(), *(pictures for _, pictures in on_request)]
    links.pictures |= {p["published"]: p["id"] for group in shown for p in group}
    return _TEMPLATES.get_template("page.html").render(
        linked=links.of,
        figures=figures,
        variants=made,
        unmade=[name for name in variants if name not in made],
        more=on_request,
        sections=sections,
        results=list(page.provenance()),
        policy=" ".join(_policy_source(each.script) for each in sections if each.script)
        or "'none'",
        beside=beside or {},
    )


def _policy_source(script: str) -> str:
    """Return the hash by which a content security policy allows a script."""
    digest = hashlib.sha256(script.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def _image(file: Path) -> Picture:
    """Return a picture and a small copy of it as text, and its size in pixels."""
    image = pixels(file)
    small = np.asarray(Image.fromarray(image).reduce(_THUMBNAIL_STEP))
    high, wide, _ = image.shape
    return {"image": {"data": _webp(image), "wide": wide, "high": high, "small": _webp(small)}}


def _webp(image: npt.NDArray[np.uint8]) -> str:
    """Return all pixels, with each colour in its nearest of a few shades, in base64."""
    step, file = 255 // (_SHADES - 1), io.BytesIO()
    shaded = (image.astype(np.int16) + step // 2) // step * step
    Image.fromarray(shaded.astype(np.uint8)).save(file, "webp", lossless=True, method=2)
    return base64.b64encode(file.getvalue()).decode()


class _Page:
    """Collects what the page shows of a tree."""

    def __init__(self, root: Path, config: Config, sections: Iterable[Section]) -> None:
        self.root, self.config, self.variants = root, config, config.variants
        self.sections = [*sections]
        self.sets = [inspect(root, each) for each in committed_sets(config)]
        self.freshness = Freshness(root, config.build_specs())
        self.shown: dict[str, None] = {}  # every result behind the page, in order

    def _described(
        self, identifier: str, variant: str, name: str, block: schema.Picture, published: str,
        known: dict[str, Any] | None,
    ) -> Picture:  # fmt: skip
        """Return the caption of a picture and the notes of parts, without an image."""
        full_name = f"{variant}/{name}" if variant in SETS and variant != MAIN else name
        picture: Picture = caption_of(full_name, block.as_mapping(), known)._asdict()
        picture |= {
            "id": identifier,
            "image": None,
            "rows": [],
            "headline": None,
            "as_published": False,
        }
        notes = [each.note(variant, name, block.as_mapping(), published) for each in self.sections]
        return picture | {"published": published, "notes": [*filter(None, notes)]}

    def pictures_of(self, variant: str) -> list[Picture]:
        """Return the pictures of a variant; those that are not current have no image."""
        pictures, left_out = [], self.config.left_out.get(variant, {})
        others = {scene: self.variants[MAIN][scene] for scene in left_out}
        for scene, block in (self.variants[variant] | others).items():
            drawing = drawn(scene, "png", variant)
            published = f"{PUBLISHED[MAIN]}/{scene}.png" if variant == MAIN else drawing
            published = "" if scene in left_out else published
            state = left_out.get(scene) or self.freshness.state(drawing)
            known = self._facts(variant, scene) if state == CURRENT else None
            picture = self._described(f"{variant}-{scene}", variant, scene, block, published, known)
            if state == CURRENT:
                data = self.config.data_of(variant, scene).values()
                compared = f": {committed_state(self.root, published)}" if variant == MAIN else ""
                picture |= self._shown(drawing, data) | self._numbers(variant, scene)
                picture["file"] = f"{published}{compared}"
            else:
                picture["missing"] = state
            pictures.append(picture)
        return pictures

    def sets_on_request(self) -> list[tuple[SceneSet, list[Picture]]]:
        """Return each set that is drawn on request, with its pictures."""
        sets = []
        for findings in self.sets[1:]:
            published_set = findings.published_set
            names = [name for name in published_set.drawn if name.endswith(".png")]
            pictures = [
                self._picture_on_request(findings, n) for n in (*names, *published_set.measured)
            ]
            sets.append((SETS[published_set.group], [each for each in pictures if each]))
        return sets

    def _picture_on_request(self, findings: Findings, name: str) -> Picture | None:
        """Return the picture of this tree if it is current, else the committed one, or None."""
        published_set, committed = findings.published_set, findings.committed
        published, drawing = f"{published_set.folder}/{name}", published_set.drawn.get(name)
        scene, variant = Path(name).stem, published_set.group
        block = self.variants[variant][scene]
        identifier = published.replace("/", "-")
        known, as_committed = None, False
        if drawing and committed and drawing in committed["results"]:
            entry = committed["results"][drawing]
            as_committed = entry["config"] == published_set.build_specs[drawing].config
            known = entry["output"] if as_committed else None
        if drawing and drawing not in findings.stale:
            known = self._facts(variant, scene)
        picture = self._described(identifier, variant, scene, block, published, known)
        if drawing and drawing not in findings.stale:
            numbers = self._numbers(variant, scene) if block.headline else {}
            made = self._shown(drawing, published_set.data[scene].values())
            return picture | made | numbers | {"rows": [], "file": published}
        if not (self.root / published).is_file():
            return None
        if drawing and committed_state(self.root, published) != IDENTICAL:
            missing = f"{published} is neither the committed one nor a current result"
            return picture | {"missing": missing}
        origin = "published file" if drawing else "published file, whose hash is not kept"
        if drawing and not as_committed:
            picture |= {"shows": "", "see": ""}  # they have the values of config.yaml
            origin += ", made from other values than those of config.yaml"
        file = f"{published}: {origin}"
        return picture | _image(self.root / published) | {"file": file, "as_published": True}

    def _shown(self, drawing: str, data: Iterable[str]) -> Picture:
        """Return the image of a current drawing; it and its data are listed as shown."""
        self.shown |= dict.fromkeys([*data, drawing])
        return _image(self.root / drawing)

    def provenance(self) -> Iterator[dict[str, Any]]:
        """Yield path, packages and record of each result shown."""
        for path in self.shown:
            record = read_record(self.root, record_path(path))
            packages = ", ".join(f"{n} {v}" for n, v in record["environment"].items())
            yield {"path": path, "packages": packages, "record": record}

    def _facts(self, variant: str, scene: str) -> dict[str, Any]:
        """Return what a scene's caption says of its data."""
        return measured(self.root, self.config, variant, scene, facts)

    def _numbers(self, variant: str, scene: str) -> Picture:
        """Return the rows of a scene's quantities, and the headline quantity."""
        values = measured(self.root, self.config, variant, scene)
        rows = [(name, printed(scene, name), value) for name, value in values.items()]
        headline = self.variants[variant][scene].headline
        return {"rows": rows, "headline": next(row for row in rows if row[0] == headline)}
