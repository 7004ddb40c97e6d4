"""Instruments that dose liquids."""
