"""From the file to a checked config, and what is said where it is wrong."""
