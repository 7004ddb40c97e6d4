"""Demonstrations as LeRobot datasets: recording, replay, verification."""
