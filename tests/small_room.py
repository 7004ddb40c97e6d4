"""A small room without a fault, to plant faults in."""

from labutopia_lerobot.scenes.plan import Opening, Placed, Plan, WorkPlace

ROOM = Plan(
    name="small",
    family="test",
    seed=0,
    size=(7.0, 6.0, 3.0),
    walls=(),
    openings=(
        Opening("door", 1.0, 0.0, 90, 1.0, 2.1),
        Opening("window", 3.5, 6.0, 270, 1.5, 1.3, 1.0),
    ),
    pieces=(
        Placed("work_bench", "work_bench_1", 5.0, 3.0, 180),
        Placed("wall_bench", "wall_bench_1", 0.385, 3.0, 0),
        Placed("refrigerator", "refrigerator_1", 3.0, 0.335, 90),
        Placed("wall_cupboard", "wall_cupboard_1", 0.202, 4.5, 0, height=1.5),
        Placed("stirring_hot_plate", "plate", 0.3, 3.0, 0, "wall_bench_1", 0.9),
    ),
    work_places=(WorkPlace("work_place_1", "work_bench_1", 4.1, 3.0, 0),),
    floor="grey vinyl",
    wall="white",
)
