"""What shakes and stirs."""
