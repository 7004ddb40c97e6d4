"""Glassware: vessels of revolution, rods."""
