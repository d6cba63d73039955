"""What other machines lack: what only Linux has, and in a container a user's name and a home."""

import os
import sys

import pytest

from helpers.project import fresh_tree, of_scenes, run

# Python runs this file at each start. It takes away what macOS lacks, and the user's name.
SITE = """
import os, pwd, select, signal

for name in (
    "sched_getaffinity sched_setaffinity sched_getparam sched_setparam sched_getscheduler "
    "sched_setscheduler sched_rr_get_interval copy_file_range eventfd eventfd_read eventfd_write "
    "fdatasync getrandom getresgid getresuid getxattr listxattr memfd_create pidfd_open pipe2 "
    "posix_fadvise posix_fallocate process_cpu_count removexattr setns setresgid setresuid "
    "setxattr splice unshare waitid"
).split():
    if hasattr(os, name):
        delattr(os, name)
for module, names in {
    select: ("epoll",), signal: ("pidfd_send_signal", "sigtimedwait", "sigwaitinfo")
}.items():
    for name in names:
        if hasattr(module, name):
            delattr(module, name)


def getpwuid(number):
    raise KeyError(f"getpwuid(): uid not found: {number}")


pwd.getpwuid = getpwuid
"""


@pytest.mark.slow
def test_a_run_needs_neither_linux_nor_a_user_with_a_name_and_a_home(tmp_path):
    """The name is what snakemake asks for, and the home is where it would have its cache."""
    tree = fresh_tree(tmp_path / "tree", of_scenes("fig3"))
    (tree.path / "src" / "sitecustomize.py").write_text(SITE)
    tree.warm()
    kept = {"PATH", "OMP_NUM_THREADS", "TMPDIR"} & os.environ.keys()
    environment = {name: os.environ[name] for name in kept}
    environment |= {"HOME": "/proc/nowhere", "PYTHONPATH": str(tree.path / "src")}
    drawing = "results/paper/figures/fig3.png"
    plain = [sys.executable, "-m", "snakemake", "--cores", "2", "--force", drawing]
    for command in (tree.command("fig3"), plain):
        result = run(*command, env=environment, cwd=tree.path)
        assert result.returncode == 0, result.stdout + result.stderr
    assert (tree.path / "paper_figures/fig3.png").read_bytes()[1:4] == b"PNG"
    cores = "import os; assert not hasattr(os, 'sched_getaffinity'); "
    cores += "from pseudorigid.dynamics.ensemble import threads; print(threads())"
    result = run(sys.executable, "-c", cores, env=environment)
    assert result.stdout == f"{os.environ.get('OMP_NUM_THREADS') or os.cpu_count()}\n"


# Packages that exist as pure source alone, which installs anywhere.
PURE_SOURCES = {"connection-pool"}
MAC = {
    "sys_platform": "darwin", "platform_system": "Darwin", "platform_machine": "arm64",
    "python_version": "3.12",
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    "names", [("uv", "build", "lock", "algebra", "report"), ("test",), ("article",)]
)
def test_the_locked_packages_have_wheels_for_macos_on_apple_processors(tmp_path, names):
    """Pip evaluates conditions for the machine that runs it, so that they are decided here."""
    archive = pytest.importorskip("extensions.publication.commands.archive")
    lines = [line for name in names for line in archive.requirements_for(name, MAC)]
    wanted = [f"{line}\n" for line in lines if line.partition("==")[0] not in PURE_SOURCES]
    (tmp_path / "wanted.txt").write_text("".join(wanted))
    options = ["--dry-run", "--no-deps", "--require-hashes", "--only-binary=:all:"]
    options += ["--platform=macosx_15_0_arm64", "--python-version=3.12", f"--target={tmp_path}/to"]
    pip = [sys.executable, "-m", "pip", "install", *options, "-r", tmp_path / "wanted.txt"]
    result = run(*pip)
    assert result.returncode == 0, result.stderr
    assert len(result.stdout.partition("Would install ")[2].split()) == len(wanted)
