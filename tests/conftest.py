"""Shared by every test."""

import labutopia_lerobot  # noqa: F401  (first of all: it chooses MuJoCo's OpenGL backend)
