"""`python eval/report.py DIR...`: tables and a page of results, of unfinished ones too."""

from labutopia_lerobot.cli.launch import launch

if __name__ == "__main__":
    launch("report")
