"""Draw a scene from its artifacts; the kind of picture names the module that does it."""

from importlib import import_module

from job import one_line_errors, recorded
from pseudorigid.artifacts import load
from pseudorigid.figures.save import save

scene = snakemake.params.scene
with one_line_errors(snakemake), recorded(snakemake, scene):
    picture = import_module(f"pseudorigid.figures.{scene['picture']}")
    data = [load(path) for path in snakemake.input.data]
    save(picture.draw(scene, *data), snakemake.output[0])
