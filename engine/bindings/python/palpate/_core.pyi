"""The engine of palpate; use the package palpate.

Made by tools/python-stubs from the docstrings; not edited by hand.
"""

import os
from typing import Any, Callable, Iterable, Iterator, Optional, Sequence, Union, overload

import numpy
import numpy.typing


__version__: str

class Error(ValueError):
    """What cannot be loaded, built or used, in one line: `where: cause`.

    file (str or None): the file, as it was named; line (int or None): counted from 1;
    cause (str): the words without file and line.
    """

    file: Optional[str]
    line: Optional[int]
    cause: str

class World:
    """A body that can be felt: made by load, parse, torso, trunk, from_file, from_arrays. It never changes; any number of threads may share it.

    mm, N, s; x to the patient's right seen from behind, y to the head, z out of the back.
    """

    def __init__(self, *, lumps: Optional[Sequence[Lump]] = None, body: str = 'trunk', triangles: int = 0) -> None:
        """A built-in body with lumps under its skin. body: 'trunk' or 'torso'; triangles: of skin and bones together, 0: as many as usual. Raises palpate.Error for a lump that cannot be where it should."""
    @staticmethod
    def load(file: Union[str, os.PathLike[str]]) -> World:
        """A world from a scene file (docs/reference/scene-files.md). Raises palpate.Error with file and line. Releases the interpreter's lock, as all that build a world do; Ctrl-C interrupts."""
    @staticmethod
    def parse(toml: str, name: str = 'scene') -> World:
        """A world from the text of a scene file. name: stands for the file in messages, its folder for names of files in the text. Raises palpate.Error with name and line."""
    @staticmethod
    def torso(*, triangles: int = 20389) -> World:
        """The open back of the dissertation with 43 bones. triangles: of skin and bones together. Raises palpate.Error for too few. 0.6 s."""
    @staticmethod
    def trunk(*, triangles: int = 83164) -> World:
        """The closed body from neck to thighs. triangles: of skin and bones together, even. Raises palpate.Error for too few. One to two seconds."""
    @staticmethod
    def from_file(file: Union[str, os.PathLike[str]], *, scale: float = 1.0, stiffness: numpy.typing.ArrayLike = 0.5, repair: bool = True, scene: str = '') -> World:
        """A world from a mesh file: OBJ, STL, PLY, OFF, glTF, GLB.

        scale: factor on its size; files are in mm, glTF and GLB in m
        stiffness: N/mm at 1 mm depth, one number or one a vertex of the file (V,)
        repair: False refuses a mesh that is not fit instead of mending it
        scene: text of a scene file for everything else, friction, force law ...; its body is not looked at

        Vertices and triangles change their order; source_vertex and source_triangle lead back. Raises palpate.Error naming the file.
        """
    @staticmethod
    def from_arrays(vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike, *, stiffness: numpy.typing.ArrayLike = 0.5, repair: bool = True, scene: str = '') -> World:
        """A world from vertices (V, 3), mm, and faces (F, 3) of whole numbers, counted from 0, counter-clockwise seen from outside.

        stiffness: N/mm at 1 mm depth, one number or one a vertex (V,)
        repair: False refuses a mesh that is not fit instead of mending it
        scene: text of a scene file for everything else; its body is not looked at

        Vertices and triangles change their order; source_vertex and source_triangle lead back. Raises palpate.Error naming the first wrong vertex or face, TypeError for faces that are no whole numbers, ValueError for shapes.
        """
    def rebuilt(self, toml: str, name: str = 'scene') -> World:
        """The same body under another scene's force law, stiffness, maps, friction: the same triangles in the same order, in milliseconds. toml: text of a whole scene, of which [body] is not looked at. Raises palpate.Error with name and line."""
    @property
    def positions(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V, 3) vertices of the skin at rest, mm; a read-only view, as all arrays of a World are."""
    @property
    def normals(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V, 3) unit, out of the body, weighted by angle."""
    @property
    def triangles(self) -> numpy.typing.NDArray[numpy.int32]:
        """(F, 3) int32: three vertices each, counter-clockwise seen from outside."""
    @property
    def stiffness(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V,) N/mm."""
    @property
    def source_vertex(self) -> numpy.typing.NDArray[numpy.int32]:
        """(V,) int32: which given vertex each one is. Raises palpate.Error for a world that no mesh was given for."""
    @property
    def source_triangle(self) -> numpy.typing.NDArray[numpy.int32]:
        """(F,) int32: which given triangle each one is; -1 for one that mending made. Raises palpate.Error likewise."""
    @property
    def built_vertex(self) -> numpy.typing.NDArray[numpy.int32]:
        """The other way round, a given vertex each; -1 for one that the world has not. Raises palpate.Error likewise."""
    @property
    def built_triangle(self) -> numpy.typing.NDArray[numpy.int32]:
        """A given triangle each: which of the world's it is, or -1. Raises palpate.Error likewise."""
    @property
    def landmarks(self) -> dict[str, numpy.typing.NDArray[numpy.float64]]:
        """Named points on the skin, (3,) mm each, by the names that bones have ("spinous_T6"); {} for a mesh."""
    @property
    def landmark_normals(self) -> dict[str, numpy.typing.NDArray[numpy.float64]]:
        """The skin's normals there, (3,) each, by the same names."""
    def place(self, place: Union[str, numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) mm: the point of the skin at rest that words name ("T6", "left PSIS", "T6 right 30 mm"; docs/reference/names.md), or the nearest to a point (3,). Raises palpate.Error with the name that is near in spelling."""
    def normal_at(self, place: Union[str, numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) unit: the normal of the triangle there, out of the body. Raises as `place` does."""
    def triangle_at(self, place: Union[str, numpy.typing.ArrayLike]) -> int:
        """The triangle there, a row of `triangles`. Raises as `place` does."""
    def stiffness_at(self, place: Union[str, numpy.typing.ArrayLike]) -> float:
        """N/mm at that place, between the vertices. Raises as `place` does."""
    def tips(self, place: Union[str, numpy.typing.ArrayLike], depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """(T, 3) mm: a path along the normal of a place, at these depths (T,) under the skin, mm; below 0 is over it. Raises as `place` does."""
    def words(self, point: numpy.typing.ArrayLike) -> str:
        """A point (3,) as an examiner would say it: "T6, 12 mm right and 8 mm up"; "" where nothing has a name."""
    @property
    def place_names(self) -> list[str]:
        """All names that `place` knows; [] for a mesh."""
    def ellipses(self, xy: Union[str, Sequence[str], numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(N, 3): half axes, mm, the longer first, and direction of the longer against x, rad in [0, pi), of the deformation ellipses at xy (N, 2), mm, or at places by name."""
    @property
    def notes(self) -> list[str]:
        """What the user should know: what a file was read without, repairs, a doubtful unit."""
    @property
    def name(self) -> str:
        """Of the body, in words."""
    @property
    def closed(self) -> bool:
        """True where the skin has no border."""
    @property
    def fingers(self) -> int:
        """How many fingers the scene describes."""
    def __repr__(self) -> str:
        """In a few words."""
    def finger_settings(self, n: int = 1) -> list[FingerSettings]:
        """List of n FingerSettings: the scene's own in their order, then points with its friction."""
    def with_lumps(self, lumps: Optional[Sequence[Lump]]) -> World:
        """The same body with these lumps and no others, in some 30 ms a lump: the same triangles in the same order. Its tissue must be layered: a built-in body, or a mesh under a scene with [tissue] layer_table. Raises palpate.Error."""
    @property
    def lumps(self) -> list[dict[str, Any]]:
        """What lies under the skin, a dict each: name; foot (3,) on the skin over its middle, axis (3,) out of the skin, across and up (3,), mm; half_axes_mm (3,), depth_mm of its top; young_kpa, layer_kpa of the tissue around it; tissue_mm over the bone; mobility_mm_per_n; share: what it adds to the force of a fingertip right over it, by the depth of the press, mm; note, all of this in a line."""
    def rollout(self, tips: numpy.typing.ArrayLike, *, settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None, fields: Optional[Sequence[str]] = None, threads: int = 1, out: Optional[dict[str, numpy.typing.NDArray[Any]]] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Whole paths: one finger a row of tips (F, T, 3), mm, each tick FingerSettings.tick_s after the last.

        settings: None for the scene's fingers, a FingerSettings for all, or a sequence of F
        fields: names of what is answered; None for force (F, T, 3) N, depth (F, T) mm, proxy, anchor and normal
            (F, T, 3), triangle (F, T) int32, -1 when free, state (F, T) uint8, 0 free, 1 stick, 2 slip, and status
            (F, T) uint32. Also tip, hold (F, T, 3), tissue, rest, anchor_triangle, radius (F, T), and of lumps
            lump_force (F, T, 3) N, part of force, lump_share, their normal force over that of the press without them,
            lump (F, T) int32, the mobile one that is nearest or -1, lump_moved (F, T, 2), how far it is from its place,
            mm across and up. In a world with lumps or pads None answers all that `pressure` needs, too
        threads: fingers are shared among so many, where there is work enough for them
        out: a dict of C-ordered arrays that are written instead of fresh ones; says the fields where `fields` does not

        Every finger starts again: nothing is kept between two calls. The interpreter's lock is released, Ctrl-C interrupts. Raises ValueError for shapes, TypeError for what is not a number, palpate.Error for settings.
        """
    def pressure(self, felt: Union[dict[str, numpy.typing.NDArray[Any]], Touch, Sequence[Touch]], n: int = 4, pad_mm: float = 16.0, shear: bool = False, *, tick: Optional[numpy.typing.ArrayLike] = None) -> numpy.typing.NDArray[numpy.float64]:
        """Pressure on the fingertip, kPa, of what was felt in this world: n x n taxels of a square pad with sides of pad_mm, in the plane of the contact. The first row is nearest to the head, the first taxel of a row lowest along u = v x normal, with v towards the head.

        felt: what rollout or Fingers.step answered (F, T) or (F,), with all fields that a world with lumps or pads answers by itself; or a Touch, or several
        n: 2 to 16; pad_mm: 1 to 100
        shear: a last axis of three: pressure, and shear on the finger along u and along v, kPa
        tick: of a body that breathes, when it was felt; None counts the last axis of (F, T) from 0, as rollout does

        Gives (F, T, n, n), (F, n, n) or, of a Touch, (n, n): zeros where nothing is touched. The pressures add up to the normal force, and a point counts as a fingertip of 8 mm. The interpreter's lock is released, Ctrl-C interrupts. Raises palpate.Error where the tissue is not layered or the pad is out of range, ValueError for fields that are missing.
        """

class FingerSettings:
    """What a finger is: a point or a ball, and how it rubs. Checked when made; it never changes, `replace` makes another.

    radius_mm: 0 is a point, 8 a fingertip (0 to 1,000)
    stiffness_ratio: tangential over normal stiffness (0 to 100)
    mu_static, mu_dynamic: friction, mu_dynamic at most mu_static (0 to 5)
    max_depth_mm: deeper than this the force no longer grows (above 0, to 100,000)
    tick_s: time between two ticks, s (1e-6 to 1)
    catch_up_mm_per_s: how fast the point on the skin may run beside the tip (0 to 1,000,000)
    relaxation_share, relaxation_time_s, relaxation_share_2, relaxation_time_2_s: of the force, what goes while the
        skin is held, and over which times, s; the shares together at most 0.9
    force_shading: rounds off facets of coarse meshes; a point only

    Raises palpate.Error for a number that makes no sense or is out of range.
    """

    def __init__(self, *, radius_mm: float = 0.0, stiffness_ratio: float = 1.0, mu_static: float = 0.46, mu_dynamic: float = 0.44, max_depth_mm: float = 40.0, tick_s: float = 0.001, catch_up_mm_per_s: float = 100.0, relaxation_share: float = 0.0, relaxation_time_s: float = 1.0, relaxation_share_2: float = 0.0, relaxation_time_2_s: float = 5.0, force_shading: bool = False) -> None:
        """All by name; what is left out has its usual value. Raises palpate.Error."""
    @property
    def radius_mm(self) -> float:
        """Radius of the finger, mm; 0 is a point."""
    @property
    def stiffness_ratio(self) -> float:
        """Tangential over normal stiffness."""
    @property
    def mu_static(self) -> float:
        """Friction before it slips."""
    @property
    def mu_dynamic(self) -> float:
        """Friction while it slips."""
    @property
    def max_depth_mm(self) -> float:
        """The deepest depth that is felt, mm."""
    @property
    def tick_s(self) -> float:
        """Time between two ticks, s."""
    @property
    def catch_up_mm_per_s(self) -> float:
        """How fast the point on the skin may run beside the tip, mm/s."""
    @property
    def relaxation_share(self) -> float:
        """Of the force, what goes while the skin is held."""
    @property
    def relaxation_time_s(self) -> float:
        """Over which time it goes, s."""
    @property
    def relaxation_share_2(self) -> float:
        """The same of a second term."""
    @property
    def relaxation_time_2_s(self) -> float:
        """Time of the second term, s."""
    @property
    def force_shading(self) -> bool:
        """True where facets are rounded off."""
    def replace(self, **kwargs: Any) -> FingerSettings:
        """The same with some numbers changed, named as in the constructor. Raises TypeError for a name that is none, palpate.Error for a number that makes no sense."""
    def __repr__(self) -> str:
        """As the constructor would be called."""
    def __eq__(self, other: object) -> bool:
        """True where all numbers are the same."""
    def __hash__(self) -> int:
        """Of all its numbers."""

class Touch:
    """What a finger felt in one tick: a snapshot that never changes. Arrays are read-only views of it."""

    @property
    def force(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) on the finger, N."""
    @property
    def tip(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) where the finger is, mm."""
    @property
    def proxy(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) the point of the skin that it presses, mm; the tip when free."""
    @property
    def anchor(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) the point of the skin that friction holds, mm; the tip when free."""
    @property
    def hold(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) where friction holds the tip, a point in space, mm; the tip when free."""
    @property
    def normal(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) unit, out of the skin; zeros when free."""
    @property
    def depth_mm(self) -> float:
        """Depth along the normal, mm; 0 when free."""
    @property
    def tissue_mm(self) -> float:
        """Thickness over the bone under the finger as it is felt, more over a narrow one, mm; 0 when free and where it is not known."""
    @property
    def rest_mm(self) -> float:
        """Effective depth at which the skin under the finger would stay by itself, mm."""
    @property
    def state(self) -> str:
        """'free', 'stick' or 'slip'."""
    @property
    def triangle(self) -> int:
        """Triangle under the proxy, a row of World.triangles; -1 when free."""
    @property
    def anchor_triangle(self) -> int:
        """Triangle under the anchor; -1 when free."""
    @property
    def status(self) -> int:
        """Bits: 1 tip lost (not finite or absurdly far: no force), 2 catching up, 4 too deep, 8 letting go, 16 at the border, 32 started inside, 64 unsettled, 128 shading failed (docs/explanation/contact.md)."""
    @property
    def radius_mm(self) -> float:
        """Of the finger, mm; 0: a point."""
    @property
    def lump_force(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) of `force`, what the lumps under the skin add, N."""
    @property
    def lump_share(self) -> float:
        """Their normal force over that of the press without them; 0 where that is 0."""
    @property
    def lump(self) -> int:
        """Of the lumps that move and are felt the nearest, by its place in World.lumps; -1: none."""
    @property
    def lump_moved(self) -> numpy.typing.NDArray[numpy.float64]:
        """(2,) how far that one is from its place, mm across and up."""
    def __repr__(self) -> str:
        """In a few words."""

class Finger:
    """One finger on a world, one tick a call. Keeps its world. Use each from one thread at a time."""

    def __init__(self, world: World, settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None) -> None:
        """settings: a FingerSettings, or None for the scene's first finger. Raises palpate.Error where they and the world do not suit."""
    @property
    def world(self) -> World:
        """The world it feels."""
    @property
    def settings(self) -> FingerSettings:
        """What it is."""
    def lift(self) -> None:
        """The finger leaves: its next tip may be anywhere, and nothing between here and there is touched."""
    def reset(self) -> None:
        """As when it was made: `lift`, its clock starts again, which counts on a body that breathes, and lumps that it moved are back."""
    @overload
    def step(self, tip: numpy.typing.ArrayLike) -> Touch:
        """One tick with the tip (3,) here, mm; FingerSettings.tick_s after the last. A ball's tip is its centre.

        An array of float64 is fastest. A tip that is not finite is lost: status 1, no force, and the finger stays as it was.
        Raises TypeError for what is not a number, ValueError for another shape. The interpreter's lock is kept.
        """
    @overload
    def step(self, x: float, y: float, z: float) -> Touch:
        """The same with three numbers."""

class Lump:
    """Something under the skin: a node, a cyst, a hard band. Checked when made; it never changes.

    at: the skin over its middle, by name ("T9 right 30 mm") or x, y, mm, seen along z
    depth_mm: of its top under the skin at rest, along the normal; at least 0.5 mm under the skin's own layer
    diameter_mm: of a ball (2 to 40; 10), or half_axes_mm: across, across (the same), into the body (1 to 20)
    stiffness_ratio: over the layer at its centre (0.2 to 1,000; 5), or young_kpa: Young's modulus
    edge: share of the radius over which its modulus falls to the tissue's; 0 is sharp (0 to 1)
    mobility_mm_per_n: how far it moves under 1 N sideways (0.1 to 100); 0 is fixed
    mobility_limit_mm: it moves no farther from its place (above 0, to 100)
    raise_mm: how far the skin over it is raised at rest (0 to 10)
    name: different for each lump of a world; "": lump1, lump2, ...

    Raises palpate.Error for a number that is out of range. Whether there is room for it is known when a world is built.
    """

    def __init__(self, *, at: Union[str, numpy.typing.ArrayLike], depth_mm: float = 8.0, diameter_mm: Optional[float] = None, half_axes_mm: Optional[numpy.typing.ArrayLike] = None, stiffness_ratio: Optional[float] = None, young_kpa: Optional[float] = None, edge: float = 0.0, mobility_mm_per_n: float = 0.0, mobility_limit_mm: float = 10.0, raise_mm: float = 0.0, name: str = '') -> None:
        """All by name. Raises palpate.Error, ValueError for shapes."""
    @property
    def name(self) -> str:
        """As it was given."""
    @property
    def at(self) -> Union[str, numpy.typing.ArrayLike]:
        """The skin over its middle: words, or x and y, mm."""
    @property
    def depth_mm(self) -> float:
        """Of its top under the skin at rest."""
    @property
    def half_axes_mm(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) across, across, into the body, mm."""
    def __repr__(self) -> str:
        """As the constructor would be called."""
    def __eq__(self, other: object) -> bool:
        """True where all of it is the same."""
    def __hash__(self) -> int:
        """Of all its numbers."""

def _world_of(toml: str, mesh: Any, hash: str) -> World:
    """What a pickled World is made of again."""
def _native_rollout_seconds(world: World, tips: numpy.typing.ArrayLike) -> float:
    """Seconds that a loop of C++ takes for the path (T, 3) of one finger, its outputs kept; for tools/bench-python."""
class Fingers:
    """A batch of fingers on one world that persist between calls.

    One call at a time: a second, from another thread, raises RuntimeError. After a fork the child may use it, threads and all. `with` closes it.
    """

    def __init__(self, world: World, n: int, *, settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None, threads: int = 1) -> None:
        """n fingers; settings: None for the scene's, a FingerSettings for all, or a sequence of n; threads: share a call's work where it is more than 5,000 ticks. Raises palpate.Error where settings and world do not suit."""
    def step(self, tips: numpy.typing.ArrayLike, *, substeps: int = 1, fields: Optional[Sequence[str]] = None, out: Optional[dict[str, numpy.typing.NDArray[Any]]] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Moves every finger to its tip (n, 3), mm, and answers what it felt in its last tick.

        substeps: ticks that the way takes, in a straight line from where the finger was sent last: tick k is at from + (to - from) * (k / substeps)
        fields, out: as for World.rollout, arrays (n, ...)

        Arrays are fresh unless `out` is given. The interpreter's lock is released, Ctrl-C interrupts: some fingers have moved then. Raises RuntimeError while another call is at work, ValueError for shapes.
        """
    def reset(self, mask: Optional[numpy.typing.ArrayLike] = None) -> None:
        """Those with True in mask (n,), all for None, are as when they were made. Raises RuntimeError, ValueError."""
    def lift(self, mask: Optional[numpy.typing.ArrayLike] = None) -> None:
        """Those with True in mask (n,), all for None, leave: their next tips may be anywhere. Raises RuntimeError, ValueError."""
    def touches(self) -> list[Touch]:
        """A list of n Touch of the last ticks, for Skin.apply. Raises RuntimeError while another call is at work."""
    def close(self) -> None:
        """Ends its threads. Whatever is asked of it afterwards raises ValueError; closed again is closed."""
    def __enter__(self) -> Fingers:
        """Itself."""
    def __exit__(self, *args: Any) -> None:
        """close()."""
    def __len__(self) -> int:
        """How many fingers there are."""
    @property
    def world(self) -> World:
        """The world they feel."""
    @property
    def threads(self) -> int:
        """Threads that share a call's work."""

class Skin:
    """The skin of a world as fingers deform it.

    Its arrays are live, read-only views: the next `apply` changes what they show. They are for the thread that applies; `copy` is for others and for later.
    """

    def __init__(self, world: World, *, strain: bool = True, fingers: int = 16) -> None:
        """At rest. strain: also compute the strain; fingers: the most that are applied at once. Raises palpate.Error."""
    def apply(self, touches: Union[Touch, Iterable[Touch]], *, tick: int = 0) -> None:
        """Brings the skin to what these touches make of it, whatever it was before; an empty list: to rest.

        tick: when they felt it, counted from the start of the run; matters on a body that breathes.
        The interpreter's lock is kept. Raises TypeError for other things than touches, ValueError for more of them than there is room for, RuntimeError while another thread reads the skin (view.render).
        """
    def copy(self) -> dict[str, numpy.typing.NDArray[Any]]:
        """A dict of fresh arrays, whole even beside `apply` in another thread: positions, normals, displacement (V, 3) and strain (V,), float32; positions float64 of a body farther than 10 m from the origin. Raises RuntimeError while another thread reads the skin (view.render)."""
    @property
    def positions(self) -> numpy.typing.NDArray[Any]:
        """(V, 3) float32, mm; a live view, not contiguous (an axis after the other in memory). Of a body farther than 10 m from the origin, as in map coordinates, a fresh float64 array."""
    @property
    def normals(self) -> numpy.typing.NDArray[numpy.float32]:
        """(V, 3) float32, unit; a live view."""
    @property
    def displacement(self) -> numpy.typing.NDArray[numpy.float32]:
        """(V, 3) float32, mm from rest, 0 where nothing moves; a live view."""
    @property
    def strain(self) -> numpy.typing.NDArray[numpy.float32]:
        """(V,) float32, 0.1 is 10 % longer, below 0 shorter; zeros without strain. A live view."""
    @property
    def changed(self) -> numpy.typing.NDArray[numpy.int64]:
        """(R, 2) int64: ranges of vertices, first and end, that the last `apply` wrote; fresh."""
    @property
    def moved_vertices(self) -> int:
        """How many vertices the last `apply` found in the reach of a finger."""
    @property
    def status(self) -> int:
        """Bits of the last `apply`: 1 a contact that is not finite, 2 without triangle, 4 more than there is room for, 8 a region without area, 16 without a vertex (docs/explanation/deformation.md)."""
    @property
    def world(self) -> World:
        """The world whose skin it is."""

class ReplayDifference:
    """The first place where a replay differs from the record."""

    @property
    def tick(self) -> int:
        """Of the servo loop."""
    @property
    def finger(self) -> str:
        """Its name."""
    @property
    def field(self) -> str:
        """The column."""
    @property
    def recorded(self) -> str:
        """The value in the file, in words."""
    @property
    def replayed(self) -> str:
        """The value that was felt again, in words."""
    def __repr__(self) -> str:
        ...

class ReplayReport:
    """What came of feeling a session again."""

    @property
    def identical(self) -> bool:
        """Every compared bit is the same."""
    @property
    def ticks(self) -> int:
        """Samples that were compared."""
    @property
    def different(self) -> int:
        """How many of them differ."""
    @property
    def unproven(self) -> int:
        """Samples that could not be compared: time before them is missing from the session."""
    @property
    def first_difference(self) -> Optional[ReplayDifference]:
        """The first, or None."""
    @property
    def notes(self) -> list[str]:
        """A body that is not the recorded one, and so on."""
    @property
    def gaps(self) -> list[str]:
        """Where time is missing, in words."""
    def __repr__(self) -> str:
        ...

class SessionRepair:
    """What was salvaged of a damaged session, and what was lost."""

    @property
    def nothing_lost(self) -> bool:
        """All that was recorded is in the new file."""
    @property
    def samples(self) -> int:
        """Salvaged."""
    @property
    def blocks(self) -> int:
        """Salvaged."""
    @property
    def events(self) -> int:
        """Salvaged."""
    @property
    def worlds(self) -> int:
        """Salvaged."""
    @property
    def attachments(self) -> int:
        """Salvaged."""
    @property
    def samples_lost(self) -> int:
        """Those that are known by their time."""
    @property
    def blocks_lost(self) -> int:
        """With a checksum that does not hold, or missing."""
    @property
    def bytes_missing(self) -> int:
        """At the file's end."""
    @property
    def header_lost(self) -> bool:
        """When it began, its rate, notes."""
    @property
    def lost(self) -> list[dict[str, Any]]:
        """A dict each: finger, first_tick, last_tick (both included), samples."""
    @property
    def gaps(self) -> list[dict[str, Any]]:
        """Ticks that were never recorded, as `lost`."""
    @property
    def other_lost(self) -> list[Any]:
        """Worlds, names, attachments: a line each."""
    @property
    def notes(self) -> list[Any]:
        """What else was seen."""
    def __repr__(self) -> str:
        ...

def repair(file: Union[str, os.PathLike[str]], target: Union[str, os.PathLike[str]], *, overwrite: bool = False) -> SessionRepair:
    """Writes what can still be read of a damaged session into `target`; `file` is only read. A sample comes
    out with every bit, or not at all. Releases the GIL. Raises Error where there is nothing to salvage, for
    a target that is there already, and for the same file twice.
    """
class SessionBlocks:
    """Walks through a session, a dict of arrays at a time."""

    def __iter__(self) -> SessionBlocks:
        """Itself."""
    def __next__(self) -> dict[str, numpy.typing.NDArray[Any]]:
        """The next block that is not empty."""

class Session:
    """A recorded session, also while it is written. For one thread at a time: another call meanwhile raises
    RuntimeError. Closes with `with`.
    """

    def __init__(self, file: Union[str, os.PathLike[str]]) -> None:
        """Raises Error for what is not a session, is damaged, or of a later version."""
    @property
    def header(self) -> dict[str, Any]:
        """dict: started_utc, ended_utc, ended_by, software, machine, ticks_per_s, notes, tags,
        version, samples, dropped, first_tick, last_tick, seconds.
        """
    @property
    def fingers(self) -> list[dict[str, Any]]:
        """A dict each: name, device, capabilities, placed."""
    @property
    def worlds(self) -> list[dict[str, Any]]:
        """A dict each: number, scene (its text), folder, body, triangles, hash."""
    @property
    def columns(self) -> list[dict[str, Any]]:
        """What `samples` knows, a dict each: name, type, unit, meaning."""
    def events(self, span: Optional[tuple[int, int]] = None) -> list[dict[str, Any]]:
        """A dict each: tick, finger (None: of all), kind, text. span: first and last tick, both included."""
    def samples(self, fields: Optional[list[str]] = None, finger: Any = 0, span: Optional[tuple[int, int]] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Ticks of one finger (its number or name) as a dict of fresh arrays (N,) by column, or (N, 3) for tip,
        proxy, anchor, hold, normal, force, device_force, dent, lump_force. fields: None means every column. span: first and
        last tick, both included. Releases the GIL. Raises Error for a field, a finger, a damaged block.
        """
    def blocks(self, ticks: int = 10000, fields: Optional[list[str]] = None, finger: Any = 0, span: Optional[tuple[int, int]] = None) -> SessionBlocks:
        """Iterates over what `samples` gives, so many ticks at a time: memory for one block, however long the
        session. Spans without a sample are passed over.
        """
    def world(self, number: int = 0, folder: Union[str, os.PathLike[str]] = '') -> World:
        """Builds a recorded world. folder: where the files that its scene names lie now. Raises Error."""
    def replay(self, span: Optional[tuple[int, int]] = None, folder: Union[str, os.PathLike[str]] = '') -> ReplayReport:
        """Feels the session again and compares every bit of the span. Releases the GIL. Raises Error for a scene
        that can no longer be built.
        """
    def damaged_blocks(self) -> list[tuple[int, str]]:
        """Blocks that cannot be read, and why: pairs of number and words."""
    def close(self) -> None:
        """Lets the file go; any later question raises ValueError."""
    def __enter__(self) -> Session:
        """Itself."""
    def __exit__(self, *args: Any) -> None:
        """Closes it."""
    def __repr__(self) -> str:
        ...

class Law:
    """From how deep to how strong: F = k h(depth), k being the stiffness of the place at the
    reference depth (8 mm). Immutable. Made by `linear`, `power`, `stiffening`, `table`, `layered`,
    or `of` a world. Depths in mm under the skin, stiffness in N/mm, forces in N.
    """

    @staticmethod
    def linear() -> Law:
        """Hooke's law, h = depth."""
    @staticmethod
    def power(exponent: float = 1.6, reference_depth_mm: float = 8.0) -> Law:
        """h = d_ref (d / d_ref)^exponent; the exponent 1 to 3. Raises Error."""
    @staticmethod
    def stiffening(ratio: float = 5.0, depth_mm: float = 12.0, reference_depth_mm: float = 8.0) -> Law:
        """The slope grows along a half Gaussian to `ratio` times that of a light touch, reached at `depth_mm`.
        Raises Error.
        """
    @staticmethod
    def table(depth_mm: numpy.typing.ArrayLike, force_n: numpy.typing.ArrayLike, reference_depth_mm: float = 8.0) -> Law:
        """A measured law: arrays (R,) of at most 64 rows, depths increasing, forces not falling; scaled so
        that it agrees with the map at the reference depth. Raises ValueError, Error.
        """
    @staticmethod
    def layered(fat_mm: float = 8.0) -> Law:
        """Skin, so much fat (mm) and muscle over bone, as solved by finite elements: `tissue_mm` counts."""
    @staticmethod
    def of(world: World) -> Law:
        """The law that a world is felt by."""
    @property
    def kind(self) -> str:
        """"linear", "power", "stiffening", "table" or "layered"."""
    @property
    def exponent(self) -> float:
        """Of the power law."""
    @property
    def reference_depth_mm(self) -> float:
        """Where every law agrees with Hooke's, mm."""
    def force(self, depth_mm: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """Normal force, N, an array of the arguments' common shape; 0 above the skin. `tissue_mm`: thickness over
        the bone, which only the layered law asks for.
        """
    def tangent(self, depth_mm: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """dF/dd, N/mm, for depths >= 0: what a small change of depth feels like. Shapes as for `force`."""
    def depth(self, force_n: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """The least depth with this force, mm; 0 for a force that is not positive. Shapes as for `force`."""
    def __repr__(self) -> str:
        ...

class LayeredTissue:
    """Skin, fat and muscle over bone, solved by finite elements for a fingertip of 8 mm: what the
    bodies are made of. Immutable. Thicknesses beyond the solved ones count as the nearest.
    """

    def __init__(self, fat_mm: float = 8.0) -> None:
        """fat_mm: thickness of the fat, 0 to 60 mm, less where there is no room for it."""
    @staticmethod
    def from_table(file: Union[str, os.PathLike[str]]) -> LayeredTissue:
        """Of a table that `palpate tissue solve` or `palpate tissue fit profile` wrote. Raises Error."""
    @property
    def thinnest_mm(self) -> float:
        """The thinnest solved stack, mm."""
    @property
    def thickest_mm(self) -> float:
        """The thickest solved stack, mm."""
    def secant(self, thickness_mm: numpy.typing.ArrayLike, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Force over depth, N/mm, an array of the arguments' common shape; depths > 0."""
    def force(self, thickness_mm: numpy.typing.ArrayLike, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Normal force on the fingertip, N, an array of the arguments' common shape."""
    def deepest(self, thickness_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """How deep the skin goes at most, mm: as deep as was solved, never to the bone."""
    def pressed(self, thickness_mm: float, depth_mm: float, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """How pressed skin moves at these distances from the axis (N,): an array (N, 2), mm, into the body and away
        from the axis.
        """
    def law(self) -> Law:
        """The force law of these places, for Law's functions with `tissue_mm`."""

def published_moduli() -> list[tuple[str, float, float, str, str, str, bool]]:
    """Rows (tissue, low_kpa, high_kpa, how, source, doubt, is_default); palpate.tissue.moduli names them."""
def default_modulus(tissue: str) -> float:
    """kPa, of "skin", "fat" or "muscle" in the solved stacks. Raises Error for another word."""
def profile(q: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """The dissertation's half Gaussian: the share of the finger's motion at location ratio q, 1 under it, 0 from 1
    on. An array of q's shape.
    """
class FittedNumber:
    """A number that a fit found, and how sure it is. float() gives its value."""

    @property
    def name(self) -> str:
        """What it is called; a scene's key where there is one."""
    @property
    def value(self) -> float:
        """The number."""
    @property
    def standard_error(self) -> float:
        """NaN: too few rows to tell; 0: at the end of its range, or not asked for."""
    @property
    def at_end(self) -> bool:
        """At the end of its range: what the rows want may lie beyond."""
    def __float__(self) -> float:
        """The value."""
    def __repr__(self) -> str:
        ...

class ForceFit:
    """A force law fitted to force by depth: F = k h(depth), h(8 mm) = 8 mm."""

    @property
    def form(self) -> str:
        """"linear", "power", "stiffening", "cubic" or "measured"."""
    @property
    def secant(self) -> FittedNumber:
        """k, N/mm: what a stiffness map means."""
    @property
    def numbers(self) -> dict[str, FittedNumber]:
        """The form's numbers by name: exponent, stiffening_ratio ..."""
    @property
    def offset(self) -> FittedNumber:
        """Where the skin is met, mm below the table's 0."""
    @property
    def law(self) -> Law:
        """The Law with these numbers; a table where the engine has no such form."""
    @property
    def rms(self) -> float:
        """RMS of (fit - F) / max(F, 0.3 F_max), a fraction."""
    @property
    def unseen_rms(self) -> float:
        """The same of rows left out of the fit, a fifth at a time."""
    @property
    def rows(self) -> int:
        """How many were fitted."""
    @property
    def deepest_mm(self) -> float:
        """From the contact; beyond it the law is a guess."""
    def force(self, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """N at depths as the curve counts them; an array of their shape."""
    def __repr__(self) -> str:
        ...

class ProfileFit:
    """The shape of pressed skin: it goes down by surface_mm * down(r)."""

    @property
    def form(self) -> str:
        """"half_gaussian", "power_tail", "two_gaussians" or "measured"."""
    @property
    def depth_mm(self) -> float:
        """Of the indenter."""
    @property
    def surface_mm(self) -> float:
        """u0: of the skin on the axis."""
    @property
    def numbers(self) -> dict[str, FittedNumber]:
        """The form's numbers by name: radius_mm, exponent ..."""
    @property
    def rms(self) -> float:
        """Of the way down, a fraction of surface_mm, within 40 mm."""
    @property
    def unseen_rms(self) -> float:
        """The same of places left out of the fit."""
    def down(self, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Share of surface_mm at distances from the axis at rest, mm; an array of their shape."""
    def outward(self, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """The same of the motion away from the axis; 0 where it was not measured."""
    def __repr__(self) -> str:
        ...

def fit_forces(depth_mm: numpy.typing.ArrayLike, force_n: numpy.typing.ArrayLike, *, free_offset: bool = False, most_offset_mm: float = 0.6) -> list[ForceFit]:
    """All forms fitted to one curve: arrays (N,) in mm and N, at least four depths below the skin.
    free_offset: look for the contact between 0 and most_offset_mm. Raises ValueError, Error.
    """
def best_force_fit(fits: list[ForceFit]) -> ForceFit:
    """The form that foretells unseen rows best; of those nearly as good the simplest."""
def fit_shared_force(curves: list[tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike]], form: str, *, free_offset: bool = False) -> ForceFit:
    """One shape for several places, each with a stiffness of its own: pairs (depth_mm, force_n).
    Raises ValueError, Error.
    """
def fit_profiles(depth_mm: float, r_mm: numpy.typing.ArrayLike, down_mm: numpy.typing.ArrayLike, outward_mm: Optional[numpy.typing.ArrayLike] = None) -> list[ProfileFit]:
    """All forms of pressed skin fitted to places (N,) under one depth of the indenter; at least six radii.
    Raises ValueError, Error.
    """
def least_squares(residuals: function, start: numpy.typing.ArrayLike, low: numpy.typing.ArrayLike, high: numpy.typing.ArrayLike) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], float, list[bool]]:
    """Levenberg-Marquardt within bounds: residuals(numbers (K,)) -> (N,). Gives the numbers (K,), their
    standard errors (K,), the sum of squares and which are at a bound. What residuals raises goes through.
    """
class Device:
    """An open device: a position comes out of it, a force goes back. Whoever writes
    forces from a loop of Python does it at his own risk: nothing here limits them,
    and the interpreter may be late. palpate.devices.drive and Loop limit them.
    """

    @property
    def name(self) -> str:
        """As it was opened."""
    @property
    def capabilities(self) -> dict[str, Any]:
        """dict: takes_force, max_force_n, continuous_force_n, nominal_stiffness_n_per_mm, rate_hz,
        delay_ticks, motion_scale, model, version; 0 and empty words: it does not say.
        """
    @property
    def state(self) -> dict[str, Any]:
        """dict of what came with the last reading: velocity (3,) mm/s, buttons, faults and notes
        (bits), age_ticks, trouble (words; empty: none).
        """
    @property
    def tick(self) -> int:
        """Of the next reading."""
    def read(self, tick: Optional[int] = None) -> numpy.typing.NDArray[numpy.float64]:
        """Its position (3,), mm in the body's frame; NaN where it has none now. tick: which of a script's positions;
        None: the next. Raises ValueError once it is closed.
        """
    def write(self, force: numpy.typing.ArrayLike) -> None:
        """The force on the hand, three numbers, N; a device that only points drops it. Read before you write, once a
        tick. Raises ValueError.
        """
    def close(self) -> None:
        """Zero force, and the driver is let go. Twice is as good as once."""
    def __enter__(self) -> Device:
        """Itself."""
    def __exit__(self, *args: Any) -> None:
        """Closes it."""
    def __repr__(self) -> str:
        ...

def probe_devices(names: Optional[list[str]] = None) -> list[dict[str, Any]]:
    """A dict a back end (or of each name): name, about, available, reason, remedy, version, devices,
    looked_for. Opens nothing for long. Raises Error for a name that there is none of.
    """
def open_device(words: str, *, scale: float = 1.0, origin_mm: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), axes: str = '', library: str = '', ticks_per_s: float = 1000.0) -> Device:
    """"playback:FILE", "hand:stylus_z,omni", "openhaptics" ... (docs/reference/devices.md), and waits for its first
    position. scale: mm of the body a mm of the device; origin_mm: where its origin lies in the body.
    Releases the GIL. Raises Error with the reason.
    """
def scripted_device(tips: numpy.typing.ArrayLike) -> Device:
    """A device that repeats tips (T, 3), mm, one a tick, and rests at the last. Raises ValueError, Error."""
class Loop:
    """A servo loop that a script turns by hand: contact, limiter and devices as the engine's own loop
    has them, at the pace of the script. One thread at a time; `with` closes it.
    """

    def __init__(self, world: World, devices: Optional[list[Device]] = None, *, fingers: int = 1, settings: Any = None, session: Optional[Union[str, os.PathLike[str]]] = None, notes: str = '') -> None:
        """devices: open ones, a finger each, lent to the loop until it is closed; None: `tick` is told where so many
        `fingers` are. settings: FingerSettings, one or one a finger; None: the scene's. session: a file that
        records every tick. Raises Error, ValueError, RuntimeError (a device in use).
        """
    def tick(self, tips: Any = None) -> list[Touch]:
        """One tick of all fingers: a Touch each. tips (F, 3), mm: where they are, when no device holds them. The
        first positions must be outside the body, like a hand that comes to it.
        """
    def lift(self, finger: int = 0) -> None:
        """The finger is put elsewhere: it forgets what it touched."""
    def mark(self, text: str) -> None:
        """A mark at the newest tick of the session. Raises ValueError where none is recorded."""
    @property
    def device_forces(self) -> numpy.typing.NDArray[numpy.float64]:
        """What the devices were sent in the last tick (F, 3), N: the contact's force, limited."""
    @property
    def ticks(self) -> int:
        """How many there were."""
    def close(self) -> None:
        """Zero force; devices are given back, the session is finished under its name."""
    def __enter__(self) -> Loop:
        """Itself."""
    def __exit__(self, *args: Any) -> None:
        """Closes it."""

def drive(world: World, devices: list[Device], seconds: float, *, settings: Any = None, session: Optional[Union[str, os.PathLike[str]]] = None, notes: str = '') -> dict[str, Any]:
    """The engine's servo thread for so many seconds, at the scene's rate, a finger a device, within the limits of
    the weakest device. A dict: ticks, overruns, slow_ticks, stalls, wall_s, compute_us and lateness_us (p50,
    p99, p99_9, max), note. session: a file that records every tick. Releases the GIL; Ctrl-C ends it without
    force. Raises Error, ValueError, RuntimeError (a device in use).
    """
