"""`python eval/run.py task=level1/pick policy=act`: the same as `labutopia-eval`."""

from labutopia_lerobot.cli.launch import launch

if __name__ == "__main__":
    launch("evaluate")
