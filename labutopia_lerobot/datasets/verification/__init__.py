"""Checks of `labutopia-verify`, one module for each kind of question."""
