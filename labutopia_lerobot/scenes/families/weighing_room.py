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
    on_benches,
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
    stock=(
        on_benches("weighing_bottle", "30 x 50 mm", "40 x 80 mm", closed=True, often=3),
        on_benches("weighing_boat", "85 x 85 x 24 mm", often=2),
        on_benches("watch_glass", "60 x 8 mm", "80 x 10 mm"),
        on_benches("beaker_low", "50 ml", "100 ml", often=2),
        on_benches("sample_jar", "60 ml", "250 ml", often=2),
        on_benches("crucible", "45 x 36 mm", "50 x 40 mm"),
    ),
)
