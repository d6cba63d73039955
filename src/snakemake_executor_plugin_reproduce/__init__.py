"""Executor plugin of snakemake: `snakemake --executor reproduce` forks a process for each job."""

from concurrent.futures import Future

from snakemake.exceptions import SpawnedJobError
from snakemake.executors.local import Executor as LocalExecutor
from snakemake.executors.local import common_settings
from snakemake_interface_executor_plugins.jobs import SingleJobExecutorInterface

from pipeline.jobs.forks import forking, run
from pipeline.jobs.plan import plan

__all__ = ["Executor", "common_settings"]


class Executor(LocalExecutor):
    """Snakemake's local executor, but that a job with a result is forked (pipeline.jobs.forks)."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.plan = plan()  # as the Snakefile made it
        self.context = forking(any(path.endswith(".nc") for path in self.plan.outdated))

    def run_single_job(self, job: SingleJobExecutorInterface) -> Future[None]:
        """Start a job."""
        result = dict(job.output.items()).get("result")
        if result is None:  # all
            return super().run_single_job(job)
        self.workflow.async_run(job.prepare())
        return self.pool.submit(self._make, str(result))

    def _make(self, path: str) -> None:
        """Make a result, unless another job has; raise SpawnedJobError if that fails."""
        freshness = self.plan.freshness
        if not (freshness.is_current_now(path) or run(self.context, freshness.build_specs[path])):
            raise SpawnedJobError
