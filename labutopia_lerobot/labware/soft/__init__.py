"""Soft bodies: a wall or a tube that gives way."""
