"""The multilayer perceptron is a policy of LeRobot as its own ones are."""

from pathlib import Path

import pytest
import torch
from lerobot.configs import FeatureType, PolicyFeature
from lerobot.policies import make_pre_post_processors
from lerobot.policies.factory import get_policy_class, make_policy_config
from lerobot.utils.import_utils import register_third_party_plugins

from labutopia_lerobot.behaviour_cloning.configuration_mlp import MLPConfig, MLPOptionError
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.learned_policy import LearnedPolicy
from labutopia_lerobot.setting import Setting

INPUTS = {
    "observation.state": PolicyFeature(FeatureType.STATE, (8,)),
    "observation.environment_state": PolicyFeature(FeatureType.ENV, (13,)),
}
OUTPUTS = {"action": PolicyFeature(FeatureType.ACTION, (8,))}


def made(**options) -> MLPConfig:
    register_third_party_plugins()
    small = {"hidden": [16, 16], "chunk_size": 4, "n_action_steps": 3, "device": "cpu"}
    features = {"input_features": INPUTS, "output_features": OUTPUTS}
    return make_policy_config("mlp", **(features | small | options))


def batch(frames: int = 32) -> dict[str, torch.Tensor]:
    torch.manual_seed(0)
    states = torch.randn(frames, 8)
    return {
        "observation.state": states,
        "observation.environment_state": torch.randn(frames, 13),
        "action": states[:, None, :].repeat(1, 4, 1),
        "action_is_pad": torch.zeros(frames, 4, dtype=torch.bool),
    }


def test_it_learns_what_depends_on_the_state():
    torch.manual_seed(0)
    policy = get_policy_class("mlp")(made())
    optimiser = made().get_optimizer_preset().build(policy.get_optim_params())
    shown = batch()
    first, _ = policy.forward(shown)
    for _ in range(400):
        loss, _ = policy.forward(shown)
        loss.backward()
        optimiser.step()
        optimiser.zero_grad()
    assert loss < first / 2


def test_what_lies_behind_the_end_of_an_episode_teaches_nothing():
    policy = get_policy_class("mlp")(made())
    shown = batch()
    shown["action_is_pad"][:, 2:] = True
    loss, _ = policy.forward(shown)
    shown["action"][:, 2:] = 1e6
    assert policy.forward(shown)[0] == loss


def test_a_chunk_is_played_as_far_as_it_is_to_be_and_forgotten_at_a_reset():
    policy = get_policy_class("mlp")(made())
    first, other = batch(1), {key: value + 1 for key, value in batch(1).items() if "obs" in key}
    chunk = policy.predict_action_chunk(first)[0]
    played = [policy.select_action(seen)[0] for seen in (first, other, other, other)]
    for said, done in zip(chunk[:3], played[:3], strict=True):
        assert torch.equal(said, done)
    assert torch.equal(played[3], policy.predict_action_chunk(other)[0][0])
    policy.select_action(first)
    policy.reset()
    assert torch.equal(policy.select_action(first)[0], chunk[0])


def test_a_mean_over_chunks_is_played_where_it_is_asked_for_and_forgotten_at_a_reset():
    policy = get_policy_class("mlp")(made(n_action_steps=1, temporal_ensemble_coeff=0.0))
    first, other = batch(1), {key: value + 1 for key, value in batch(1).items() if "obs" in key}
    chunks = [policy.predict_action_chunk(seen)[0] for seen in (first, other)]
    assert torch.equal(policy.select_action(first)[0], chunks[0][0])
    mean = (chunks[0][1] + chunks[1][0]) / 2
    assert torch.allclose(policy.select_action(other)[0], mean)
    policy.reset()
    assert torch.equal(policy.select_action(other)[0], chunks[1][0])


def test_what_was_seen_before_counts_where_it_is_asked_for():
    policy = get_policy_class("mlp")(made(n_obs_steps=2, n_action_steps=1))
    first, other = batch(1), {key: value + 1 for key, value in batch(1).items() if "obs" in key}
    shown = {key: torch.stack([first[key], other[key]], dim=1) for key in other}
    learned = shown | {key: first[key] for key in ("action", "action_is_pad")}
    loss, _ = policy.forward(learned)
    policy.select_action(first)
    said = policy.predict_action_chunk(other)
    assert torch.isclose((said - first["action"]).abs().mean(), loss)
    policy.reset()
    still = policy.predict_action_chunk(other)
    assert not torch.equal(still, said)
    assert torch.equal(policy.predict_action_chunk(other), still)  # as if it had always been so


def test_the_evaluator_plays_what_was_saved(tmp_path: Path):
    config = made()
    get_policy_class("mlp")(config).save_pretrained(tmp_path)
    sizes = {key: feature.shape for key, feature in {**INPUTS, **OUTPUTS}.items()}
    statistics = {
        key: {
            "mean": torch.zeros(size),
            "std": torch.ones(size),
            "min": -torch.ones(size),
            "max": torch.ones(size),
        }
        for key, size in sizes.items()
    }
    for processor in make_pre_post_processors(config, dataset_stats=statistics):
        processor.save_pretrained(tmp_path)
    env = LabEnv(Setting("level1/pick", obs="state"))
    policy = LearnedPolicy(tmp_path, "cpu")
    observation, _ = env.reset(seed=0)
    policy.start(env, 0)
    assert policy.act(observation).shape == (8,)


@pytest.mark.parametrize(
    "options",
    [
        {"n_obs_steps": 0},
        {"n_action_steps": 5},
        {"n_action_steps": 0},
        {"temporal_ensemble_coeff": 0.01},
        {"hidden": []},
    ],
    ids=str,
)
def test_impossible_options_are_refused(options):
    with pytest.raises(MLPOptionError):
        made(**options)


def test_pictures_and_missing_states_are_refused():
    eye = {"observation.images.front": PolicyFeature(FeatureType.VISUAL, (3, 64, 64))}
    with pytest.raises(MLPOptionError, match="sees no pictures"):
        made(input_features=INPUTS | eye).validate_features()
    with pytest.raises(MLPOptionError, match=r"needs observation\.environment_state"):
        made(input_features=dict(list(INPUTS.items())[:1])).validate_features()
