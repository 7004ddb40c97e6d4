"""A policy in plain PyTorch: a small network copies the expert, and is evaluated. No LeRobot."""

import argparse

import gymnasium
import numpy as np
import torch

import labutopia_lerobot  # noqa: F401  # registers the tasks
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson


def play(env, seed, act):
    """Play an episode; return what was seen and done, row by row, and whether it succeeded."""
    observation, _ = env.reset(seed=seed)
    expert = env.unwrapped.expert()
    expert.start()
    rows, terminated, truncated = [], False, False
    while not (terminated or truncated):
        seen = np.concatenate([observation["agent_pos"], observation["environment_state"]])
        action = expert.act() if act is None else act(seen)
        rows.append(np.concatenate([seen, action]))
        observation, _, terminated, truncated, info = env.step(action)
    return np.array(rows, np.float32), info["is_success"]


def main() -> None:
    """Demonstrate, copy, evaluate."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name, default in (("demonstrations", 40), ("steps", 3000), ("episodes", 20)):
        parser.add_argument(f"--{name}", type=int, default=default)
    given = parser.parse_args()
    torch.manual_seed(0)

    env = gymnasium.make("labutopia/level1-pick-v0", obs="state", liquid="off")
    joints = env.action_space.shape[0]
    rows = np.vstack([play(env, seed, None)[0] for seed in range(given.demonstrations)])
    seen = torch.tensor(rows[:, :-joints])
    change = torch.tensor(rows[:, -joints:]) - seen[:, :joints]
    mean, spread = seen.mean(0), seen.std(0) + 1e-3
    hidden, last = torch.nn.Linear(seen.shape[1], 256), torch.nn.Linear(256, joints)
    network = torch.nn.Sequential(hidden, torch.nn.ReLU(), last)
    adam = torch.optim.Adam(network.parameters(), lr=1e-3)
    for _ in range(given.steps):
        batch = torch.randint(len(seen), (256,))
        error = network((seen[batch] - mean) / spread) - 100 * change[batch]
        adam.zero_grad()
        error.square().mean().backward()
        adam.step()

    def act(now):
        return now[:joints] + network((torch.tensor(now) - mean) / spread).detach().numpy() / 100

    wins = sum(play(env, 100_000 + number, act)[1] for number in range(given.episodes))
    print(f"{wins}/{given.episodes} successes, 95 %:", *wilson(wins, given.episodes))


if __name__ == "__main__":
    main()
