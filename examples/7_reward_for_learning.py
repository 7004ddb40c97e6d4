"""Learning by trying: `reward=dense`, climbed by the cross-entropy method on open-loop moves.

The hand learns to come to the flask. The dense reward is ours and not the benchmark's: success is
the same with and without it.
"""

import argparse

import gymnasium
import numpy as np

import labutopia_lerobot  # noqa: F401  # registers the tasks


def earned(env, moves) -> float:
    """Return what an episode earns that moves the joints so, a third of a second for each move."""
    observation, _ = env.reset(seed=0)
    target, total = observation["agent_pos"].copy(), 0.0
    for move in moves:
        for _ in range(10):
            target[:7] += move / 10
            _, reward, terminated, truncated, _ = env.step(target)
            total += reward
            if terminated or truncated:
                return total
    return total


def main() -> None:
    """Improve a distribution of moves by the best of each generation."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--generations", type=int, default=12)
    parser.add_argument("--tries", type=int, default=24, help="in each generation")
    given = parser.parse_args()
    env = gymnasium.make("labutopia/level1-pick-v0", obs="state", liquid="off", reward="dense")
    rng = np.random.default_rng(0)
    mean, spread = np.zeros((6, 7), np.float32), np.full((6, 7), 0.08, np.float32)
    for generation in range(given.generations):
        tries = rng.normal(mean, spread, (given.tries, *mean.shape)).astype(np.float32)
        rewards = np.array([earned(env, moves) for moves in tries])
        best = tries[np.argsort(rewards)[-max(2, given.tries // 5) :]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 0.01
        print(f"Generation {generation}: mean {rewards.mean():+.3f}, best {rewards.max():+.3f}")


if __name__ == "__main__":
    main()
