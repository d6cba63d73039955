"""What a user is told: the steps of a run, what one would do, the state of files."""
