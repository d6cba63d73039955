"""Commands that publish the figures and what they were made from."""
