"""What a publication needs: metadata files, packages for a run without a network, an article."""
