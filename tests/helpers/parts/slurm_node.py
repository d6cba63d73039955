"""A Slurm of two nodes on this machine.

It needs Debian's packages slurm-wlm and munge. The daemons (munged, slurmctld and two slurmd) need
root.
"""

import os
import secrets
import shutil
import socket
import subprocess
import tempfile
from contextlib import ExitStack
from pathlib import Path

from helpers.project import run, wait_for

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "squeue")
CONFIG = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={ports[0]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=5
KillWait=2
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
NodeName=one NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=4000
NodeName=two NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=4000
PartitionName=main Nodes=one,two Default=YES MaxTime=INFINITE State=UP
"""
NODES = ("one", "two")


def missing():
    """The reason why Slurm cannot run here, or None."""
    lacking = [name for name in NEEDED if shutil.which(name) is None]
    if lacking:
        return f"{', '.join(lacking)} not installed: apt install slurm-wlm munge"
    return None if os.geteuid() == 0 else "the daemons of Slurm need root"


class Cluster:
    """Context manager that starts the daemons and stops them."""

    def __enter__(self):
        self.folder = Path(tempfile.mkdtemp(prefix="slurm-"))
        self.folder.chmod(0o755)  # for munge's socket
        for name in ("state", *(f"spool.{node}" for node in NODES)):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        host = socket.gethostname().split(".")[0]
        config = self.folder / "slurm.conf"
        config.write_text(CONFIG.format(folder=self.folder, host=host, ports=free_ports(3)))
        # The plugin clears SLURM_CONF in jobs, and srun would then read /etc.
        srun = self.folder / "bin" / "srun"
        srun.parent.mkdir()
        srun.write_text(f'#!/bin/sh\nSLURM_CONF={config} exec {shutil.which("srun")} "$@"\n')
        srun.chmod(0o755)
        path = f"{srun.parent}:{os.environ['PATH']}"
        self.environment = {"SLURM_CONF": str(config), "PATH": path}
        self.running = {}
        try:
            names = ("key-file", "socket", "pid-file", "log-file", "seed-file")
            files = [f"--{name}={self.folder}/munge.{name.split('-')[0]}" for name in names]
            self.start("munged", "--foreground", "--force", *files)
            wait_for((self.folder / "munge.socket").exists, 10)
            self.start("slurmctld", "-D")
            for node in NODES:
                self.start("slurmd", "-D", "-N", node, name=node)
            wait_for(lambda: self.states() == dict.fromkeys(NODES, "idle"), 30)
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self.running.keys() & set(NODES):  # a job outlives the daemon
            self.ask("scancel", "--user", "root")
            wait_for(lambda: not self.jobs("R,CG"), 20)
        for name in list(self.running)[::-1]:
            self.stop(name)
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, program, *arguments, name=None):
        """Start a daemon in a session of its own."""
        name = name or program
        with open(self.folder / f"{name}.out", "a", encoding="utf-8") as out:
            how = {"stdout": out, "stderr": out, "env": os.environ | self.environment}
            command = [shutil.which(program), *arguments]
            self.running[name] = subprocess.Popen(command, start_new_session=True, **how)

    def stop(self, name):
        process = self.running.pop(name)
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def ask(self, *command):
        """Run a command of Slurm and return what it prints."""
        return run(*command, env=os.environ | self.environment).stdout

    def jobs(self, state="R"):
        """Job number -> node, for the jobs in a state."""
        lines = self.ask("squeue", "-h", "-t", state, "-o", "%i %N").splitlines()
        return {number: node for number, _, node in (line.partition(" ") for line in lines)}

    def states(self):
        """Node -> state."""
        return dict(map(str.split, self.ask("sinfo", "-h", "-N", "-o", "%N %T").splitlines()))


def free_ports(count):
    """Ports that nothing listens to."""
    with ExitStack() as stack:
        sockets = [
            stack.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in range(count)
        ]
        return [each.getsockname()[1] for each in sockets]
