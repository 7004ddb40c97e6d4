"""Work without air: glove boxes, their gas and pumps, ovens to dry what goes in."""

from labutopia_lerobot.scenes.generation.words import (
    AT_BENCH,
    AT_OUTER_WALL,
    AT_WALL,
    BESIDE,
    DETAIL,
    GLASS_IN_USE,
    HUNG_LOW,
    MAIN,
    ON_BENCH,
    SAFETY,
    VITAL,
    WORK_BENCH,
    Chamber,
    Family,
    Need,
    on_benches,
)

FAMILY = Family(
    name="glove_box",
    about="Work under inert gas, with glove boxes, vacuum and drying",
    rooms=(
        Chamber(
            "laboratory",
            width=(7.0, 9.5),
            depth=(6.0, 7.5),
            windows=(0, 2),
            needs=(
                WORK_BENCH,
                Need("glove_box", (1, 3), AT_WALL, VITAL),
                Need("gas_cylinder", (2, 4), AT_WALL, VITAL, near="glove_box", within=6.0),
                Need("fume_hood", (1, 1), AT_OUTER_WALL, MAIN),
                Need("wall_bench", (2, 4), AT_WALL, MAIN),
                Need("safety_cabinet", (0, 1), AT_WALL, MAIN),
                Need("laboratory_sink", (1, 1), AT_WALL, MAIN, near="wall_bench", within=4.0),
                Need("vacuum_oven", (1, 1), ON_BENCH, MAIN),
                Need("nitrogen_dewar", (0, 1), BESIDE, MAIN),
                Need("vacuum_pump", (1, 3), ON_BENCH),
                Need("desiccator_cabinet", (0, 1), ON_BENCH),
                Need("analytical_balance", (0, 1), ON_BENCH),
                Need("stirring_hot_plate", (1, 2), ON_BENCH),
                Need("eyewash", (1, 1), HUNG_LOW, near="laboratory_sink"),
                Need("stool", (0, 2), AT_BENCH, DETAIL),
                *SAFETY,
            ),
        ),
    ),
    floors=("grey epoxy", "grey vinyl"),
    walls=("white", "light grey"),
    stock=(
        *GLASS_IN_USE,
        on_benches("round_bottom_flask", "250 ml"),
        on_benches("vial", "20 ml", "40 ml", often=4),
        on_benches("weighing_bottle", "30 x 50 mm", "40 x 80 mm", closed=True),
    ),
)
