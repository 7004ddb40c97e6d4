"""LabUtopia on MuJoCo and LeRobot: laboratory tasks, their experts, datasets and evaluation."""

try:
    from importlib.metadata import version

    from labutopia_lerobot.gymnasium_ids import register_tasks
    from labutopia_lerobot.sim.opengl import choose_backend

    __version__ = version("lerobot_env_labutopia")

    choose_backend()
    register_tasks()
except KeyboardInterrupt:  # a program that has just been started, and is not yet at `cli.launch`
    from labutopia_lerobot.runtime.termination import report_interrupt_in_one_line

    report_interrupt_in_one_line()
    raise
