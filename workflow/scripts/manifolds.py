"""Manifolds of one periodic orbit: whole branches, or what lies in a window."""

from job import save_stage
from pipeline.records.artifacts import load
from pseudorigid.dynamics.manifolds import scene_manifolds, window_manifolds
from pseudorigid.dynamics.periodic import of_type


def trace(ball, energy, period, type, **how):
    orbit = of_type(load(snakemake.input.periodic[0]), type)
    return (window_manifolds if "window" in how else scene_manifolds)(ball, energy, orbit, **how)


save_stage(snakemake, trace)
