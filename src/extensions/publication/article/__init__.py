"""The replication article: its text, and the numbers that it takes from the results."""
