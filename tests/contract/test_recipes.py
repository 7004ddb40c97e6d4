"""Recipes: the steps of an epoch are those that LeRobot trains."""

import json
from pathlib import Path

import pyarrow as pa
import pytest
from lerobot.configs.train import TrainPipelineConfig
from pyarrow import parquet

from labutopia_lerobot.cli import recipe
from labutopia_lerobot.datasets.dataset_folder import NoDatasetError, dataset_folder
from labutopia_lerobot.experiments.recipe import RecipeError, trained_frames, training_command
from labutopia_lerobot.runtime.shipped import shipped
from labutopia_lerobot.setting import CAMERAS


@pytest.fixture
def dataset(tmp_path: Path) -> Path:
    """What a dataset of twenty episodes, 100 to 119 frames long, says of itself."""
    root = tmp_path / "level1" / "pick"
    (root / "meta" / "episodes").mkdir(parents=True)
    features = {"observation.images.front": {"dtype": "video"}}
    (root / "meta" / "info.json").write_text(json.dumps({"features": features}))
    table = {
        "episode_index": list(range(20)),
        "tasks": [["Pick it up."]] * 20,
        "length": list(range(100, 120)),
    }
    parquet.write_table(pa.table(table), root / "meta" / "episodes" / "file-000.parquet")
    return root


def option(command: list[str], name: str) -> str:
    (value,) = [part.partition("=")[2] for part in command if part.startswith(f"--{name}=")]
    return value


def test_two_hundred_epochs_become_steps(dataset: Path) -> None:
    command = training_command("act", dataset, epochs=200, batch_size=None, out=None)
    frames = sum(range(100, 118))  # the last two of twenty episodes are held out
    assert int(option(command, "steps")) == -(-200 * frames // 128)
    assert option(command, "config_path") == str(shipped("policies") / "act" / "train.json")
    assert option(command, "output_dir") == "outputs/train/act/level1/pick"
    halved = training_command("act", dataset, epochs=200, batch_size=64, out=None)
    assert int(option(halved, "steps")) == -(-200 * frames // 64)


def test_each_task_holds_out_its_own_and_last_frames_may_be_left_out() -> None:
    episodes = [("a", 50), ("b", 10), ("a", 60), ("b", 20)]
    recipe = {"dataset": {"eval_split": 0.5}, "policy": {"drop_n_last_frames": 7}}
    assert trained_frames(episodes, recipe) == 50 - 7 + 10 - 7


def test_without_epochs_the_recipes_steps_stand(dataset: Path) -> None:
    command = training_command("act", dataset, epochs=None, batch_size=None, out=Path("here"))
    assert not [part for part in command if part.startswith("--steps")]
    assert option(command, "output_dir") == "here"


def test_a_dataset_without_pictures_gets_the_recipe_for_states(dataset: Path) -> None:
    features = {"observation.environment_state": {"dtype": "float32"}}
    (dataset / "meta" / "info.json").write_text(json.dumps({"features": features}))
    command = training_command("act", dataset, None, None, None)
    assert option(command, "config_path").endswith("act/train_state.json")
    with pytest.raises(RecipeError, match="smolvla has no recipe for a dataset without pictures"):
        training_command("smolvla", dataset, None, None, None)


def test_the_folder_of_a_training_is_that_of_the_task_wherever_the_dataset_lies(
    dataset: Path, tmp_path: Path
) -> None:
    moved = dataset.rename(tmp_path / "mine")
    file = moved / "meta" / "labutopia.json"
    for recorded, place in [
        ({"task": "level1/press"}, "level1/press"),
        ({"task": "level4/clean_beaker", "step": "3_place"}, "level4/clean_beaker/3_place"),
        ({"task": ["level1/pick", "level1/press"]}, f"{tmp_path.name}/mine"),
    ]:
        file.write_text(json.dumps({"config": recorded}))
        command = training_command("act", moved, None, None, None)
        assert option(command, "output_dir") == f"outputs/train/act/{place}"


def test_of_a_training_that_is_there_already_it_says_how_to_go_on_beside_the_command(
    dataset: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    out = tmp_path / "trained"
    monkeypatch.setattr("sys.argv", ["labutopia-recipe", "act", str(dataset), "--out", str(out)])
    recipe.main()
    assert capsys.readouterr().err == ""
    out.mkdir()
    recipe.main()
    said = capsys.readouterr()
    assert said.out.startswith("lerobot-train ")
    assert f"go on: lerobot-train --config_path={out}/checkpoints/last/" in said.err


def test_the_folder_above_datasets_is_reported_with_those_in_it(dataset: Path) -> None:
    for folder in (dataset.parent, dataset.parents[1]):
        with pytest.raises(NoDatasetError, match=f"In it are: {dataset}$"):
            training_command("act", folder, None, None, None)
        with pytest.raises(NoDatasetError, match="In it are"):
            dataset_folder(str(folder))
    with pytest.raises(NoDatasetError, match="Make one: labutopia-record level1/pick"):
        dataset_folder("nothere")
    assert dataset_folder(str(dataset)) == dataset


def test_mistakes_are_reported(dataset: Path, tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match="Recipes: act, act_small, diffusion, mlp, pi0, smolvla"):
        training_command("pick", dataset, None, None, None)
    with pytest.raises(NoDatasetError, match="is no LeRobotDataset"):
        training_command("act", tmp_path, None, None, None)
    with pytest.raises(RecipeError, match="--epochs 0 is too small"):
        training_command("act", dataset, 0, None, None)


def test_every_recipe_names_options_of_lerobot_only() -> None:
    known = set(TrainPipelineConfig.__dataclass_fields__)
    for file in shipped("policies").glob("*/*.json"):
        assert set(json.loads(file.read_text())) <= known, file


def test_recipes_map_cameras_that_are_recorded_and_leave_the_video_decoder_to_lerobot() -> None:
    recorded = {f"observation.images.{camera}" for camera in CAMERAS}
    for file in shipped("policies").glob("*/train*.json"):
        recipe = json.loads(file.read_text())
        assert set(recipe.get("rename_map", {})) <= recorded, file
        assert "video_backend" not in recipe["dataset"], file
