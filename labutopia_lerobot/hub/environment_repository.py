"""The EnvHub repository: the file that LeRobot fetches and runs to make our environments."""

from importlib.metadata import version
from importlib.resources import files

from huggingface_hub import ModelCardData

from labutopia_lerobot.hub.card import TAGS, model_card
from labutopia_lerobot.hub.repository import CARD, Repository
from labutopia_lerobot.registry import task_files

_DISTRIBUTION = "lerobot_env_labutopia"


def environment_repository(repo_id: str) -> Repository:
    """Return what is to lie on the Hub, as a model: LeRobot looks for `env.py` there.

    Args:
        repo_id: Its name on the Hub.
    """
    here = version(_DISTRIBUTION)
    card = model_card(
        "environment.md.jinja",
        ModelCardData(
            license="apache-2.0", library_name="lerobot", tags=[*TAGS, "envhub"], language=["en"]
        ),
        repo_id=repo_id,
        version=here,
        distribution=_DISTRIBUTION,
        tasks=list(task_files()),
    )
    return Repository(
        "model",
        {
            "env.py": (files(__package__) / "envhub" / "env.py").read_bytes(),
            "requirements.txt": f"{_DISTRIBUTION}=={here}\n".encode(),
            CARD: card.encode(),
        },
    )
