"""The locked packages as files: the right ones for a machine, and damaged ones refused."""

import pytest

from pipeline.cli.packages import wheels
from pipeline.cli.session import UsageError


@pytest.mark.parametrize("python", ["3.11", "3.13"])
def test_the_conditions_of_requirements_are_those_of_the_other_machine(python):
    lines = wheels._requirements("lock", python, "aarch64")
    names = [line.partition("==")[0] for line in lines]
    assert "greenlet" in names and "pyreadline3" not in names
    assert "greenlet" not in {
        line.partition("==")[0] for line in wheels._requirements("lock", python, "riscv64")
    }
    assert all(" --hash=sha256:" in line and ";" not in line for line in lines)


@pytest.mark.parametrize(
    "name", ["numpy-2.4.6-cp311-cp311-any.whl", "connection_pool-0.0.3.tar.gz"]
)
def test_a_damaged_package_is_named(tmp_path, name):
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "other-1.0-py3-none-any.whl").write_text("another package")
    wheels.refuse_damaged(tmp_path)
    (tmp_path / name).write_bytes(b"damaged")
    with pytest.raises(UsageError, match=f"{name} is damaged"):
        wheels.refuse_damaged(tmp_path)
