"""The site: Sphinx sets the Markdown of the repository, with pages that are written anew."""
