"""Options of the multilayer perceptron."""

from dataclasses import dataclass, field

from lerobot.configs import NormalizationMode, PreTrainedConfig
from lerobot.optim import AdamWConfig

from labutopia_lerobot.errors import UserError


class MLPOptionError(UserError, ValueError):
    """An option or an input that the network cannot have; the message says which it can."""


@PreTrainedConfig.register_subclass("mlp")
@dataclass
class MLPConfig(PreTrainedConfig):
    """Options; every field is a flag `--policy.<field>`.

    Attributes:
        n_obs_steps: Frames that it sees, one after the other, the present one last.
        chunk_size: Actions that it says at once.
        n_action_steps: How many of these are played before it looks again.
        temporal_ensemble_coeff: How much less a newer chunk counts than an older one in the mean
            of all that say the present action, as in ACT; `n_action_steps` must be 1. None: none.
        hidden: Units of each hidden layer.
        dropout: Share of the hidden units that a step of the training leaves out.
        normalization_mapping: Kind of feature -> how it is scaled.
        optimizer_lr: Learning rate of AdamW.
        optimizer_weight_decay: Its weight decay.

    Raises:
        MLPOptionError: If a number is impossible.
    """

    n_obs_steps: int = 1
    chunk_size: int = 40
    n_action_steps: int = 30
    temporal_ensemble_coeff: float | None = None
    hidden: list[int] = field(default_factory=lambda: [512, 512, 512])
    dropout: float = 0.0
    # Why poses are scaled by their range: policies/act/README.md.
    normalization_mapping: dict[str, NormalizationMode] = field(
        default_factory=lambda: {
            "STATE": NormalizationMode.MEAN_STD,
            "ENV": NormalizationMode.MIN_MAX,
            "ACTION": NormalizationMode.MEAN_STD,
        }
    )
    optimizer_lr: float = 1e-3
    optimizer_weight_decay: float = 1e-4

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.n_obs_steps < 1:
            raise MLPOptionError(f"n_obs_steps={self.n_obs_steps}: an mlp sees one frame or more")
        if not 1 <= self.n_action_steps <= self.chunk_size:
            raise MLPOptionError(
                f"n_action_steps={self.n_action_steps} is impossible: 1 to chunk_size="
                f"{self.chunk_size}"
            )
        if self.temporal_ensemble_coeff is not None and self.n_action_steps != 1:
            raise MLPOptionError(
                f"n_action_steps={self.n_action_steps} with a temporal_ensemble_coeff: a mean over "
                "chunks looks at every step. Set n_action_steps=1"
            )
        if not self.hidden or min(self.hidden) < 1:
            raise MLPOptionError(f"hidden={self.hidden} lists no layers, such as [512,512]")

    def get_optimizer_preset(self) -> AdamWConfig:
        """Return the optimiser of a training that names none."""
        return AdamWConfig(lr=self.optimizer_lr, weight_decay=self.optimizer_weight_decay)

    def get_scheduler_preset(self) -> None:
        """Return that there is no schedule in a training that names none."""

    def validate_features(self) -> None:
        """Check what it sees.

        Raises:
            MLPOptionError: If that is pictures, or if there is no state, or no action.
        """
        if self.image_features:
            raise MLPOptionError(
                f"An mlp sees no pictures, and is given {', '.join(self.image_features)}: train it "
                "on a dataset with obs=state"
            )
        for name, feature in {
            "observation.state": self.robot_state_feature,
            "observation.environment_state": self.env_state_feature,
            "action": self.action_feature,
        }.items():
            if feature is None:
                raise MLPOptionError(f"An mlp needs {name}: train it on a dataset with obs=state")

    @property
    def observation_delta_indices(self) -> list[int] | None:
        """Frames that it sees, counted from the present one; None if that is all."""
        return None if self.n_obs_steps == 1 else list(range(1 - self.n_obs_steps, 1))

    @property
    def action_delta_indices(self) -> list[int]:
        """Frames whose actions it learns to say."""
        return list(range(self.chunk_size))

    @property
    def reward_delta_indices(self) -> None:
        """Frames whose reward it learns from: none."""
