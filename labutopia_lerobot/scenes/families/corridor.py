"""Several rooms on a corridor: a laboratory with a place for the arm, a store, an office."""

from labutopia_lerobot.scenes.generation.words import (
    AT_BENCH,
    AT_DESK,
    AT_OUTER_WALL,
    AT_WALL,
    BESIDE,
    DESK_AT_WALL,
    DETAIL,
    HUNG_HIGH,
    HUNG_LOW,
    IN_RACK,
    MAIN,
    ON_BENCH,
    SAFETY,
    WORK_BENCH,
    Chamber,
    Corridor,
    Family,
    Need,
)

FAMILY = Family(
    name="corridor",
    about="A laboratory, a store and an office on one corridor",
    corridor=Corridor(
        width=(1.8, 2.4),
        needs=(
            Need("safety_shower", (1, 1), BESIDE, MAIN),
            Need("coat_rack", (0, 2), BESIDE),
            *SAFETY[:1],
        ),
    ),
    rooms=(
        Chamber(
            "store",
            width=(2.8, 3.6),
            depth=(5.4, 6.6),
            windows=(0, 1),
            needs=(
                Need("shelf_rack", (2, 4), AT_WALL, MAIN),
                Need("safety_cabinet", (1, 1), AT_WALL, MAIN),
                Need("tall_cupboard", (0, 2), AT_WALL, MAIN),
                Need("test_tube_rack", (1, 3), IN_RACK, DETAIL),
                Need("tripod", (0, 3), IN_RACK, DETAIL),
            ),
        ),
        Chamber(
            "laboratory",
            width=(6.2, 7.6),
            depth=(5.4, 6.6),
            windows=(1, 2),
            needs=(
                WORK_BENCH,
                Need("wall_bench", (2, 3), AT_WALL, MAIN),
                Need("fume_hood", (0, 1), AT_OUTER_WALL, MAIN),
                Need("laboratory_sink", (1, 1), AT_WALL, MAIN, near="wall_bench", within=4.0),
                Need("drying_oven", (0, 1), ON_BENCH, MAIN),
                Need("centrifuge", (0, 1), ON_BENCH),
                Need("stirring_hot_plate", (1, 3), ON_BENCH),
                Need("precision_balance", (1, 1), ON_BENCH),
                Need("vortex_mixer", (0, 2), ON_BENCH),
                Need("retort_stand", (0, 2), ON_BENCH),
                Need("wall_cupboard", (0, 2), HUNG_HIGH, near="wall_bench", within=1.0),
                Need("eyewash", (1, 1), HUNG_LOW, near="laboratory_sink"),
                Need("stool", (0, 2), AT_BENCH, DETAIL),
                *SAFETY,
            ),
        ),
        Chamber(
            "office",
            width=(3.0, 4.0),
            depth=(5.4, 6.6),
            windows=(1, 1),
            needs=(
                Need("writing_desk", (1, 3), DESK_AT_WALL, MAIN),
                Need("bookcase", (1, 2), AT_WALL, MAIN),
                Need("laboratory_chair", (1, 3), AT_DESK),
                Need("waste_bin", (1, 1), BESIDE, DETAIL),
            ),
        ),
    ),
)
