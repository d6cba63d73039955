"""Position and strain in time along one periodic orbit."""

from job import save_stage
from pipeline.records.artifacts import load
from pseudorigid.dynamics.motion import motion
from pseudorigid.dynamics.periodic import of_type


def scene_motion(ball, energy, period, type, duration):
    return motion(ball, of_type(load(snakemake.input.periodic[0]), type), duration)


save_stage(snakemake, scene_motion)
