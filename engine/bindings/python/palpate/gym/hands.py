"""The fingers of all environments: where an action sends them, and what they feel there, in one call of the engine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import NDArray

from palpate._core import Fingers, Tools
from palpate.gym.bodies import Floats, Region, Whole

if TYPE_CHECKING:
    from palpate.gym.vector import VectorEnv

__all__ = ["Hands", "Moves", "Presses", "Scans"]

Flags = NDArray[np.bool_]
Felt = dict[str, NDArray[Any]]
FELT = ("force", "depth", "proxy", "normal", "triangle", "state")
PRESSED = (*FELT, "tip", "tissue", "radius", "lump_force", "lump", "lump_moved")

CLEAR_MM = 10.0  # over the skin, where a hand that moves begins: higher than the relief under a fingertip
ABOVE_MM = 2.0  # over the skin, where a press begins: it must begin outside


class Hands:
    """Some fingers for each environment; `felt` has arrays (n, hands, ...) that the next `feel` writes into."""

    width = 0  # numbers of an action
    draws = 0  # uniform numbers that an episode needs
    drawn: Optional[str] = None  # the shape of a finger in a picture; None: a finger
    tips: Floats  # (n, hands, 3), mm, of those that move

    def __init__(self, env: VectorEnv, fields: tuple[str, ...], hands: int = 1, rows: int = 1) -> None:
        self.env, self.hands = env, hands
        options, n = env.options, env.num_envs
        first = env.bodies.all[0]
        settings = options.settings if options.settings is not None else first.finger_settings(1)[0]
        self.settings, self.radius_mm = settings, settings.radius_mm
        self.fingers = Fingers(env.bodies.all, rows, settings=settings, threads=options.threads)
        self._out: Felt = self.fingers.step(np.full((rows, 3), np.nan), fields=fields)  # nothing is felt nowhere
        self.fingers.reset()
        own = n * hands
        self.felt: Felt = {name: array[:own].reshape((n, hands) + array.shape[1:]) for name, array in self._out.items()}
        self._spread = rows // n
        self._worlds: Whole = np.zeros(rows, np.int64)

    def _rows(self, mask: Optional[Flags]) -> Optional[Flags]:
        return mask if mask is None or self._spread == 1 else np.repeat(mask, self._spread)

    def ticks(self) -> Whole:
        """The number of each environment's last tick in its episode (n,)."""
        return (self.env.steps + 1) * self.env.options.substeps - 1

    def sensed(self) -> dict[str, Any]:
        """What a device without noise says."""
        return {"force": self.felt["force"], "tips": self.tips}

    def prepare(self, which: Whole, bodies: Whole, draws: Floats) -> None:
        """Says where the next episodes of these environments (k,) begin, in bodies (k,), by uniform numbers (k, draws)."""

    def begin(self, which: Whole, mask: Flags) -> None:
        """Puts the hands of these environments (k,), those of the mask (n,), where their episodes begin."""
        raise NotImplementedError

    def aim(self, moves: Floats) -> None:
        """Takes an action (n, width)."""
        raise NotImplementedError

    def feel(self, mask: Optional[Flags], begun: Optional[Flags]) -> None:
        """Moves the hands of the environments in the mask (n,), all for None. begun: those that began just now."""
        raise NotImplementedError


class Moves(Hands):
    """An action is the way of each tip, -1 to 1 along x, y and z, over max_step_mm; tips stay within the region's box."""

    def __init__(self, env: VectorEnv, fields: tuple[str, ...]) -> None:
        hands = env.task.hands
        super().__init__(env, fields, hands, env.num_envs * hands)
        self.width, self.draws = 3 * hands, 2 * hands
        self.tips: Floats = np.zeros((env.num_envs, hands, 3))
        self._flat = self.tips.reshape(-1, 3)
        self._way, self._first = np.zeros_like(self.tips), np.zeros_like(self.tips)
        self._low, self._high = env.middles - env.region.reach_mm, env.middles + env.region.reach_mm

    def prepare(self, which: Whole, bodies: Whole, draws: Floats) -> None:
        """Each over the skin, in its share of the middle half of the region, from left to right."""
        region = self.env.region
        places = draws.reshape(-1, self.hands, 2) / [self.hands, 1] - 0.5
        places[:, :, 0] += np.arange(self.hands) / self.hands
        points, normals = region.at(np.repeat(bodies, self.hands), places.reshape(-1, 2))
        tips = (points + (min(CLEAR_MM, region.reach_mm) + self.radius_mm) * normals).reshape(-1, self.hands, 3)
        middles = region.middle[bodies][:, None]
        self._first[which] = np.clip(tips, middles - region.reach_mm, middles + region.reach_mm)

    def begin(self, which: Whole, mask: Flags) -> None:
        """Where it was prepared."""
        env, reach = self.env, self.env.region.reach_mm
        self.tips[which] = self._first[which]
        if len(env.bodies) > 1:
            self._low[which], self._high[which] = env.middles[which] - reach, env.middles[which] + reach
            self._worlds.reshape(env.num_envs, -1)[which] = env.body[which][:, None]
        self.fingers.reset(self._rows(mask), self._worlds)

    def aim(self, moves: Floats) -> None:
        """Moves the tips that `feel` sends the fingers to."""
        way = self._way.reshape(moves.shape)
        np.maximum(moves, -1.0, out=way)
        np.minimum(way, 1.0, out=way)
        way *= self.env.options.max_step_mm
        self.tips += self._way
        np.maximum(self.tips, self._low, out=self.tips)
        np.minimum(self.tips, self._high, out=self.tips)

    def feel(self, mask: Optional[Flags], begun: Optional[Flags]) -> None:
        """One way in a straight line, of `substeps` ticks."""
        self.fingers.step(self._flat, substeps=self.env.options.substeps, out=self._out, mask=self._rows(mask))
        if self.env.recorder is not None:
            self.env.recorder.move(self.tips, self.env.options.substeps, mask)


class Presses(Hands):
    """An action is where to press, coordinates (a, b) of the region; a press goes press_mm deep along the normal.

    With a reference each press is made twice: there as well in the healthy body ("model"), or across from it in this
    one ("other_side").
    """

    width = 2

    def __init__(self, env: VectorEnv, fields: tuple[str, ...]) -> None:
        self.reference = env.task.reference
        n = env.num_envs
        super().__init__(env, fields, 1, n if self.reference == "none" else 2 * n)
        self.places: Floats = np.zeros((n, 2))
        self._next = np.zeros((n, 2))
        self.other: Optional[Region] = env.region.mirrored() if self.reference == "other_side" else None
        if self.reference == "model" and env.bodies.healthy is None:
            raise ValueError('reference: "model" needs bodies that know their healthy ones')
        self._over, self._down = np.zeros((2, len(self._worlds), 3))
        self.normals: Floats = np.zeros((len(self._worlds), 3))

    def _rows(self, mask: Optional[Flags]) -> Optional[Flags]:
        return mask if mask is None or self._spread == 1 else np.concatenate([mask, mask])

    def ticks(self) -> Whole:
        """Also the tick over the skin counts; 0 before the first press."""
        return np.maximum(self.env.steps * (self.env.options.substeps + 1) - 1, 0)

    def sensed(self) -> dict[str, Any]:
        """Where was pressed, and how hard at the bottom, beside the reference."""
        n = self.env.num_envs
        along = np.einsum("ij,ij->i", self._out["force"], self.normals)
        readings = np.stack([along[:n], along[n:] if len(along) > n else np.zeros(n)], axis=1)
        return {"force": self.felt["force"], "places": self.places, "readings": readings}

    def begin(self, which: Whole, mask: Flags) -> None:
        """Nothing is pressed yet."""
        env = self.env
        bodies, healthy = env.body[which], env.bodies.healthy
        self._worlds[which] = bodies
        if self._spread == 2:
            beside = healthy[bodies] if self.reference == "model" and healthy is not None else bodies
            self._worlds[env.num_envs + which] = beside
        rows = self._rows(mask)
        self.fingers.reset(rows, self._worlds)
        self.places[which] = 0.0
        for name, array in self._out.items():
            array[rows] = -1 if name in ("triangle", "lump") else 0

    def aim(self, moves: Floats) -> None:
        """Keeps where to press next."""
        np.maximum(moves[:, :2], -1.0, out=self._next)
        np.minimum(self._next, 1.0, out=self._next)

    def feel(self, mask: Optional[Flags], begun: Optional[Flags]) -> None:
        """Down from over the skin in one tick, then `substeps` ticks to the bottom; none where an episode began."""
        env, n = self.env, self.env.num_envs
        if begun is not None:
            mask = ~begun if mask is None else mask & ~begun
            if not mask.any():
                return
        if mask is None:
            self.places[:] = self._next
        else:
            self.places[mask] = self._next[mask]
        for region, rows in ((env.region, slice(0, n)), (self.other or env.region, slice(n, None))):
            if rows.start < len(self._down):
                points, normals = region.at(env.body, self.places)
                self.normals[rows] = normals
                self._over[rows] = points + (self.radius_mm + ABOVE_MM) * normals
                self._down[rows] = points + (self.radius_mm - env.options.press_mm) * normals
        moved = self._rows(mask)
        self.fingers.lift(moved)
        self.fingers.step(self._over, out=self._out, mask=moved)
        self.fingers.step(self._down, substeps=env.options.substeps, out=self._out, mask=moved)
        if env.recorder is not None:
            env.recorder.move(None, 0, mask)
            env.recorder.move(self._over[:n, None], 1, mask)
            env.recorder.move(self._down[:n, None], env.options.substeps, mask)


class Scans(Moves):
    """An action moves an ultrasound head: -1 to 1 along x, y and z over max_step_mm, then turns about the head's own axes
    (along it, across, off the skin) over max_turn_deg. It stays within the region's box.

    `felt` has force, moment about the head's middle, depth of the deepest pad, `touching`, the share of its pads, and
    `turned`, the rotation from the head's frame to the body's.
    """

    drawn = "ball"  # each of the head's pads is a sphere

    def __init__(self, env: VectorEnv, fields: tuple[str, ...]) -> None:
        super().__init__(env, ())
        n, options = env.num_envs, env.options
        self.width, self.radius_mm = 6, 0.0
        self.fingers: Any = Tools(env.bodies.all, n, tool="head", settings=options.settings, threads=options.threads)
        self._out = {"force": np.zeros((n, 3)), "moment": np.zeros((n, 3)), "depth": np.zeros(n),
                     "touching": np.zeros(n, np.int32)}
        self.felt = {name: array.reshape((n, 1) + array.shape[1:]) for name, array in self._out.items()}
        self.felt["touching"] = np.zeros((n, 1))
        self.turned: Floats = np.tile(np.eye(3), (n, 1, 1))
        self._first_turned = self.turned.copy()
        self.felt["turned"] = self.turned[:, None]

    def prepare(self, which: Whole, bodies: Whole, draws: Floats) -> None:
        """Flat over the skin and across the body, in the middle half of the region."""
        super().prepare(which, bodies, draws)
        self._first_turned[which] = self.flat(bodies, self.env.region.at(bodies, draws - 0.5)[1])

    def begin(self, which: Whole, mask: Flags) -> None:
        """Where it was prepared."""
        super().begin(which, mask)
        self.turned[which] = self._first_turned[which]

    def flat(self, bodies: Whole, normals: Floats) -> Floats:
        """Rotations (k, 3, 3) across the body, with the skin of these normals (k, 3) below."""
        u = self.env.region.u[bodies]
        along = u - (u * normals).sum(axis=1)[:, None] * normals
        along /= np.linalg.norm(along, axis=1)[:, None]
        return np.stack([along, np.cross(normals, along), normals], axis=2)

    def aim(self, moves: Floats) -> None:
        """Moves and turns the heads that `feel` sends."""
        super().aim(moves[:, :3])
        turns = np.clip(moves[:, 3:], -1.0, 1.0) * np.deg2rad(self.env.options.max_turn_deg)
        self.turned[:] = orthonormal(self.turned @ rotations(turns))

    def feel(self, mask: Optional[Flags], begun: Optional[Flags]) -> None:
        """One way of `substeps` ticks."""
        self.fingers.step(self._flat, self.turned, substeps=self.env.options.substeps, out=self._out, mask=mask)
        np.divide(self._out["touching"][:, None], self.fingers.pads, out=self.felt["touching"])


def rotations(vectors: Floats) -> Floats:
    """Rotations (n, 3, 3) about vectors (n, 3), whose lengths are the angles, rad, by Rodrigues' formula."""
    angle = np.linalg.norm(vectors, axis=1)[:, None, None]
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    skew = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    first = np.sinc(angle / np.pi)  # sin(a) / a, also at 0
    second = 0.5 * np.sinc(angle / (2 * np.pi)) ** 2  # (1 - cos(a)) / a^2
    turned: Floats = np.eye(3) + first * skew + second * (skew @ skew)
    return turned


def orthonormal(turned: Floats) -> Floats:
    """Nearly rotations (n, 3, 3), as rounding leaves them after many steps, as rotations."""
    x = turned[..., 0] / np.linalg.norm(turned[..., 0], axis=1)[:, None]
    y = turned[..., 1] - (turned[..., 1] * x).sum(axis=1)[:, None] * x
    y /= np.linalg.norm(y, axis=1)[:, None]
    return np.stack([x, y, np.cross(x, y)], axis=2)
