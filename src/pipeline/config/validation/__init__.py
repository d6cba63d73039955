"""Reading and validation of config.yaml."""
