"""A teaching laboratory: rows of desks and islands before a board, a place to demonstrate."""

from labutopia_lerobot.scenes.generation.words import (
    AT_BENCH,
    AT_DESK,
    AT_WALL,
    BEFORE_BOARD,
    BOARD,
    DESK_AT_WALL,
    FIRST,
    HUNG_LOW,
    ISLAND,
    MAIN,
    ON_BENCH,
    SAFETY,
    WORK_BENCH,
    Chamber,
    Family,
    Need,
)

FAMILY = Family(
    name="teaching",
    about="Practical courses, with islands and desks before a board",
    rooms=(
        Chamber(
            "laboratory",
            width=(10.0, 12.5),
            depth=(7.0, 9.0),
            windows=(2, 4),
            needs=(
                WORK_BENCH,
                Need("blackboard", (1, 1), BOARD, FIRST),
                Need("teacher_desk", (1, 1), BEFORE_BOARD, FIRST, near="blackboard", within=4.5),
                Need("island_bench", (1, 2), ISLAND, MAIN),
                Need("writing_desk", (2, 6), DESK_AT_WALL, MAIN),
                Need("laboratory_sink", (1, 2), AT_WALL, MAIN),
                Need("bookcase", (1, 2), AT_WALL, MAIN),
                Need("tall_cupboard", (1, 2), AT_WALL, MAIN),
                Need("laboratory_chair", (2, 6), AT_DESK, near="writing_desk", within=1.5),
                Need("stool", (2, 6), AT_BENCH),
                Need("eyewash", (1, 1), HUNG_LOW, near="laboratory_sink"),
                Need("microscope", (1, 4), ON_BENCH),
                Need("bunsen_burner", (2, 6), ON_BENCH),
                Need("tripod", (2, 6), ON_BENCH),
                Need("retort_stand", (1, 4), ON_BENCH),
                Need("precision_balance", (1, 3), ON_BENCH),
                Need("stirring_hot_plate", (0, 3), ON_BENCH),
                *SAFETY,
            ),
        ),
    ),
)
