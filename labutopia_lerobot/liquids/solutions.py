"""Solutes in a liquid: they mix with those in the same vessel, and react.

In a period a share of what every particle has in solution goes into common with all at its height
in the vessel; what is in common diffuses from layer to layer, comes to equilibrium there, and
everybody gets back as much as he gave. So nothing reacts faster than it mixes, what has been poured
in is seen as it was until it has mixed, and layers are seen until something stirs them. Slow
reactions take their time in what has mixed (`chemistry.kinetics`).
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.inventory import Inventory
from labutopia_lerobot.chemistry.kept_answers import KeptAnswers
from labutopia_lerobot.chemistry.network import PROTON, WATER
from labutopia_lerobot.chemistry.palette import Palette
from labutopia_lerobot.chemistry.portions import WATER_PER_VOLUME
from labutopia_lerobot.chemistry.speciation import ph_of
from labutopia_lerobot.liquids.dissolving import Dissolving
from labutopia_lerobot.liquids.layers import Layers, exchange
from labutopia_lerobot.liquids.mixing import exchanged_between_layers, mixed_share
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.settling import let_sink, sinking_speeds
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import FloatArray, Solution

_MIXED = 1e-6
"""Difference to the mean, in parts of what is dissolved, up to which a vessel is mixed; ours."""


class Solutions:
    """All that is dissolved in the liquid of a scene.

    Args:
        fillings: Everything that is filled in.
        names: Of all vessels, bottles and pipettes.
        particle: Volume of a particle [m^3].
        answers: Of a language model, which decide what may form; None for the rules.

    Attributes:
        inventory: The species, in the order of `Portion.contents`.
        given_off: Gas that has left, by what it left, shape (names, species) [mol].
        unreacted: Why something was left as it is, in words, each reason once.
    """

    def __init__(
        self,
        fillings: Sequence[Filling],
        names: Sequence[str],
        particle: float,
        answers: KeptAnswers | None = None,
    ) -> None:
        crystals = [one for filling in fillings for one in filling.crystals]
        solids = [one.species for one in crystals]
        held = [filling.compounds for filling in fillings]
        named, self._said = (None, ()) if answers is None else answers.may_form(held)
        self.inventory = Inventory.of([filling.dissolved for filling in fillings], solids, named)
        self._dissolving = Dissolving(crystals, self.inventory)
        self._particle = particle
        self._layer = particle ** (1 / 3)
        self._palette = Palette(self.inventory.species, self._dissolving.scattering)
        self._sinking = sinking_speeds(self.inventory.species, self._dissolving.grains)
        self._gases = np.flatnonzero(self.inventory.gaseous)
        self._floats = np.array([key.endswith("(s)") for key in self.inventory.species])
        self._filled = {
            filling.dissolved: self.inventory.filled(filling.dissolved, particle)
            for filling in fillings
        }
        self._water = self.inventory.row({WATER: WATER_PER_VOLUME * particle})
        self._shape = len(names), len(self.inventory.species)
        self.empty()

    def empty(self) -> None:
        """Begin anew: no gas has left."""
        self.given_off: FloatArray = np.zeros(self._shape)
        self.unreacted: tuple[str, ...] = self._said

    def contents(self, fillings: Sequence[Filling]) -> FloatArray:
        """Return what particles hold that come from fillings, shape (m, species) [mol]."""
        rows = [self._filled[filling.dissolved] for filling in fillings]
        return np.array(rows).reshape(-1, self._shape[1])

    def masses(self, contents: FloatArray) -> FloatArray:
        """Return by how much particles are heavier than as much water, shape (m,) [kg].

        All their atoms count, so that what leaves as gas is lost, and no more. Their volume is that
        of the water that they are made up with.

        Args:
            contents: Amounts of each species that they hold, shape (m, species) [mol].
        """
        masses: FloatArray = (contents - self._water) @ self.inventory.molar_masses
        return masses

    def left_behind(self, content: FloatArray) -> FloatArray:
        """Return what stays of a particle whose water evaporates, shape (species,) [mol].

        As much water leaves as it was made up with; what reactions have made of it, or bound, is
        made up for by what it stays with.

        Args:
            content: Amounts of each species that it holds, shape (species,) [mol].
        """
        return content - self._water

    def strew(self, contents: FloatArray, heights: FloatArray, filling: Filling) -> None:
        """Put the crystals of a filling on the bottom of its vessel, in place.

        Args:
            contents: Amounts of each species that its particles hold, shape (m, species) [mol].
            heights: Of the particles, shape (m,) [m].
            filling: What the vessel holds.
        """
        self._dissolving.strew(contents, heights, self._layer, filling.crystals)

    def state(self) -> FloatArray:
        """Return what has left as gas and, letter by letter, `unreacted`, after its length."""
        said = "\n".join(self.unreacted).encode()
        return np.concatenate([self.given_off.ravel(), [len(said)], np.frombuffer(said, np.uint8)])

    def restore(self, state: FloatArray) -> FloatArray:
        """Go back to what `state` returned, which another state follows; return that."""
        gas, rest = np.split(state, [self.given_off.size])
        said, rest = np.split(rest[1:], [int(rest[0])])
        self.given_off = gas.reshape(self._shape).copy()
        words = said.astype(np.uint8).tobytes().decode()
        self.unreacted = tuple(words.split("\n")) if words else ()
        return rest

    def react(
        self,
        what: Portion,
        heights: FloatArray,
        beds: FloatArray,
        capacities: FloatArray,
        inside: NDArray[np.int64],
        speeds: FloatArray,
        period: float,
    ) -> None:
        """Let what is in each vessel mix, react and sink, in place.

        Solids form everywhere and dissolve where they are; they do not mix, but sink or are stirred
        up. Atoms, charge and energy are neither lost nor made: heat of reaction warms the vessel's
        liquid, gas that leaves is counted in `given_off`.

        Args:
            what: The particles.
            heights: Of them, shape (n,) [m].
            beds: The same, for crystals: over the base of a vessel that leans, shape (n,) [m].
            capacities: What warms each by 1 K, shape (n,) [J/K].
            inside: Which vessel each is in, shape (n,); -1 none.
            speeds: Mean speed in each vessel [m/s].
            period: Time [s].
        """
        contents, inventory = what.contents, self.inventory
        for vessel in np.unique(inside[inside >= 0]).tolist():
            held = np.flatnonzero(inside == vessel)
            own, weights, speed = contents[held], capacities[held], float(speeds[vessel])
            warm = float(weights @ what.temperatures[held] / weights.sum())
            if self._dissolving.columns.any() and own[:, self._dissolving.columns].any():
                heat, why = self._dissolving.dissolve(
                    own, contents.sum(axis=0), self._particle, warm, speed, period
                )
                self._note(why)
                contents[held] = own
                what.temperatures[held] += heat / weights.sum()
            mean, present = _mean(own), own.any(axis=0)
            grains = self._dissolving.columns
            for these, over in ((~grains, heights), (grains, beds)):
                floating = np.flatnonzero(self._floats & these & present)
                if len(floating):
                    solids, sinking = own[:, floating], self._sinking[floating]
                    let_sink(solids, over[held], sinking, self._layer, speed, period)
                    own[:, floating] = contents[np.ix_(held, floating)] = solids
            new = self._mixed(own, mean, heights[held], warm, speed, period)
            if inventory.kinetics:
                warmth = what.temperatures[held]
                new = inventory.kinetics.advance(new, self._particle, warmth, period)
            if (new == own).all():
                continue
            heat = float((own - new).sum(axis=0) @ inventory.enthalpies)
            if new[:, self._gases].any():
                self.given_off[vessel, self._gases] += new[:, self._gases].sum(axis=0)
                new[:, self._gases] = 0.0
            contents[held] = new
            what.temperatures[held] += heat / weights.sum()

    def _mixed(
        self,
        own: FloatArray,
        mean: FloatArray,
        heights: FloatArray,
        warm: float,
        speed: float,
        period: float,
    ) -> FloatArray:
        """Return what particles of a vessel hold when they have mixed and reacted for a time.

        Args:
            own: What they hold, shape (m, species) [mol].
            mean: The mean of it, shape (species,).
            heights: Of them, shape (m,) [m].
            warm: Their temperature [K].
            speed: Their mean speed [m/s].
            period: Time [s].
        """
        seen, share = _MIXED * mean[self.inventory.dissolved].sum(), mixed_share(speed, period)
        moving = ~self._floats
        if np.abs(own - mean)[:, moving].max() <= seen:
            goal = self._noted(mean, warm)
            end = _where_it_is(own, mean, goal, self._floats)
            if np.abs(own - end).max() <= seen:
                share = 1.0
            return own + share * (end - own)
        layers = Layers.by_height(heights, self._layer)
        commons = layers.means(own)
        reach = exchanged_between_layers(speed, layers.height)
        commons[:, moving] = exchange(commons[:, moving], layers.counts, reach)
        goals = np.array([self._noted(common, warm) for common in commons])
        end = _where_it_is(own, commons[layers.of], goals[layers.of], self._floats)
        return own + share * (end - own)

    def _noted(self, mean: FloatArray, temperature: float) -> FloatArray:
        """Return what becomes of a particle, as `_settled`; note why not, or not yet."""
        goal, why = self._settled(mean, temperature)
        self._note(why)
        if equation := self.inventory.too_slow(goal, self._particle, temperature):
            self._note(f"too slow to happen here: {equation}")
        return goal

    def _note(self, why: str) -> None:
        """Keep why something was left as it is, once; nothing is no reason."""
        if why and why not in self.unreacted:
            self.unreacted = (*self.unreacted, why)

    def solution(self, vessel: int, what: Portion, capacities: FloatArray) -> Solution:
        """Return what is in a vessel.

        Args:
            vessel: Which of the names.
            what: The particles in it.
            capacities: What warms each by 1 K, shape (m,) [J/K].
        """
        return self._of(what, capacities, self.inventory.amounts(self.given_off[vessel]))

    def drop(self, what: Portion, capacities: FloatArray) -> Solution:
        """Return what is in a drop.

        Args:
            what: Its particles.
            capacities: What warms each by 1 K, shape (m,) [J/K].
        """
        return self._of(what, capacities, {})

    def _of(self, what: Portion, capacities: FloatArray, gas: Mapping[str, float]) -> Solution:
        """Return what particles are together, which gas has left."""
        inventory, contents = self.inventory, what.contents
        if not len(contents):
            return Solution.nothing(gas)
        warm = float(capacities @ what.temperatures / capacities.sum())
        mean = _mean(contents)
        goal, _ = self._settled(mean, warm)
        end, everything = _where_it_is(contents, mean, goal, self._floats), ~inventory.watery
        apart = np.abs(contents - end)[:, everything].sum()
        total = (contents + end)[:, everything].sum()
        settled = inventory.amounts(len(contents) * goal)
        volume = len(contents) * self._particle
        return Solution(
            volume=volume,
            temperature=warm,
            ph=ph_of(settled, volume) if PROTON in settled else np.nan,
            concentrations={key: mol / volume for key, mol in settled.items() if "(aq)" in key},
            solids={key: mol for key, mol in settled.items() if key.endswith("(s)")},
            gas=gas,
            mixed=1.0 - float(apart / total) if total else 1.0,
            colour=self._palette.colour(mean / self._particle),
        )

    def _settled(self, mean: FloatArray, temperature: float) -> tuple[FloatArray, str]:
        """Return what becomes of a particle, shape (species,) [mol], and why not; crystals stay."""
        crystals = np.where(self._dissolving.columns, mean, 0.0)
        goal, why = self.inventory.settled(mean - crystals, self._particle, temperature)
        return goal + crystals, why

    @property
    def crystals(self) -> NDArray[np.bool_]:
        """Which species have been filled in as crystals, shape (species,)."""
        return self._dissolving.columns

    @property
    def precipitates(self) -> NDArray[np.bool_]:
        """Which species are solids that only precipitate, shape (species,)."""
        return self._floats & ~self._dissolving.columns

    def lying(
        self,
        of: NDArray[np.bool_],
        contents: FloatArray,
        heights: FloatArray,
        inside: NDArray[np.int64],
    ) -> FloatArray:
        """Return what lies on bottoms, by particles, shape (n, species) [mol].

        Args:
            of: Which solids, shape (species,).
            contents: Amounts of each species that particles hold, shape (n, species) [mol].
            heights: Of the particles, shape (n,) [m].
            inside: Which vessel each is in, shape (n,); -1 none.
        """
        lying = np.zeros_like(contents)
        if of.any():
            for vessel in np.unique(inside[inside >= 0]).tolist():
                held = np.flatnonzero(inside == vessel)
                lowest = held[heights[held] < heights[held].min() + self._layer]
                lying[lowest] = np.where(of, contents[lowest], 0.0)
        return lying

    def heap(self, lying: FloatArray, contents: FloatArray) -> tuple[float, FloatArray]:
        """Return volume [m^3], and colour and opacity, shape (4,), of the heap in a vessel.

        Args:
            lying: What of each particle in it lies on the bottom, shape (m, species) [mol].
            contents: What they hold, shape (m, species) [mol].
        """
        amounts, around = lying.sum(axis=0), (contents - lying).mean(axis=0) / self._particle
        return self._dissolving.heaped(amounts), self._palette.lying(amounts, around)

    def sediment(self, lying: FloatArray, contents: FloatArray, area: float) -> FloatArray:
        """Return colour and opacity, shape (4,), of what has settled in a vessel.

        Args:
            lying: As of `heap`.
            contents: As of `heap`.
            area: Of its bottom [m^2].
        """
        around = (contents - lying).mean(axis=0) / self._particle
        return self._palette.settled(lying.sum(axis=0) / area, around)

    def looks(self, contents: FloatArray) -> FloatArray:
        """Return colour and opacity of particles, shape (n, 4), each in [0, 1]."""
        return self._palette.seen(contents / self._particle)


def _where_it_is(
    own: FloatArray, mean: FloatArray, goal: FloatArray, floats: NDArray[np.bool_]
) -> FloatArray:
    """Return what particles hold once all has mixed and reacted, shape (m, species) [mol].

    A solid stays where it is: more of it forms everywhere, what dissolves does so where it is.

    Args:
        own: What they hold, shape (m, species) [mol].
        mean: The mean that each mixes to, shape (species,) or (m, species).
        goal: That mean at equilibrium, of the same shape.
        floats: Which species are solids, shape (species,).
    """
    end = np.array(np.broadcast_to(goal, own.shape))
    solid = np.flatnonzero(floats & ((mean > 0.0) | (goal > 0.0)).reshape(-1, len(floats)).any(0))
    if len(solid):
        mean, goal = mean[..., solid], goal[..., solid]
        left = np.divide(np.minimum(goal, mean), mean, out=np.ones_like(mean), where=mean > 0.0)
        end[:, solid] = (own[:, solid] + np.maximum(goal - mean, 0.0)) * left
    return end


def _mean(contents: FloatArray) -> FloatArray:
    """Return the mean of rows, shape (species,); of equal numbers exactly the number."""
    uniform = (contents == contents[0]).all(axis=0)
    return np.where(uniform, contents[0], contents.mean(axis=0))
