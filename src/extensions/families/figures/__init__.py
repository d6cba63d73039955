"""Pictures of families of periodic orbits and of chains of islands."""
