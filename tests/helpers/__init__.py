"""What several tests share; tests/README.md has a line for each module."""
