"""Instruments, furniture and holders: what is fixed to the bench, or stands on it."""
