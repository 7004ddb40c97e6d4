"""A weighing room: balances on benches of their own, still air, a desk for the book."""

from labutopia_lerobot.scenes.generation.words import (
    AT_BENCH,
    AT_DESK,
    AT_WALL,
    DESK_AT_WALL,
    DETAIL,
    MAIN,
    ON_WALL_BENCH,
    SAFETY,
    VITAL,
    WORK_BENCH,
    Chamber,
    Family,
    Need,
)

FAMILY = Family(
    name="weighing_room",
    about="Balances on benches of their own, away from doors and draughts",
    rooms=(
        Chamber(
            "room",
            width=(5.6, 7.5),
            depth=(5.2, 6.5),
            windows=(0, 1),
            needs=(
                WORK_BENCH,
                Need("wall_bench", (2, 4), AT_WALL, VITAL),
                Need("writing_desk", (1, 1), DESK_AT_WALL, MAIN),
                Need("tall_cupboard", (0, 1), AT_WALL, MAIN),
                Need("bookcase", (0, 1), AT_WALL, MAIN),
                Need("analytical_balance", (2, 4), ON_WALL_BENCH),
                Need("precision_balance", (1, 3), ON_WALL_BENCH),
                Need("moisture_analyser", (1, 2), ON_WALL_BENCH),
                Need("desiccator_cabinet", (1, 1), ON_WALL_BENCH),
                Need("laboratory_chair", (1, 1), AT_DESK),
                Need("laboratory_timer", (0, 2), ON_WALL_BENCH, DETAIL),
                Need("stool", (0, 2), AT_BENCH, DETAIL),
                *SAFETY,
            ),
        ),
    ),
    floors=("grey vinyl", "beige vinyl"),
    walls=("white", "cream", "pale green"),
)
