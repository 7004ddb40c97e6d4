"""Centrifuges, evaporators, pumps."""
