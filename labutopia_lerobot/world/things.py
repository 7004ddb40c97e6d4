"""Properties that predicates and skills may ask of a thing, beside its pose."""

from typing import Protocol, runtime_checkable


class Thing(Protocol):
    """A piece of labware or an instrument, known to the world by its name."""

    @property
    def name(self) -> str:
        """Name of the root body; every element of the thing starts with it."""
        ...

    def __hash__(self) -> int:
        """Return its hash: things are keys, of where they start and of what they hold."""
        ...


@runtime_checkable
class Standing(Thing, Protocol):
    """A thing with an upright axis."""

    @property
    def height(self) -> float:
        """Overall height [m]."""
        ...

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its axis that it needs on the bench [m]."""
        ...


@runtime_checkable
class Obstacle(Standing, Protocol):
    """A thing on the floor that is in the way of a robot that drives, and on no map."""

    @property
    def walks(self) -> bool:
        """Whether it moves by itself."""
        ...


@runtime_checkable
class OpenVessel(Thing, Protocol):
    """A vessel with a round mouth."""

    @property
    def rim(self) -> str:
        """Name of the frame in the middle of the mouth; z out of it."""
        ...

    @property
    def height(self) -> float:
        """Height of the mouth above the base [m]."""
        ...

    @property
    def mouth_radius(self) -> float:
        """Inner radius of the mouth [m]."""
        ...


@runtime_checkable
class Graspable(Thing, Protocol):
    """A thing with a place for the fingers."""

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the base [m]."""
        ...

    @property
    def grip_width(self) -> float:
        """Outer diameter at the grasp [m]."""
        ...


class Doorway(Protocol):
    """Where one reaches into something; the frame that it refers to is one of the thing's."""

    @property
    def frame(self) -> str:
        """Name of that frame, whose x axis points inwards."""
        ...

    @property
    def at(self) -> tuple[float, float, float]:
        """Its middle in that frame [m]."""
        ...

    @property
    def ahead(self) -> tuple[float, float]:
        """Least and greatest distance of it before the base of an arm that reaches in [m]."""
        ...


@runtime_checkable
class ReachedInto(Thing, Protocol):
    """A thing that one stands before to reach into it."""

    @property
    def opening(self) -> Doorway:
        """Where."""
        ...


class Button(Thing, Protocol):
    """A push-button; the frame of its name lies in the middle of its face.

    Its z axis is the way it is pressed, its x axis the way the back of a hand looks that presses it
    comfortably.
    """

    @property
    def joint(self) -> str:
        """Name of its slide [m]; positive is in."""
        ...

    @property
    def travel(self) -> float:
        """Depth at which it clicks [m]."""
        ...

    @property
    def differential(self) -> float:
        """Return travel at which it clicks out [m]."""
        ...

    @property
    def force_sensor(self) -> str:
        """Name of the sensor of the force on it [N]."""
        ...
