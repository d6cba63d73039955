"""All symmetric orbits of one period; an energy without any ends the job."""

from job import save_stage
from pseudorigid.periodic import symmetric_orbits


def some_orbits(ball, energy, period):
    dataset = symmetric_orbits(ball, energy, period)
    if dataset.sizes["orbit"] == 0:
        raise ValueError(f"no symmetric orbit of period {period} found at energy {energy}")
    return dataset


save_stage(snakemake, some_orbits)
