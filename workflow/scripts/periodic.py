"""All symmetric orbits of one period; what needs one that is not there says so."""

from job import save_stage
from pseudorigid.dynamics.periodic import symmetric_orbits

save_stage(snakemake, symmetric_orbits)
