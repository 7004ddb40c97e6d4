"""Cards of datasets: up to date, readable by the Hub, true to the facts that they are made of."""

from pathlib import Path

import pytest
from huggingface_hub import DatasetCard

import make_cards
from labutopia_lerobot.datasets.declaration import dataset_features
from labutopia_lerobot.datasets.tables import DRAWN, SEED
from labutopia_lerobot.evaluation.condition import Condition
from labutopia_lerobot.evaluation.rows import EvaluationSummary
from labutopia_lerobot.evaluation.uncertainty.intervals import exact, wilson
from labutopia_lerobot.hub.dataset_card import card_of_dataset, size_category
from labutopia_lerobot.hub.dataset_facts import DatasetFacts
from labutopia_lerobot.hub.feature_meanings import meaning
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.setting import Setting

KEPT = sorted(make_cards.CARDS.glob("*.json"))


def facts(**recorded: object) -> DatasetFacts:
    """Return the facts of a sample of `level1/press`, two seeds of which failed."""
    setting = Setting("level1/press", cameras=("front",), width=64, height=64)
    features = {
        key: feature | {"shape": list(feature["shape"])}
        for key, feature in dataset_features(setting).items()
    }
    numbers = {"min": [0.0], "max": [1.0], "mean": [0.5], "std": [0.25]}
    statistics = {
        key: {
            name: value * (3 if "images" in key else feature["shape"][0])
            for name, value in numbers.items()
        }
        for key, feature in features.items()
        if feature["dtype"] != "string"
    }
    config = {"task": "level1/press", "repo_id": "local/press", "episodes": 3, "split": "train"}
    config |= {"axes": [], "room": "laboratory", "liquid": "on", "cameras": ["front"], "seed": 0}
    reported = "Press the red button on the control panel and keep it pressed."
    return DatasetFacts(
        info={"features": features, "fps": 30, "total_episodes": 3, "total_frames": 600}
        | {"robot_type": "panda", "codebase_version": "v3.0"},
        statistics=statistics,
        recording={
            "config": config | recorded,
            "code": {"commit": "abc", "uncommitted_changes": False, "sources": "0" * 64},
            "versions": {"mujoco": "4.0.0", "transformers": None},
            "renderers": ["llvmpipe"],
            "failures": [{"seed": 1, "cause": "press/push not done after 4 s"}],
        },
        columns=[SEED, DRAWN],
        episodes=[
            {"seed": seed, "frames": 200, "outcome": "success", "tasks": [reported]}
            for seed in (0, 2, 3)
        ],
        size_bytes=1_500_000,
    )


def expert(task: str = "level1/press", policy: str = "expert") -> EvaluationSummary:
    return EvaluationSummary(
        policy=policy,
        condition=Condition(task, obs="state", liquid=None),
        sequential=False,
        n=100,
        successes=99,
        rate=0.99,
        wilson95=wilson(99, 100),
        exact95=exact(99, 100),
        anytime95=(0.9, 1.0),
        ever_rate=1.0,
        mean_seconds_to_success=6.7,
    )


@pytest.fixture(scope="module")
def rates() -> list[EvaluationSummary]:
    """The expert's rates, of which every card shows its own."""
    return make_cards.expert_results()


@pytest.mark.parametrize("file", KEPT, ids=lambda file: file.stem)
def test_a_kept_card_is_up_to_date(file: Path, rates: list[EvaluationSummary]) -> None:
    cure = "python scripts/make_cards.py --text, or without --text if the dataset has changed"
    card = file.with_suffix(".md").read_text()
    assert card == make_cards.card(file, rates), cure
    reported = DatasetFacts.load(file)
    (task,) = reported.tasks
    setting = Setting(task, split=reported.config["split"])
    for key, declared in dataset_features(setting).items():
        there = reported.info["features"][key]
        assert there["shape"] == list(declared["shape"]), (key, cure)
        assert there["names"] == declared["names"], (key, cure)
    for episode in reported.episodes:
        instruction = draw_scenario(setting, episode["seed"]).task.instruction
        assert episode["tasks"] == [instruction], cure
        assert instruction in card
    assert file.with_suffix(".jpg").stat().st_size > 0


def test_the_hub_reads_the_metadata() -> None:
    data = DatasetCard(card_of_dataset(facts(), "local/press")).data.to_dict()
    assert data["license"] == "apache-2.0"
    assert data["task_categories"] == ["robotics"]
    assert data["size_categories"] == ["n<1K"]
    assert data["configs"] == [{"config_name": "default", "data_files": "data/*/*.parquet"}]
    assert {"LeRobot", "simulation", "panda"} <= set(data["tags"])


def test_a_card_says_what_the_dataset_is() -> None:
    card = card_of_dataset(
        facts(), "me/press", [expert(), expert("level1/pick"), expert(policy="act")]
    )
    assert "> Press the red button on the control panel and keep it pressed." in card
    assert "| seeds | 0 to 3 |" in card
    assert "| `action` | float32 | 8 | rad; gripper m |" in card
    assert "| `observation.images.front` | red | 0 | 1 | 0.5 | 0.25 |" in card
    assert "succeeded in 3 of 4 (95 %: 30 to 95 %) attempts; only successes are stored." in card
    assert "Seed 1 failed: press/push not done after 4 s." in card
    assert card.count("99 of 100 (95 %: 95 to 100 %)") == 1
    assert "mujoco 4.0.0." in card
    assert "labutopia-record task=level1/press episodes=3 cameras=[front]" in card
    assert 'LeRobotDataset("me/press")' in card
    assert "visualize_dataset?path=me/press" in card


def test_the_card_of_a_step_that_was_cut_says_how_to_cut_it() -> None:
    card = card_of_dataset(facts(step="1_press", cut=True), "me/press-1_press")
    recorded, cut = "labutopia-record task=level1/press episodes=3", "labutopia-cut "
    made = card.partition(recorded)[2].partition("```")[0].splitlines()
    assert "step=" not in made[0]
    assert made[1] == f"{cut}outputs/datasets/level1/press --step=1_press"


def test_what_is_not_released_says_so() -> None:
    card = card_of_dataset(facts(), "local/press")
    assert "Not released" in card
    assert "visualize_dataset" not in card
    assert 'root="outputs/datasets/level1/press"' in card


def test_tasks_that_are_together_are_all_named() -> None:
    card = card_of_dataset(facts(task=["level1/press", "level1/pick"]), "me/level1")
    assert "# LabUtopia, 2 tasks" in card
    assert "`level1/press`, `level1/pick`, robot" in card
    assert "labutopia-record task=[level1/press,level1/pick]" in card


@pytest.mark.parametrize("obs", ["pixels", "state"])
@pytest.mark.parametrize("task", task_files())
def test_every_feature_of_ours_has_a_meaning(task: str, obs: str) -> None:
    for key in dataset_features(Setting(task, obs=obs)):
        assert meaning(key) is not None, key


@pytest.mark.parametrize(
    ("frames", "reported"),
    [(999, "n<1K"), (1000, "1K<n<10K"), (99_999, "10K<n<100K"), (100_000, "100K<n<1M")],
)
def test_sizes_have_the_names_of_the_hub(frames: int, reported: str) -> None:
    assert size_category(frames) == reported
