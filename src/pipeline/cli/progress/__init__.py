"""Describe to a user what a run would make and why, and the state of files."""
