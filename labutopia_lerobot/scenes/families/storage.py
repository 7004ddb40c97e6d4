"""A store of chemicals: rows of racks and cabinets; nobody works here with an arm."""

from labutopia_lerobot.scenes.generation.words import (
    AT_WALL,
    BOTTLES,
    CLEAN_GLASS,
    DETAIL,
    IN_RACK,
    MAIN,
    ON_WALL_BENCH,
    SAFETY,
    VITAL,
    Chamber,
    Family,
    Need,
    on_benches,
    on_shelves,
)

FAMILY = Family(
    name="storage",
    about="Chemicals and equipment in racks and safety cabinets",
    rooms=(
        Chamber(
            "store",
            width=(4.5, 7.0),
            depth=(4.0, 6.0),
            windows=(0, 1),
            needs=(
                Need("shelf_rack", (4, 9), AT_WALL, VITAL),
                Need("safety_cabinet", (1, 3), AT_WALL, VITAL),
                Need("tall_cupboard", (1, 4), AT_WALL, MAIN),
                Need("refrigerator", (0, 2), AT_WALL, MAIN),
                Need("gas_cylinder", (0, 3), AT_WALL, MAIN),
                Need("base_cabinet", (1, 2), AT_WALL, MAIN),
                Need("heater", (0, 2), IN_RACK),
                Need("stirring_hot_plate", (1, 4), IN_RACK),
                Need("vacuum_pump", (0, 2), IN_RACK),
                Need("ultrasonic_bath", (0, 1), IN_RACK),
                Need("desiccator_cabinet", (0, 1), ON_WALL_BENCH),
                Need("tripod", (1, 6), IN_RACK, DETAIL),
                Need("pipette_stand", (0, 3), IN_RACK, DETAIL),
                Need("test_tube_rack", (1, 6), IN_RACK, DETAIL),
                *SAFETY,
            ),
        ),
    ),
    floors=("grey epoxy", "grey tiles"),
    walls=("white", "light grey"),
    stock=(
        on_benches("carboy", "5 l"),
        on_benches("reagent_bottle_amber", "500 ml", "1000 ml", closed=True),
        *BOTTLES,
        *CLEAN_GLASS,
        on_shelves("stoppered_bottle", "250 ml", "500 ml", closed=True),
        on_shelves("wide_mouth_bottle", "250 ml", "500 ml", closed=True),
        on_shelves("carboy", "5 l"),
    ),
)
