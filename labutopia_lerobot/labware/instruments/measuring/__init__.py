"""Instruments that measure, and those that one looks through."""
