"""A policy in plain PyTorch: a small network copies the expert, and is evaluated. No LeRobot."""

import argparse

import gymnasium
import numpy as np
import torch
from torch.nn import GELU, Linear, Sequential, Unflatten

import labutopia_lerobot  # noqa: F401  # registers the tasks
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson

CHUNK = 20  # actions that are given at a time: looking at every step, small errors add up


def play(env, seed, act):
    """Return what was seen in an episode, the next actions at each step, whether it succeeded."""
    observation, _ = env.reset(seed=seed)
    script = env.unwrapped.expert()
    script.start()
    seen, done, planned, terminated, truncated = [], [], [], False, False
    while not (terminated or truncated):
        seen.append(np.concatenate([observation["agent_pos"], observation["environment_state"]]))
        planned = planned or ([script.act()] if act is None else list(act(seen[-1])))
        done.append(planned.pop(0))
        observation, _, terminated, truncated, info = env.step(done[-1])
    ahead = [(done + [done[-1]] * CHUNK)[step : step + CHUNK] for step in range(len(done))]
    return np.array(seen), np.array(ahead), info["is_success"]


def main() -> None:
    """Demonstrate, copy, evaluate."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name, default in (("demonstrations", 100), ("steps", 4000), ("episodes", 20)):
        parser.add_argument(f"--{name}", type=int, default=default)
    given = parser.parse_args()
    torch.manual_seed(0)
    env = gymnasium.make("labutopia/level1-pick-v0", obs="state", liquid="off")
    played = [play(env, seed, None)[:2] for seed in range(given.demonstrations)]
    seen, ahead = (torch.tensor(np.concatenate(part)) for part in zip(*played, strict=True))
    low, span = seen.amin(0), seen.amax(0) - seen.amin(0) + 1e-3
    mean, spread = ahead.mean((0, 1)), ahead.std((0, 1))
    first, last = Linear(len(low), 512), Linear(512, CHUNK * len(mean))
    net = Sequential(first, GELU(), Linear(512, 512), GELU(), last, Unflatten(1, (CHUNK, -1)))
    adam = torch.optim.Adam(net.parameters(), lr=5e-4)
    for _ in range(given.steps):
        batch = torch.randint(len(seen), (256,))
        adam.zero_grad()
        (net((seen[batch] - low) / span) - (ahead[batch] - mean) / spread).abs().mean().backward()
        adam.step()

    def act(now):
        return (net((torch.tensor(now) - low)[None] / span)[0] * spread + mean).detach().numpy()

    wins = sum(play(env, 100_000 + number, act)[2] for number in range(given.episodes))
    print(f"{wins}/{given.episodes} successes, 95 %:", *wilson(wins, given.episodes))


if __name__ == "__main__":
    main()
