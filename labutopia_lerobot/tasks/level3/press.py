"""Press, generalised: the button of a named colour among three (paper, level 3, "Press").

Ported from: config/level3_press.yaml, tasks/press_task.py, controllers/press_controller.py.
"""

from labutopia_lerobot.labware.instruments.button_post import ButtonPost
from labutopia_lerobot.layout import OnBench
from labutopia_lerobot.predicates import touched
from labutopia_lerobot.scenario import Draw
from labutopia_lerobot.scenes.views import PRESS_VIEW
from labutopia_lerobot.task import Task
from labutopia_lerobot.tasks.level1.press import HEIGHT, YAW, held_in, press_and_hold

TRAIN, TEST = ("red", "green", "blue"), ("yellow",)
# Original: x 0.40, y -0.40 to 0.06, each on its own; the places for tests are ours.
PLACES = {
    "as high as in level 1": OnBench((0.36, 0.42), (-0.40, 0.06), YAW, HEIGHT),
    "lower": OnBench((0.36, 0.42), (-0.40, 0.06), YAW, (0.125, 0.215)),
}


def press(draw: Draw) -> Task:
    """Return the task that an episode has drawn."""
    color = draw.choice("color", train=TRAIN, test=TEST)
    usual, lower = PLACES
    where = PLACES[draw.choice("position", train=(usual,), test=(lower,))]
    draw.vary("material", shifted=True)  # original: what its out-of-domain test shifts
    left, right = (other for other in TRAIN if other != color) if color in TRAIN else TRAIN[:2]
    post = ButtonPost("target", color)
    others = ButtonPost("other", left), ButtonPost("another", right)
    button = post.button
    return Task(
        instruction=f"Press the {color} button and keep it pressed.",
        paraphrases=(
            f"Push in the button that is {color} and hold it down.",
            f"Find the {color} one of the three buttons, press it and do not let go.",
        ),
        start={post: where, **dict.fromkeys(others, where)},
        steps=(press_and_hold(button),),
        goal=held_in(button),
        never={"wrong_button": touched(*(other.button for other in others))},
        time_limit_s=1000 / 60,  # original: 1000 steps at 60 Hz
        view=PRESS_VIEW,
    )
