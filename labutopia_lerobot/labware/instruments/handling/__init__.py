"""What doses liquids."""
