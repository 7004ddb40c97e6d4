"""What `labutopia-verify` checks, one module for each kind of question."""
