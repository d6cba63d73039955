"""What a user is told: what a run would make and why, and the state of files."""
