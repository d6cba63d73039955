"""History of the Lyapunov exponents of a scene's orbits."""

from job import save_stage
from pseudorigid.dynamics.lyapunov import scene_exponents

save_stage(snakemake, scene_exponents)
