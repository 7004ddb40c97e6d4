"""Experiments: what a command line means, what is refused before anything is done."""

import json
from pathlib import Path

import pytest

from labutopia_lerobot.cli.experiment import parse
from labutopia_lerobot.datasets.disk_space import NoSpaceError
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments.experiment import experiment_files
from labutopia_lerobot.experiments.part_record import BEGUN, DONE, PartRecord, PartRecords
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.planning import check, evaluations, parts_of
from labutopia_lerobot.experiments.rates import Cost, Rates, cost_of, price_list
from labutopia_lerobot.experiments.requirements import NoMemoryError, require_room
from labutopia_lerobot.experiments.warm_up import warm_up

PICK = ("level1/pick", "obs=state", "policy=act")

TWO_STUDIES = """
obs: state
episodes: 7
studies:
  - {policy: act, task: level1/pick, episodes: 5}
  - {policy: [expert, diffusion], task: level1/press}
"""


def planned(*words: str) -> list:
    return parts_of(parse(words))


def names(*words: str) -> list[str]:
    return [part.name for part in planned(*words)]


def test_one_task_is_recorded_verified_trained_and_evaluated_in_this_order():
    assert names(*PICK) == [
        "record level1/pick state 100",
        "verify level1/pick state 100",
        "train act level1/pick state 100",
        "evaluate act level1/pick state 100 id",
    ]


def test_a_learning_curve_has_a_recording_and_a_training_for_every_number():
    parts = planned(*PICK, "demonstrations=[25,10]")
    assert [part.recording.demonstrations for part in parts if isinstance(part, TrainingPart)] == [
        10,
        25,
    ]


def test_success_over_steps_plays_weights_that_the_training_keeps():
    parts = planned(*PICK, "evaluate_at=[500,1500]", "steps=2000")
    (training,) = (part for part in parts if isinstance(part, TrainingPart))
    assert "--save_freq=500" in training._said()
    assert [part.at for part in evaluations(parts)] == [500, 1500, None]
    places = {str(evaluation.place) for evaluation in evaluations(parts)}
    assert len(places) == 3


def test_trainings_that_differ_in_their_seed_share_a_recording_and_begin_with_the_recipes_own():
    words = (*PICK, "evaluate_at=[500]")
    once, parts = planned(*words), planned(*words, "trainings=3")
    assert parts[: len(once)] == once
    assert [part.name for part in parts[len(once) :]] == [
        "train act level1/pick state 100 seed1001",
        "evaluate act level1/pick state 100 seed1001 id",
        "train act level1/pick state 100 seed1002",
        "evaluate act level1/pick state 100 seed1002 id",
    ]
    assert len({part.place for part in parts}) == len(parts)
    trainings = [part for part in parts if isinstance(part, TrainingPart)]
    seeds = [[word for word in part._said() if "seed" in word] for part in trainings]
    assert seeds == [[], ["--seed=1001"], ["--seed=1002"]]


def test_every_step_of_a_staged_task_is_trained_from_every_seed():
    words = ("level4/clean_beaker", "obs=state", "policy=act", "play=staged", "trainings=2")
    parts = planned(*words)
    first, second = evaluations(parts)
    assert (first.repeat, second.repeat) == (0, 1)
    assert [training.step for training in second.trainings] == [
        training.step for training in first.trainings
    ]
    assert all("--seed=1001" in training._said() for training in second.trainings)
    assert second.place != first.place


def test_steps_of_a_task_are_trained_alone_and_judged_in_turn():
    parts = planned("level4/clean_beaker", "obs=state", "policy=act", "play=staged")
    trainings = [part for part in parts if isinstance(part, TrainingPart)]
    (evaluation,) = evaluations(parts)
    assert [training.step for training in trainings][:3] == ["1_pick", "2_pour", "3_place"]
    assert evaluation.trainings == tuple(trainings)


def test_one_recording_serves_who_plays_all_steps_and_who_plays_one():
    made = names("level4/clean_beaker", "obs=state", "policy=act", "play=both")
    whole, *_ = trained = [name for name in made if name.startswith("train")]
    assert whole == "train act level4/clean_beaker state 100"
    assert len(trained) == 1 + 7
    assert [name for name in made if name.startswith(("record", "verify"))] == [
        "record level4/clean_beaker state 100",
        "verify level4/clean_beaker state 100",
    ]
    cut = made.index("cut level4/clean_beaker-1_pick state 100")
    assert made.index("verify level4/clean_beaker state 100") < cut
    assert cut < made.index("train act level4/clean_beaker-1_pick state 100")


def test_every_axis_by_itself_is_an_evaluation_of_its_own():
    parts = planned("level3/pick", "obs=state", "policy=expert", "shifts=[object,layout]")
    assert [evaluation.shift.name for evaluation in evaluations(parts)] == [
        "id",
        "ood-object",
        "ood-layout",
    ]


def test_the_command_line_wins_over_a_study_and_a_study_over_its_file(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(TWO_STUDIES)
    chosen = parse([f"experiment={file}"])
    assert [study.episodes for study in chosen.studies] == [5, 7]
    assert chosen.out == Path("outputs/experiments/mine")
    assert {study.episodes for study in parse([f"experiment={file}", "episodes=3"]).studies} == {3}


def test_a_list_of_one_is_written_in_a_file_as_on_the_command_line(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text("{policy: expert, task: level1/pick, studies: [{axes: all}, {axes: light}]}")
    experiment = parse([f"experiment={file}"])
    assert [study.shifts[0].axes for study in experiment.studies] == [("all",), ("light",)]


def test_one_line_of_a_table_can_be_repeated_alone(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(TWO_STUDIES)
    assert all("level1/press" in name for name in names(f"experiment={file}", "only=level1/press"))


@pytest.mark.parametrize("name", experiment_files())
def test_the_experiments_that_come_with_the_package_fit_their_tasks_and_recipes(name):
    tasks = {task for study in parse([f"experiment={name}"]).studies for task in study.tasks}
    judged = tasks & {"level1/pick", "level1/pour", "level3/pick", "level4/clean_beaker"}
    assert judged
    for only in judged:
        check(planned(f"experiment={name}", f"only={only}"))


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("policy=act", "obs=state", "level1/pikc"), "Did you mean 'level1/pick'"),
        (("level1/pick",), "Name a policy"),
        ((*PICK, "steps=5", "epochs=2"), "steps= and epochs= say the same"),
        ((*PICK, "episodes=0"), "episodes=0 is impossible"),
        ((*PICK, "demonstrations=[10,x]"), "demonstrations='x' is impossible"),
        ((*PICK, "splt=ood"), "Did you mean 'split='"),
        ((*PICK, "only=level1/press"), "only=level1/press is no task of"),
        ((*PICK, "training=[a]"), "is no map of options"),
        ((*PICK, "trainings=0"), "trainings=0 is impossible"),
        ((*PICK, "trainings=1.5"), "trainings: Value '1.5' of type 'float' could not be"),
        ((*PICK, "trainings=2", "training={seed: 3}"), "both decide the seed"),
        ((*PICK, "trainings=2", "training=5"), "is no map of options"),
        ((*PICK, "training={steps: 10}"), "training={steps}: an experiment decides that itself"),
        ((*PICK, "training={policy.device: cuda}"), "Say device="),
        ((*PICK, "device=cudda"), "device=cudda is none of torch"),
        ((*PICK, "split=[]"), "Nothing is evaluated"),
        ((*PICK, "demonstrations=[]"), "Nothing is learned from"),
        ((*PICK, "label=../up"), "is to be a folder's name"),
        ((*PICK, "axes=[[a]]"), "is no list of names"),
        ((*PICK, "control=mlp"), "control=mlp is no other policy of level1/pick here"),
        (("experiment=results_cp",), "Did you mean 'results_cpu'"),
        ((*PICK, "policy=[act,diffusion]", "label=x"), "label=x names one policy of 2"),
        ((*PICK, "launcher=slurm"), "'slurm'"),
        ((*PICK, "policy=expert", "kit=K"), "no policy of experiment is trained. Leave kit= out"),
    ],
)
def test_a_wrong_word_is_reported_with_the_cure(words, reported):
    with pytest.raises(UserError, match=reported.replace("[", r"\[")):
        parse(words)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        ((*PICK, "policy=smolvla"), "smolvla has no recipe for a dataset without pictures"),
        ((*PICK, "policy=actt"), "'actt' is no recipe"),
        ((*PICK, "demonstrations=1"), "demonstrations=1 is too few"),
        ((*PICK, "steps=100", "evaluate_at=[200]"), "comes after the training of act"),
        ((*PICK, "shifts=[size]"), "size"),
        ((*PICK, "play=staged"), "play=staged needs several steps"),
        ((*PICK, "training={policy.chunk: 20}"), "act/train_state.json: unrecognized arguments"),
        (
            (*PICK, "training={policy.chunk_size: x}"),
            "`chunk_size`: Couldn't parse 'x' into an int",
        ),
        ((*PICK, "training={num_workers: -1}"), "num_workers option should be non-negative"),
        (
            (*PICK, "training={num_workers: 1, prefetch_factor: -1}"),
            "prefetch_factor option should be non-negative",
        ),
        ((*PICK, "training={optimizer.lr: -1}"), "Invalid learning rate: -1"),
        (
            (*PICK, "training={policy.optimizer_lr: 0.1}"),
            "=false ignores --policy.optimizer_lr=0.1; say optimizer",
        ),
        ((*PICK, "training={seed: -1}"), "seed -1 is not from 0 to 4294967295"),
        ((*PICK, "training={policy.n_obs_steps: 3}"), "Multiple observation steps not handled yet"),
        ((*PICK, "extras=[depth]"), "needs cameras"),
    ],
)
def test_what_does_not_fit_is_refused_before_anything_is_done(words, reported, tmp_path):
    with pytest.raises(UserError, match=reported):
        check(planned(*words, f"out={tmp_path / 'new'}"))
    assert not (tmp_path / "new").exists()


def test_two_studies_that_make_one_thing_differently_are_refused(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(
        "studies:\n"
        "  - {policy: act, obs: state, task: level1/pick}\n"
        "  - {policy: act, obs: state, task: level1/pick, steps: 9}\n"
    )
    with pytest.raises(UserError, match="give one of them a label="):
        planned(f"experiment={file}")
    file.write_text(file.read_text().replace("steps: 9", "steps: 9, label: brief"))
    assert "train brief level1/pick state 100" in names(f"experiment={file}")


@pytest.mark.parametrize(
    ("content", "reported"),
    [
        ("studies: 3", "no list of maps"),
        ("- 3", "no map of options"),
        ("studies:\n - {polcy: act}", "'polcy' is no option. Did you mean 'policy'"),
        ("studies:\n - {policy: act, episodes: many}", "mine.yaml: episodes: Value 'many'"),
        ("studies: [", "cannot be read"),
    ],
)
def test_a_damaged_file_is_refused(tmp_path, content, reported):
    file = tmp_path / "mine.yaml"
    file.write_text(content)
    with pytest.raises(UserError, match=reported):
        parse([f"experiment={file}"])


def record(part, seconds: float, size: float, *, machine: str = "here", state: str = DONE):
    return PartRecord(
        part.name,
        part.rate_key,
        state,
        {},
        machine,
        size=size,
        volume=1.0,
        seconds=seconds,
        startup_s=10.0,
        stored_bytes=1_000_000,
        memory_bytes=2_000_000_000,
    )


def test_time_is_that_of_earlier_parts_on_this_machine_beyond_their_start_up():
    *_, training, _evaluation = planned(*PICK, "steps=1000")
    rates = Rates.of(
        [record(training, 30.0, 100.0), record(training, 9e9, 1.0, machine="x")], "here"
    )
    assert rates.seconds(training) == pytest.approx(10.0 + 1000 * 20.0 / 100.0)
    assert rates.seconds(training, 0.5) == pytest.approx(10.0 + 500 * 20.0 / 100.0)


def test_what_nobody_has_measured_says_so():
    parts = planned(*PICK, "steps=1000")
    training = parts[2]
    half = Rates.of([record(training, 30.0, 100.0, state=BEGUN)], "here")
    assert cost_of([training], half).unknown == {"seconds", "stored_bytes", "memory_bytes"}
    assert price_list(parts, parts, half).lines[-1][3] == "not measured"
    known = Rates.of([record(training, 30.0, 100.0)], "here")
    assert price_list(parts, parts, known).lines[-1][3].endswith(" +")


def test_the_warm_up_measures_every_unknown_rate_once_and_in_small(tmp_path):
    pending = planned(*PICK, "demonstrations=[10,25]", "evaluate_at=[500]")
    small = warm_up(pending, Rates(()), tmp_path)
    assert [part.name.split()[0] for part in small] == ["record", "verify", "train", "evaluate"]
    assert {part.rate_key for part in small} == {part.rate_key for part in pending}
    assert all(part.out == tmp_path / "warm_up" for part in small)
    assert sum(part.size for part in small) < sum(part.size for part in pending) / 10
    known = Rates(tuple(record(part, 1.0, 1.0) for part in small))
    assert warm_up(pending, known, tmp_path) == []


def test_a_machine_without_room_or_memory_is_told_before(tmp_path):
    with pytest.raises(NoSpaceError, match="takes about"):
        require_room(tmp_path / "new", Cost(0.0, 1e18, 0.0, frozenset()))
    with pytest.raises(NoMemoryError, match="End other programs"):
        require_room(tmp_path / "new", Cost(0.0, 0.0, 1e18, frozenset()))
    require_room(tmp_path / "new", Cost(0.0, 0.0, 0.0, frozenset()))


def test_a_record_survives_its_file(tmp_path):
    part = planned(*PICK, f"out={tmp_path}")[0]
    records = PartRecords(tmp_path)
    assert records.of(part) is None
    records.keep(part, record(part, 1.0, 2.0))
    assert records.of(part) == record(part, 1.0, 2.0)
    records.drop(part)
    assert list(records.all()) == []


def test_a_policy_is_asked_for_by_the_weights_that_were_trained_here(tmp_path):
    *_, evaluation = planned(*PICK, f"out={tmp_path}")
    assert isinstance(evaluation, EvaluationPart)
    command = evaluation.command()
    assert any(word.startswith(f"policy.path={tmp_path}") for word in command)
    assert f"out={evaluation.place}" in command


def test_a_training_that_comes_back_from_elsewhere_must_be_the_one_that_was_asked_for(tmp_path):
    said_beside = "training={policy.chunk_size: 20, policy.input_features: null}"
    _, _, training, _ = planned(*PICK, said_beside, f"out={tmp_path}")
    assert isinstance(training, TrainingPart)
    folder = training.place / "checkpoints" / "last" / "pretrained_model"
    folder.mkdir(parents=True)
    chosen = {"type": "act", "chunk_size": 20, "input_features": {"observation.state": {}}}
    made = {"policy": chosen, "batch_size": 64, "seed": 1000}

    def said(config):
        (folder / "train_config.json").write_text(json.dumps(config))
        return training.made_otherwise()

    assert said(made) == ""
    assert "policy.type=diffusion, not act" in said({**made, "policy": {"type": "diffusion"}})
    assert "batch_size=8, not 64" in said({**made, "batch_size": 8})
    assert "seed=7, not 1000" in said({**made, "seed": 7})
    other = {"type": "act", "chunk_size": 40}
    assert "policy.chunk_size=40, not 20" in said({**made, "policy": other})
