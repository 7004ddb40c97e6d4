"""Instruments that shake and stir."""
