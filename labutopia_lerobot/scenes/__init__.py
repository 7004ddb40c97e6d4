"""LabScene: rooms and furniture."""
