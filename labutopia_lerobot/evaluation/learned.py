"""A policy that LeRobot trained, played as `lerobot-eval` plays it. Imports torch."""

from contextlib import nullcontext, redirect_stdout
from pathlib import Path

import torch
from lerobot.configs import PreTrainedConfig
from lerobot.envs import preprocess_observation
from lerobot.policies import PreTrainedPolicy, make_pre_post_processors
from lerobot.policies.factory import get_policy_class

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.policies import Action
from labutopia_lerobot.evaluation.processors import require_harmless


class UnusableWeightsError(UserError):
    """A checkpoint whose weights do not fit, or a device that is not there."""


class LearnedPolicy:
    """Observation -> saved preprocessor -> network -> saved postprocessor -> action.

    The batch size is 1 and the thread count is fixed, because results differ in the last bits
    between batch sizes and thread counts, and contacts amplify that.

    Args:
        folder: A `pretrained_model` folder of LeRobot.
        device: `cpu`, `cuda` or another device of torch; None for CUDA where there is one.

    Attributes:
        device: The device that it runs on.

    Raises:
        CheckpointError: If the processors could run code.
        UnusableWeightsError: If the weights do not fit the configuration, or there is no such
            device.
    """

    def __init__(self, folder: Path, device: str | None) -> None:
        require_harmless(folder)  # here too: whoever loads a policy comes through here
        torch.set_num_threads(1)
        config = PreTrainedConfig.from_pretrained(folder)
        self.device = config.device = _require_device(device)
        config.pretrained_path = folder
        if hasattr(config, "pretrained_backbone_weights"):
            # They would be downloaded, only to be overwritten by those of the checkpoint.
            config.pretrained_backbone_weights = None
        self._policy = _load(folder, config)
        self._preprocessor, self._postprocessor = make_pre_post_processors(
            config,
            pretrained_path=str(folder),
            preprocessor_overrides={"device_processor": {"device": config.device}},
        )
        self._precision = (
            torch.autocast(torch.device(config.device).type) if config.use_amp else nullcontext()
        )

    def start(self, env: LabEnv, seed: int) -> None:
        """Forget the previous episode."""
        self._instruction = env.task_description
        # Diffusion and flow policies draw their noise from torch's global generator.
        torch.manual_seed(seed)
        self._policy.reset()

    def act(self, observation: Observation) -> Action:
        """Return the next action."""
        batch = preprocess_observation(observation)
        batch["task"] = [self._instruction]
        with torch.inference_mode(), self._precision:
            actions = self._postprocessor(self._policy.select_action(self._preprocessor(batch)))
        action: Action = actions.to("cpu").numpy()[0]
        return action


def _require_device(device: str | None) -> str:
    if device is None:
        return "cuda" if torch.cuda.is_available() else "cpu"
    try:
        torch.empty(0, device=device)
    except (RuntimeError, AssertionError) as error:
        reason = str(error).splitlines()[0]
        raise UnusableWeightsError(f"policy.device={device} cannot be used: {reason}") from None
    return device


def _load(folder: Path, config: PreTrainedConfig) -> PreTrainedPolicy:
    try:
        with redirect_stdout(None):  # LeRobot prints a line, which would cut the progress bar
            return get_policy_class(config.type).from_pretrained(folder, config=config, strict=True)
    except (RuntimeError, ImportError) as error:
        raise UnusableWeightsError(f"{folder} cannot be loaded: {error}") from None
