"""Two furnished rooms, written by hand: what can be in a plan is in one of them."""

from labutopia_lerobot.scenes.plan import Opening, Placed, Plan, Wall, WorkPlace

BRIGHT = Plan(
    name="bright",
    family="organic",
    seed=0,
    size=(7.2, 6.0, 3.2),
    walls=(),
    openings=(
        Opening("door", 1.0, 0.0, 90, 1.0, 2.1),
        Opening("window", 2.2, 6.0, 270, 1.8, 1.5, 0.95),
        Opening("window", 5.0, 6.0, 270, 1.8, 1.5, 0.95),
    ),
    pieces=(
        Placed("work_bench", "bench", 3.0, 3.0, 180),
        Placed("wall_bench", "wall_bench_1", 2.25, 5.62, 270),
        Placed("waste_bin", "bin", 1.5, 3.8, 270),
        Placed("fume_hood", "hood", 6.7, 4.6, 180),
        Placed("safety_cabinet", "solvents", 6.85, 2.2, 180),
        Placed("tall_cupboard", "tall", 2.6, 0.27, 90),
        Placed("bookcase", "books", 4.5, 0.17, 90),
        Placed("laboratory_sink", "sink", 5.0, 5.3, 270),
        Placed("microscope", "microscope", 1.8, 5.5, 270, "wall_bench_1", 0.9),
        Placed("wall_cupboard", "cupboard", 0.6, 5.79, 270, None, 1.5),
        Placed("stool", "stool", 0.6, 4.8, 0),
    ),
    work_places=(WorkPlace("work 1", "bench", 2.1, 3.0, 0),),
    floor="blue vinyl",
    wall="white",
)
"""Windows, fixed and free things, one on a bench, one that hangs, one within the robot's reach."""

PARTED = Plan(
    name="parted",
    family="teaching",
    seed=0,
    size=(9.0, 7.5, 3.2),
    walls=(Wall((6.0, 0.0), (6.0, 7.5)),),
    openings=(
        Opening("door", 1.0, 0.0, 90, 1.3, 2.1),
        Opening("door", 6.0, 1.2, 180, 0.9, 2.05),
        Opening("window", 0.0, 4.5, 0, 2.4, 1.5, 0.95),
        Opening("window", 9.0, 4.5, 180, 2.4, 1.5, 0.95),
    ),
    pieces=(
        Placed("work_bench", "bench", 3.0, 3.6, 270),
        Placed("blackboard", "board", 3.0, 7.43, 270, None, 0.8),
        Placed("shelf_rack", "rack", 5.0, 0.3, 90),
        Placed("teacher_desk", "desk", 3.0, 5.95, 90),
        Placed("island_bench", "island", 7.6, 4.0, 180),
        Placed("glove_box", "gloves", 7.5, 0.5, 90),
    ),
    work_places=(WorkPlace("work 1", "bench", 3.0, 2.7, 90),),
    floor="white tiles",
    wall="cream",
)
"""Two rooms with a door between them, a double door, a robot that faces north."""
