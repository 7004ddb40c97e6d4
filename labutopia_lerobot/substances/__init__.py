"""What vessels hold: substances and fillings."""
