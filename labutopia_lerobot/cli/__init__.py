"""Command-line programs: thin shells over the package."""
