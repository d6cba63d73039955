"""Executor plugin of snakemake: `snakemake --executor reproduce` forks a process for each job."""

from concurrent.futures import Future

from snakemake.exceptions import SpawnedJobError
from snakemake.executors.local import Executor as LocalExecutor
from snakemake.executors.local import common_settings
from snakemake_interface_executor_plugins.jobs import SingleJobExecutorInterface

from pipeline.jobs.forks import forking, run
from pipeline.records.provenance import read_spec

__all__ = ["Executor", "common_settings"]


class Executor(LocalExecutor):
    """Snakemake's local executor, but that a job with a result is forked (pipeline.jobs.forks)."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.context = forking()

    def run_single_job(self, job: SingleJobExecutorInterface) -> Future[None]:
        """Start a job."""
        specification = dict(job.input.items()).get("specification")
        if specification is None:  # all
            return super().run_single_job(job)
        self.workflow.async_run(job.prepare())
        return self.pool.submit(self._make, str(specification), job.threads)

    def _make(self, specification: str, threads: int) -> None:
        """Make a result; raise SpawnedJobError if that fails."""
        if not run(self.context, read_spec(specification), threads=threads):
            raise SpawnedJobError
