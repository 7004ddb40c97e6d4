"""The network: states in, a chunk of actions out, learned by the mean absolute error."""

from collections import deque
from itertools import pairwise
from typing import Any

import torch
from lerobot.policies import PreTrainedPolicy
from lerobot.policies.act.modeling_act import ACTTemporalEnsembler
from torch import Tensor, nn

from labutopia_lerobot.behaviour_cloning.configuration_mlp import MLPConfig

_INPUTS = ("observation.state", "observation.environment_state")


class MLPPolicy(PreTrainedPolicy):
    """A multilayer perceptron on the states of robot and things.

    Args:
        config: Its options, with the features of the dataset.
        **kwargs: What LeRobot gives to every policy beside; not used.
    """

    config_class = MLPConfig
    name = "mlp"

    def __init__(self, config: MLPConfig, **kwargs: Any) -> None:
        super().__init__(config)
        config.validate_features()
        self.config = config
        frame = sum(config.input_features[key].shape[0] for key in _INPUTS)
        elements = config.action_feature.shape[0]
        layers: list[nn.Module] = []
        for before, after in pairwise([config.n_obs_steps * frame, *config.hidden]):
            layers += [nn.Linear(before, after), nn.ReLU(), nn.Dropout(config.dropout)]
        last = nn.Linear(config.hidden[-1], config.chunk_size * elements)
        self.model = nn.Sequential(*layers, last, nn.Unflatten(-1, (config.chunk_size, elements)))
        self.reset()

    def get_optim_params(self) -> Any:
        """Return what is trained: everything."""
        return self.parameters()

    def reset(self) -> None:
        """Forget the actions that were to be played, and what was seen."""
        self._seen: deque[Tensor] = deque(maxlen=self.config.n_obs_steps)
        self._queue: deque[Tensor] = deque(maxlen=self.config.n_action_steps)
        coefficient = self.config.temporal_ensemble_coeff
        self._ensemble = None
        if coefficient is not None:
            self._ensemble = ACTTemporalEnsembler(coefficient, self.config.chunk_size)

    def forward(self, batch: dict[str, Tensor]) -> tuple[Tensor, dict[str, float]]:
        """Return the mean absolute error of a batch, without what lies behind its episodes.

        Args:
            batch: States, shape (frames, elements), or (frames, n_obs_steps, elements) with more
                than one; `action`, shape (frames, chunk, elements), all scaled; `action_is_pad`,
                shape (frames, chunk).
        """
        said = self.model(torch.cat([batch[key] for key in _INPUTS], dim=-1).flatten(1))
        error = (said - batch["action"]).abs().mean(dim=-1)
        counts = ~batch["action_is_pad"]
        loss = (error * counts).sum() / counts.sum().clamp_min(1)
        return loss, {"l1_loss": loss.item()}

    @torch.no_grad()
    def predict_action_chunk(self, batch: dict[str, Tensor], **kwargs: Any) -> Tensor:
        """Return the next actions, shape (environments, chunk, elements), scaled."""
        self.eval()
        self._see(batch)
        return self._said()

    @torch.no_grad()
    def select_action(self, batch: dict[str, Tensor], **kwargs: Any) -> Tensor:
        """Return the next action, shape (environments, elements), scaled."""
        self.eval()
        self._see(batch)
        if self._ensemble is not None:
            mean: Tensor = self._ensemble.update(self._said())
            return mean
        if not self._queue:
            self._queue.extend(self._said()[:, : self.config.n_action_steps].transpose(0, 1))
        return self._queue.popleft()

    def _see(self, batch: dict[str, Tensor]) -> None:
        """Remember a frame; where there is none before it, as if it had always been so."""
        frame = torch.cat([batch[key] for key in _INPUTS], dim=-1)
        self._seen.extend([frame] * (1 if self._seen else self.config.n_obs_steps))

    def _said(self) -> Tensor:
        """Return the chunk of actions that follows what was seen."""
        actions: Tensor = self.model(torch.cat(list(self._seen), dim=-1))
        return actions
