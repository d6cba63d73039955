"""What a publication needs: archives, an article."""
