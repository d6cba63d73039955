"""Pictures of what is proved."""
