"""Orbits of a scene."""

from job import save_stage
from pseudorigid.dynamics.orbits import scene_orbits

save_stage(snakemake, scene_orbits)
