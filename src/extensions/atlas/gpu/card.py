"""An NVIDIA card, through cuda-core: memory, copies, and threads that run a kernel."""

import ctypes
from pathlib import Path
from typing import Any

import numpy as np

THREADS = 128  # of a block


class CardError(ValueError):
    """Why a card, or what it computed, cannot be used: one line."""


def require_driver() -> None:
    """Raise CardError on a machine without a driver, for which nothing need be installed."""
    try:
        ctypes.CDLL("libcuda.so.1")
    except OSError:
        raise CardError("--gpu: this machine has no NVIDIA driver (libcuda.so.1)") from None


class Card:
    """The first card of this machine, with kernels that it runs; raises CardError without one.

    `memory` is how many bytes are free, `driver` the driver's version and that of its CUDA.
    """

    def __init__(self, ptx: bytes) -> None:
        try:
            from cuda.bindings import driver
            from cuda.core import Device, ObjectCode

            device = Device(0)
            device.set_current()
            self._driver, self._device, self._stream = driver, device, device.create_stream()
            version, (self.memory, _) = self._call("DriverGetVersion"), self._call("MemGetInfo")
            self._code = ObjectCode.from_ptx(ptx)
            self.registers = self._code.get_kernel("classify").attributes.num_regs
        except Exception as error:  # cuda-core raises many types
            reason = " ".join(str(error).split()) or type(error).__name__
            raise CardError(f"--gpu: no NVIDIA card can be used here: {reason}") from None
        file = Path("/sys/module/nvidia/version")
        own = f"{file.read_text(encoding='utf-8').strip()}, " if file.exists() else ""
        self.name = device.name
        self.driver = f"{own}CUDA {version // 1000}.{version % 1000 // 10}"

    def empty(self, size: int, dtype: type) -> Any:
        """Return room for an array of the card, with any values."""
        return self._device.allocate(size * np.dtype(dtype).itemsize, stream=self._stream)

    def copied(self, values: np.ndarray) -> Any:
        """Return a copy of an array on the card."""
        values = np.ascontiguousarray(values)
        copy = self.empty(values.size, values.dtype.type)
        self._copy("HtoD", int(copy.handle), values.ctypes.data, values.nbytes)
        return copy

    def read(self, array: Any, dtype: type) -> np.ndarray:
        """Return the values of an array of the card."""
        values = np.empty(array.size // np.dtype(dtype).itemsize, dtype)
        self._copy("DtoH", values.ctypes.data, int(array.handle), values.nbytes)
        return values

    def run(self, kernel: str, threads: int, *arguments: Any) -> None:
        """Start a kernel in some threads; arguments are integers and arrays of the card."""
        from cuda.core import LaunchConfig, launch

        given = [np.int64(a) if isinstance(a, int) else a for a in (threads, *arguments)]
        shape = LaunchConfig(grid=-(-threads // THREADS), block=THREADS)
        launch(self._stream, shape, self._code.get_kernel(kernel), *given)

    def _copy(self, how: str, to: int, source: int, size: int) -> None:
        """Copy bytes after all that was started before, and wait for the end."""
        self._call(f"Memcpy{how}Async", to, source, size, self._stream.handle)
        self._stream.sync()

    def _call(self, name: str, *arguments: Any) -> Any:
        """Call a function of the driver; return what it returns after the error."""
        error, *results = getattr(self._driver, f"cu{name}")(*arguments)
        if int(error):
            raise RuntimeError(f"cu{name}: {self._driver.CUresult(error).name}")
        return results[0] if len(results) == 1 else results
