"""Safety, gases and waste."""
