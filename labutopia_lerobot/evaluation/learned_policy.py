"""A policy that LeRobot trained, played as `lerobot-eval` plays it. Imports torch."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext, redirect_stdout
from io import StringIO
from pathlib import Path

import torch
from lerobot.configs import PreTrainedConfig
from lerobot.envs import preprocess_observation
from lerobot.policies import PreTrainedPolicy, make_pre_post_processors
from lerobot.policies.factory import get_policy_class
from lerobot.utils.import_utils import register_third_party_plugins, require_package

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.checkpoint_security import (
    require_safe_checkpoint,
    require_safe_model,
)
from labutopia_lerobot.evaluation.policies import Action

NOT_LOADED = "Could not load state dict"
"""Message of LeRobot 0.6.1 before it goes on, without raising, with random weights (pi0, pi0.5:
`PI0Policy.from_pretrained`)."""


class UnusableWeightsError(UserError):
    """A checkpoint whose weights do not fit, or a device that is not there."""


class LearnedPolicy:
    """Observation -> saved preprocessor -> network -> saved postprocessor -> action.

    The batch size is 1 and the thread count is fixed, because results differ in the last bits
    between batch sizes and thread counts, and contacts amplify that.

    Args:
        folder: A `pretrained_model` folder of LeRobot.
        device: `cpu`, `cuda` or another device of torch; None for CUDA where there is one.
        base: Folder of the policy that `folder` adapts, if that is a LoRA adapter.
        rename: Our key -> what the policy calls it, or None for those of its training.

    Attributes:
        device: The device that it runs on.

    Raises:
        CheckpointError: If the checkpoint could run code.
        UnusableWeightsError: If the weights do not fit the configuration, or there is no such
            device.
    """

    def __init__(
        self,
        folder: Path,
        device: str | None,
        base: Path | None = None,
        rename: Mapping[str, str] | None = None,
    ) -> None:
        require_safe_checkpoint(folder)  # here too: every load of a policy comes through here
        if base is not None:
            require_safe_model(base)
        torch.set_num_threads(1)
        self.device = _require_device(device)
        with _loading(folder):
            config = _config(folder, self.device)
            self._policy = _load(folder, base, config)
            overrides = {"device_processor": {"device": config.device}}
            if rename is not None:
                overrides["rename_observations_processor"] = {"rename_map": dict(rename)}
            self._preprocessor, self._postprocessor = make_pre_post_processors(
                config,
                pretrained_path=str(folder),
                preprocessor_overrides=overrides,
            )
        # On a GPU alone, as where LeRobot drives robots: a processor's bfloat16 is for training.
        on_gpu = torch.device(config.device).type == "cuda"
        self._precision = torch.autocast("cuda") if config.use_amp and on_gpu else nullcontext()

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
            chosen = self._policy.select_action(self._preprocessor(batch))
            actions = self._postprocessor(chosen.float())  # half precision is 8 mrad of a joint
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


@contextmanager
def _loading(folder: Path) -> Iterator[None]:
    """Name the checkpoint that cannot be loaded.

    Files that somebody else wrote, or that were cut short, make LeRobot, torch, safetensors and
    PEFT raise errors of any kind.

    Raises:
        UnusableWeightsError: If it cannot.
    """
    try:
        yield
    except UserError:
        raise
    except Exception as error:
        raise UnusableWeightsError(
            f"{folder} cannot be loaded: {type(error).__name__}: {error}"
        ) from None


def _config(folder: Path, device: str) -> PreTrainedConfig:
    register_third_party_plugins()  # as LeRobot's programs do: `lerobot_policy_*` packages
    config = PreTrainedConfig.from_pretrained(folder)
    config.device = device
    config.pretrained_path = folder
    if hasattr(config, "pretrained_backbone_weights"):
        # They would be downloaded, only to be overwritten by those of the checkpoint.
        config.pretrained_backbone_weights = None
    return config


def _load(folder: Path, base: Path | None, config: PreTrainedConfig) -> PreTrainedPolicy:
    printed = StringIO()  # not where it would cut the progress bar
    with redirect_stdout(printed):
        kind = get_policy_class(config.type)
        policy = kind.from_pretrained(base or folder, config=config, strict=True)
    _, failure, reason = printed.getvalue().partition(NOT_LOADED)
    if failure:
        raise UnusableWeightsError(f"{folder} cannot be loaded: {failure + reason}")
    _leave_in_evaluation_mode(policy)
    return policy if base is None else _adapt(policy, folder)


def _leave_in_evaluation_mode(policy: PreTrainedPolicy) -> None:
    """Spare every step a walk through all modules, only to repeat to them that nobody trains.

    The policies of LeRobot begin `select_action` with `self.eval()`: of a small ACT a tenth of what
    an episode costs, and more the more modules there are.
    """

    def evaluate() -> PreTrainedPolicy:
        return type(policy).eval(policy) if policy.training else policy

    policy.eval().eval = evaluate


def _adapt(policy: PreTrainedPolicy, folder: Path) -> PreTrainedPolicy:
    """Return a policy with a LoRA adapter around it; everything else is passed through to it."""
    require_package("peft", extra="peft")
    from peft import PeftModel

    return PeftModel.from_pretrained(policy, folder).eval()
