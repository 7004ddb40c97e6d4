"""An episode through Gymnasium: what is observed, what an action is, what one gets to know."""

import argparse

import gymnasium

import labutopia_lerobot  # noqa: F401  # registers the tasks


def main() -> None:
    """Play one episode with the task's expert, or with random actions."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("task", nargs="?", default="level1/pick")
    parser.add_argument("--random", action="store_true", help="random actions, not the expert's")
    parser.add_argument("--obs", default="state", help="state (default) or pixels")
    arguments = parser.parse_args()

    name = arguments.task.replace("/", "-")
    env = gymnasium.make(f"labutopia/{name}-v0", obs=arguments.obs)
    print("Observations:", env.observation_space)
    print("Actions:", env.action_space)
    env.action_space.seed(0)
    observation, info = env.reset(seed=0)
    print("Instruction:", env.unwrapped.task)
    print("Observed:", {key: getattr(value, "shape", value) for key, value in observation.items()})

    expert = env.unwrapped.expert()
    expert.start()
    over, latched = False, {}
    while not over:
        action = env.action_space.sample() if arguments.random else expert.act()
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        for substep, seconds in info["substeps"].items():
            if seconds != float("inf") and substep not in latched:
                latched[substep] = seconds
                print(f"  {substep} after {seconds:.1f} s")
    print(f"Outcome: {info['outcome']}, reward {reward:g}")
    print("Facts that hold:", [fact for fact, holds in info["facts"].items() if holds])


if __name__ == "__main__":
    main()
