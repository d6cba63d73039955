"""The lock of a folder outlives a killed run for as long as the snakemake that it started."""

import errno
import os
import shutil
import signal
import subprocess
import sys
import types

import pytest

from helpers.project import ROOT
from helpers.verdicts import commit
from pipeline.cli import lock, running
from pipeline.records.provenance import git

RUN = """
import sys
from pathlib import Path

from pipeline.cli import lock, running

lock.ROOT = Path(sys.argv[1])
with lock.locked():
    running._run(["sh", "-c", "echo $$; exec sleep 60"], False)
"""


def test_the_lock_is_held_until_the_snakemake_of_a_killed_run_ends(tmp_path, monkeypatch):
    monkeypatch.setattr(lock, "ROOT", tmp_path)
    monkeypatch.setattr(lock, "LOCK_SECONDS", 0.2)
    run = subprocess.Popen(
        [sys.executable, "-c", RUN, str(tmp_path)], stdout=subprocess.PIPE, text=True,
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")}, cwd=ROOT,
    )  # fmt: skip
    with run:
        snakemake = int(run.stdout.readline())
        run.kill()
        run.wait()
        with pytest.raises(lock.UsageError, match="another"), lock.locked():
            pass
        os.kill(snakemake, signal.SIGKILL)
    with lock.locked():
        pass


def started(folder, *words, **how):
    """Return the exit status and the lines on stderr of a command that starts in `folder`."""
    command = [sys.executable, "-P", "-m", "pipeline", *words]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "PYTHONUTF8": "1"}
    how = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True} | how
    result = subprocess.run(command, cwd=folder, env=environment, check=False, **how)
    return result.returncode, result.stderr.splitlines()


@pytest.mark.parametrize("words", [["-n"], ["--version"], ["help"]])
def test_output_that_cannot_be_written_is_one_line(words):
    with open("/dev/full", "w") as full:
        lines = ["reproduce: cannot write to stdout: No space left on device"]
        assert started(ROOT, *words, stdout=full) == (1, lines)


@pytest.mark.parametrize("closed", ["", "<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_a_closed_stream_is_no_failure(tmp_path, closed):
    """A file that is opened later must not become the stream either."""
    (tmp_path / "streams.py").write_text(
        "import os\nfrom pipeline.cli import main\n"
        f"number = os.open({str(tmp_path / 'file')!r}, os.O_RDWR | os.O_CREAT)\n"
        "print('said')\nprint('said', file=main.sys.stderr)\n"
        "raise SystemExit(main.main(['--version']) or 10 * (number < 3))\n"
    )
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    command = f'"$0" streams.py {closed}'
    how = {"cwd": tmp_path, "env": environment, "capture_output": True}
    result = subprocess.run(["sh", "-c", command, sys.executable], check=False, **how)
    assert result.returncode == 0
    assert result.stdout.startswith(b"said\n") == (">&- " not in f" {closed} ".replace("2>&-", ""))
    assert result.stderr == (b"" if "2>&-" in closed else b"said\n")
    assert (tmp_path / "file").read_text() == ""


def test_list_with_its_output_closed_succeeds(tmp_path):
    assert started(ROOT, "list", preexec_fn=lambda: os.close(1)) == (0, [])


def test_a_file_system_without_locks_is_said_once(tmp_path, monkeypatch, capsys):
    def refuse(file, how):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(lock, "ROOT", tmp_path)
    monkeypatch.setattr(lock.fcntl, "flock", refuse)
    monkeypatch.setenv(lock._NO_LOCKS, "")  # as before any command
    for _ in range(2):  # as after an installation
        with lock.locked():
            pass
    line = "reproduce: no locks here (No locks available): run one command at a time\n"
    assert capsys.readouterr().err == line


def test_results_that_are_no_folder_are_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(lock, "ROOT", tmp_path)
    (tmp_path / "results").symlink_to("nowhere")
    with pytest.raises(lock.UsageError, match=r"^results is no folder"), lock.locked():
        pass


def test_results_that_are_a_link_are_ignored_by_git(tmp_path):
    """As on a cluster; a pattern that ends in a slash would miss the link."""
    shutil.copy(ROOT / ".gitignore", tmp_path)
    commit(tmp_path, ".gitignore")
    for name in ("results", ".snakemake"):
        (tmp_path / name).symlink_to("/tmp")
    assert git("status", "--porcelain", root=tmp_path) == b""


def test_a_deleted_working_folder_is_one_line(tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    line = "reproduce: the current folder was deleted: go to another one"
    assert started(gone, "list", preexec_fn=gone.rmdir) == (1, [line])


INTERRUPTED = """
import signal
import warnings
from contextlib import suppress

from pipeline.cli import running

signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup ignores it
with suppress(KeyboardInterrupt), running.interruptible() as caught:
    signal.raise_signal(signal.SIGHUP)
warnings.warn("forkserver: process died unexpectedly")
print(caught)
"""


def test_no_warning_about_killed_processes_follows_an_interrupt():
    run = subprocess.run(
        [sys.executable, "-c", INTERRUPTED], check=False, capture_output=True, text=True
    )
    assert (run.stdout, run.stderr) == ("[1]\n", "")


def test_the_lock_waits_for_a_run_that_ends_soon(tmp_path, monkeypatch):
    monkeypatch.setattr(lock, "ROOT", tmp_path)
    times = iter([0.0, 0.0, 1.0, 4.9, 5.1])  # the first is of the lock that is held
    clock = types.SimpleNamespace(monotonic=lambda: next(times), sleep=lambda seconds: None)
    monkeypatch.setattr(lock, "time", clock)
    with lock.locked():
        with pytest.raises(lock.UsageError, match="another"), lock.locked():
            pass
        assert [*times] == []  # it has waited for five seconds


def test_a_killed_snakemake_and_its_new_log_are_named(tmp_path, monkeypatch, capsys):
    logs = tmp_path / ".snakemake/log"
    logs.mkdir(parents=True)
    (logs / "of an earlier run.log").touch()
    monkeypatch.setattr(running, "ROOT", tmp_path)
    run = f"touch {logs}/new.log; kill -9 $$"
    for command, status, lines in (
        ("exit 2", 2, []), ("exit 0", 0, []),
        (run, -9, ["reproduce: snakemake was killed (SIGKILL): memory may be short",
                   "reproduce: snakemake's log: .snakemake/log/new.log"]),
    ):  # fmt: skip
        assert running._run(["sh", "-c", command], False) == status
        assert capsys.readouterr().err.splitlines() == lines


def test_settings_of_a_users_shell_do_not_reach_a_run(monkeypatch):
    dropped = ("SNAKEMAKE_PROFILE", "NUMBA_NUM_THREADS", "NUMBA_OPT", "MPLBACKEND", running.RUN)
    for name in (*dropped, "NUMBA_CPU_NAME", "MPLCONFIGDIR", "XDG_CACHE_HOME", "PYTHONPATH"):
        monkeypatch.setenv(name, "generic")
    running.set_environment()
    assert not {*dropped} & os.environ.keys() and os.environ["NUMBA_CPU_NAME"] == "generic"
    assert os.environ["PYTHONPATH"] == str(ROOT / "src")
    for name in ("MPLCONFIGDIR", "XDG_CACHE_HOME"):
        assert os.environ[name].startswith(str(ROOT / ".venv"))


def test_snakemake_has_the_options_of_the_profile():
    """A flag has no value, and a list is several words."""
    options = running._profile()
    assert options[options.index("--rerun-triggers") + 1] == "mtime"
    assert options[options.index("--keep-going") + 1].startswith("--")
    profile = (ROOT / "profiles/default/config.yaml").read_text()
    assert all(f"{each.removeprefix('--')}:" in profile for each in options[3:] if each[:2] == "--")
