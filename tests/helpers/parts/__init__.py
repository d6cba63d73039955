"""What tests of extensions share."""
