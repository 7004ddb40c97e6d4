"""`python eval/compare.py DIR_A DIR_B`: which of two policies is better, on common seeds."""

from labutopia_lerobot.cli.launch import launch

if __name__ == "__main__":
    launch("compare")
