"""Contents of vessels: substances and fillings."""
