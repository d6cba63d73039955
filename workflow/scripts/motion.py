"""Position and strain in time along one periodic orbit."""

from job import save_stage
from pseudorigid.artifacts import load
from pseudorigid.orbits import motion
from pseudorigid.periodic import of_type


def scene_motion(ball, energy, period, type, duration):
    return motion(ball, of_type(load(snakemake.input.periodic[0]), type), duration)


save_stage(snakemake, scene_motion)
