"""What measures and what one looks through."""
