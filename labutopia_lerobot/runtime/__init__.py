"""What programs run on: worker processes, videos."""
