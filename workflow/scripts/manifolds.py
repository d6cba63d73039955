"""Manifolds of one periodic orbit: whole branches, or what lies in a window."""

from job import save_stage
from pseudorigid.artifacts import load
from pseudorigid.manifolds import scene_manifolds, window_manifolds
from pseudorigid.periodic import of_type


def trace(ball, energy, period, type, **how):
    orbit = of_type(load(snakemake.input.periodic[0]), type)
    return (window_manifolds if "window" in how else scene_manifolds)(ball, energy, orbit, **how)


save_stage(snakemake, trace)
