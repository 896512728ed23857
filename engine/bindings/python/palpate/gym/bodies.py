"""What is touched: one body, or a pool of drawn ones that episodes choose from; and the region of their skin."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palpate._core import Error, Lump, World

__all__ = ["Bodies", "Floats", "Region"]

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
Range = tuple[float, float]

# mm between two points of a chart: a tenth of a fingertip's width, over which the skin of a body hardly bends.
CHART_MM = 2.0
TRIES = 100  # to draw places that a body has room for; of a torso one in three has none


class Bodies:
    """Worlds that episodes draw from, with equal chances, and what is hidden in each.

    hidden (M, L, 3): places on the skin over what is hidden, mm; NaN where there are fewer than L. healthy: the same
    bodies with nothing in them, one, or one each.
    """

    def __init__(self, worlds: Union[World, Sequence[World]], *, hidden: Optional[Sequence[ArrayLike]] = None,
                 healthy: Sequence[World] = ()) -> None:
        """Raises ValueError for numbers that do not agree."""
        self.worlds = [worlds] if isinstance(worlds, World) else list(worlds)
        places = [np.reshape(np.asarray(one, float), (-1, 3)) for one in hidden] if hidden is not None else []
        if not self.worlds or len(places) not in (0, len(self.worlds)) or len(healthy) not in (0, 1, len(self.worlds)):
            raise ValueError("bodies: expected a world or more, and as many of hidden; of healthy one, or as many")
        self.counts: Whole = np.array([len(one) for one in places] or [0] * len(self.worlds))
        self.hidden: Floats = np.full((len(self.worlds), max(1, self.counts.max()), 3), np.nan)
        for number, one in enumerate(places):
            self.hidden[number, :len(one)] = one
        self.all = [*self.worlds, *healthy]
        first = len(self.worlds)
        self.healthy: Optional[Whole] = None
        if healthy:
            self.healthy = first + (np.arange(first) if len(healthy) > 1 else np.zeros(first, np.int64))

    def __len__(self) -> int:
        return len(self.worlds)

    @classmethod
    def drawn(cls, scene: str, ranges: dict[str, Range], *, pool: int = 8, seed: int = 0) -> Bodies:
        """Worlds of a scene's text with {names} in it: build, posture, layers. ranges: from where each is drawn.

        Takes as long as `pool` worlds take to build. Raises palpate.Error."""
        random = np.random.default_rng(seed)
        texts = [scene.format(**{name: random.uniform(*ends) for name, ends in ranges.items()}) for _ in range(pool)]
        return cls([World.parse(text) for text in texts])

    @classmethod
    def with_stiff_places(cls, world: World, region: Region, *, scene: str = "", pool: int = 64,
                          count: tuple[int, int] = (1, 1), change_percent: Range = (50.0, 50.0),
                          radius_mm: Range = (15.0, 15.0), seed: int = 0) -> Bodies:
        """The body with round places that are stiffer, `count` of them each (least, most).

        scene: the text of the world's scene, whose stiffness they change; "": a built-in body's. Places lie within a
        tenth of the region's border, and farther apart than they are wide."""
        def table(place: Floats, random: np.random.Generator) -> str:
            return ("\n[[dysfunction]]\n"
                    f"x_mm = {place[0]}\ny_mm = {place[1]}\nradius_mm = {random.uniform(*radius_mm)}\n"
                    f"change_percent = {random.uniform(*change_percent)}\nedge_softness = 1\n")

        def make(places: Floats, random: np.random.Generator) -> World:
            return world.rebuilt(scene + "".join(table(place, random) for place in places))

        worlds, hidden = _hide(region, pool, count, 2.0 * radius_mm[1], seed, make)
        return cls(worlds, hidden=hidden, healthy=[world.rebuilt(scene)])

    @classmethod
    def with_lumps(cls, world: World, region: Region, *, pool: int = 64, count: tuple[int, int] = (1, 1),
                   depth_mm: Range = (5.0, 10.0), diameter_mm: Range = (10.0, 10.0), stiffness_ratio: Range = (10.0, 10.0),
                   seed: int = 0) -> Bodies:
        """The body with balls under its skin, `count` of them each (least, most); it needs layered tissue.

        Raises palpate.Error where there is no room for one."""
        def make(places: Floats, random: np.random.Generator) -> World:
            return world.with_lumps([Lump(at=place[:2], depth_mm=random.uniform(*depth_mm),
                                          diameter_mm=random.uniform(*diameter_mm),
                                          stiffness_ratio=random.uniform(*stiffness_ratio)) for place in places])

        worlds, hidden = _hide(region, pool, count, 2.0 * diameter_mm[1], seed, make)
        return cls(worlds, hidden=hidden, healthy=[world])


def _hide(region: Region, pool: int, count: tuple[int, int], apart_mm: float, seed: int,
          make: Callable[[Floats, np.random.Generator], World]) -> tuple[list[World], list[Floats]]:
    """Worlds and the places of what is hidden in each. World number k is the same for any pool that has it."""
    if region.normal[0, 2] < 0.3:
        raise ValueError("around: what is hidden is placed as seen along z, so the skin of the region must face z")
    worlds, hidden = [], []
    for number in range(pool):
        random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(number,))))
        wanted = int(random.integers(count[0], count[1] + 1))
        for tries_left in reversed(range(TRIES)):
            places = _draw_places(region, wanted, apart_mm, random)
            try:
                worlds.append(make(places, random))
                break
            except Error:  # no room there, over a bone
                if tries_left == 0:
                    raise
        hidden.append(places)
    return worlds, hidden


def _draw_places(region: Region, wanted: int, apart_mm: float, random: np.random.Generator) -> Floats:
    places = np.zeros((0, 3))
    for _ in range(1000):
        if len(places) == wanted:
            return places
        place = region.at(np.zeros(1, np.int64), random.uniform(-0.9, 0.9, (1, 2)))[0]
        if not len(places) or np.linalg.norm(places - place, axis=1).min() > apart_mm:
            places = np.concatenate([places, place])
    raise ValueError(f"count: no room for {wanted} places that are {apart_mm:g} mm apart; increase reach_mm")


class Region:
    """A square of skin around a place of each body, seen along the normal there.

    Coordinates (a, b) from -1 to 1: a along u = v x normal, b along v, towards the head, both over reach_mm.
    """

    def __init__(self, worlds: Sequence[World], around: Union[str, ArrayLike], reach_mm: float) -> None:
        """around: by name, or (3,) mm. Raises palpate.Error for a name that a body does not know."""
        if not reach_mm > 0:
            raise ValueError("reach_mm: must be above 0")
        self.reach_mm = reach_mm
        self.middle: Floats = np.array([world.place(around) for world in worlds])
        self.normal: Floats = np.array([world.normal_at(around) for world in worlds])
        head = np.where(np.abs(self.normal[:, 1:2]) < 0.9, [[0.0, 1.0, 0.0]], [[0.0, 0.0, 1.0]])
        v = head - (head * self.normal).sum(axis=1)[:, None] * self.normal
        self.v: Floats = v / np.linalg.norm(v, axis=1)[:, None]
        self.u: Floats = np.cross(self.v, self.normal)
        self._worlds, self._mirror = list(worlds), np.ones(3)
        self._half = max(1, int(np.ceil(reach_mm / CHART_MM)))
        self._grid: Optional[Floats] = None  # of charts (K G G, 6) points and normals, drawn when they are first asked for
        self._chart: Whole = np.zeros(len(worlds), np.int64)

    def mirrored(self) -> Region:
        """The same region on the other side of the body's middle, x = 0: (a, b) is the place across from (a, b)."""
        other = copy.copy(self)
        other._mirror, other._grid = np.array([-1.0, 1.0, 1.0]), None
        return other

    def _draw(self) -> None:
        """Worlds of one body share a chart."""
        axis = np.linspace(-self.reach_mm, self.reach_mm, 2 * self._half + 1)
        charts: dict[bytes, int] = {}
        drawn: list[Floats] = []
        for number, world in enumerate(self._worlds):
            key = world.positions.tobytes()
            if key not in charts:
                charts[key] = len(charts)
                flat = self.middle[number] + axis[:, None, None] * self.u[number] + axis[:, None] * self.v[number]
                drawn.append(self._chart_of(world, flat.reshape(-1, 3) * self._mirror, self.normal[number] * self._mirror))
            self._chart[number] = charts[key]
        self._grid = np.concatenate(drawn)

    @staticmethod
    def _chart_of(world: World, flat: Floats, normal: Floats) -> Floats:
        """Points of the skin on the lines along the normal through these, by walking along it to the nearest point."""
        found = np.empty((len(flat), 6))
        for number, point in enumerate(flat):
            for _ in range(3):
                point = point + ((world.place(point) - point) @ normal) * normal
            found[number, :3], found[number, 3:] = world.place(point), world.normal_at(point)
        return found

    def at(self, bodies: Whole, places: Floats) -> tuple[Floats, Floats]:
        """Of bodies (k,) and coordinates (k, 2): the points of the skin (k, 3), mm, and its normals (k, 3)."""
        if self._grid is None:
            self._draw()
        assert self._grid is not None
        last = 2 * self._half
        at = (places + 1.0) * (0.5 * last)
        low = np.minimum(np.maximum(at, 0.0), last - 1.0).astype(np.int64)
        share = at - low
        np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
        corner = (self._chart[bodies] * (last + 1) + low[:, 0]) * (last + 1) + low[:, 1]
        corners = self._grid[corner[:, None] + [0, 1, last + 1, last + 2]]
        weights = np.stack([1.0 - share, share], axis=2)
        mixed = np.einsum("ki,kj,kijc->kc", weights[:, 0], weights[:, 1], corners.reshape(-1, 2, 2, 6))
        normals = mixed[:, 3:]
        return mixed[:, :3], normals / np.sqrt((normals * normals).sum(axis=1))[:, None]

    def coordinates(self, bodies: Whole, points: Floats) -> Floats:
        """Of bodies (k,) and points (k, ..., 3), mm: their coordinates (k, ..., 2)."""
        shape = (len(points),) + (1,) * (points.ndim - 2) + (3,)
        away = points - self.middle[bodies].reshape(shape)
        axes = [(away * axis[bodies].reshape(shape)).sum(axis=-1) for axis in (self.u, self.v)]
        both: Floats = np.stack(axes, axis=-1) / self.reach_mm
        return both
