"""What an experiment consists of: each part is one program that makes one thing."""
