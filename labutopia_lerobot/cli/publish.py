"""`labutopia-publish DATASET --repo-id me/pick`: a dataset, policy or environment to the Hub."""

from pathlib import Path

from rich.console import Console
from rich.filesize import decimal

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.datasets.description import INFO, read_recording
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.hub.dataset import dataset_repository
from labutopia_lerobot.hub.environment_repository import environment_repository
from labutopia_lerobot.hub.policy import find_policy, policy_repository
from labutopia_lerobot.hub.publish import publish, require_repo_id
from labutopia_lerobot.hub.repository import Repository
from labutopia_lerobot.scenes.room_files import is_of_file
from labutopia_lerobot.setting import RULES

ENVIRONMENT = "environment"


class UnpublishableError(UserError):
    """A folder that holds neither a dataset nor a policy."""


@clear_errors
def main() -> None:
    """Publish what the command line names."""
    parser = OptionParser(prog="labutopia-publish", description=__doc__)
    parser.add_argument(
        "what", help=f"folder of a dataset or of a trained policy, or the word `{ENVIRONMENT}`"
    )
    parser.add_argument("--repo-id", required=True, help="owner and name, such as me/pick")
    parser.add_argument(
        "--results",
        type=Path,
        nargs="+",
        default=[],
        metavar="DIR",
        help="results of eval/run.py, for the card",
    )
    parser.add_argument(
        "--private", action="store_true", help="only the owner sees it (default: everybody)"
    )
    parser.add_argument(
        "--replace", action="store_true", help="take the place of anything else that lies there"
    )
    parser.add_argument(
        "--dry-run", action="store_true", help="list what would be sent, and send nothing"
    )
    parser.add_argument(
        "--card", type=Path, metavar="FILE.md", help="write the card there too, to look at it"
    )
    parser.add_argument(
        "--tasks-dir", metavar="DIR", help="a folder of tasks of your own, whose files you trust"
    )
    arguments = parser.parse_args()
    require_repo_id(arguments.repo_id)
    results = [result for folder in arguments.results for result in load_results(folder)]
    busy, console = Console(stderr=True), Console(highlight=False, soft_wrap=True)
    with doing(busy, f"Verifying {arguments.what}"):
        repository = _repository(arguments.what, arguments.repo_id, results, arguments.tasks_dir)
    if arguments.card is not None:
        arguments.card.parent.mkdir(parents=True, exist_ok=True)
        arguments.card.write_bytes(repository.card)
    if arguments.dry_run:
        console.print(_list(repository, arguments.repo_id, arguments.private), markup=False)
        return
    # No spinner: huggingface_hub draws bars of its own.
    busy.print(f"Sending {_amount(repository)} to {arguments.repo_id}", markup=False)
    url = publish(
        repository, arguments.repo_id, private=arguments.private, replace=arguments.replace
    )
    console.print(f"Published: {url}", markup=False)


def _repository(
    what: str, repo_id: str, results: list[LoadedResult], tasks_dir: str | None
) -> Repository:
    if what == ENVIRONMENT:
        return environment_repository(repo_id)
    if (Path(what) / INFO).exists():
        _require_known_files(Path(what))
        return dataset_repository(Path(what), repo_id, results, tasks_dir)
    policy = find_policy(Path(what))
    if policy is None:
        raise UnpublishableError(
            f"{what} holds neither a dataset ({INFO}) nor a trained policy (config.json). "
            f"Name the folder of one, or the word {ENVIRONMENT}"
        )
    return policy_repository(policy, repo_id, results)


def _require_known_files(dataset: Path) -> None:
    """Make sure that the users of a dataset can replay it."""
    recording = read_recording(dataset)
    room = None if recording is None else recording["config"].get("room")
    if isinstance(room, str) and is_of_file(room):
        raise UnpublishableError(
            f"{dataset} was recorded in a room of your own, {room}, which nobody else can replay "
            "it in. Record it in one that `labutopia-scene list` names"
        )
    reasoner = RULES if recording is None else recording["config"].get("reasoner", RULES)
    if reasoner != RULES:
        raise UnpublishableError(
            f"{dataset} was recorded with answers of your own, {reasoner}, without which nobody "
            f"else can replay it. Record it with reasoner={RULES}"
        )


def _list(repository: Repository, repo_id: str, private: bool) -> str:
    lines = [f"{size:>14,}  {path}" for path, size in repository.sizes.items()]
    visibility = "private" if private else "public"
    tag = f", tag {repository.tag}" if repository.tag else ""
    return "\n".join(
        [
            *lines,
            f"{_amount(repository)} to the {repository.kind} {repo_id} ({visibility}){tag}. "
            "Nothing was sent",
        ]
    )


def _amount(repository: Repository) -> str:
    return f"{len(repository.files)} files ({decimal(sum(repository.sizes.values()))})"


if __name__ == "__main__":
    main()
