"""`python eval/run.py task=level1/pick policy=act`: the same as `labutopia-eval`."""

from labutopia_lerobot.cli.evaluate import main

if __name__ == "__main__":
    main()
