"""What heats, dries or sterilises."""
