"""Instruments that heat, dry or sterilise."""
