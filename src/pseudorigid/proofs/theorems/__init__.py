"""What is proved: the statements with their certificates, requests, and data for pictures."""
