"""The kernel as WebAssembly: its entry points, and the compiler that makes the module."""
