"""The engine of palpate; use the package palpate.

Made by tools/python-stubs from the docstrings; not edited by hand.
"""

import os
from typing import Any, Callable, Iterable, Iterator, Optional, Sequence, Union, overload

import numpy
import numpy.typing


__version__: str

class Error(ValueError):
    """Error while loading, building or using something, in one line: `where: cause`.

    file (str or None): the file, as it was named; line (int or None): counted from 1;
    cause (str): the words without file and line.
    """

    file: Optional[str]
    line: Optional[int]
    cause: str

class World:
    """A touchable body, made by load, parse, torso, trunk, from_file or from_arrays. Immutable; any number of threads may share it.

    mm, N, s; x to the patient's right seen from behind, y to the head, z out of the back.
    """

    def __init__(self, *, lumps: Optional[Sequence[Lump]] = None, body: str = 'trunk', triangles: int = 0) -> None:
        """A built-in body with lumps under its skin. body: 'trunk' or 'torso'; triangles: number in skin and bones, 0 for the default. Raises palpate.Error for a lump that cannot be at its place."""
    @staticmethod
    def load(file: Union[str, os.PathLike[str]]) -> World:
        """A world from a scene file (docs/reference/scene-files.md). Raises palpate.Error with file and line. Releases the GIL, like everything that builds a world; Ctrl-C interrupts."""
    @staticmethod
    def parse(toml: str, name: str = 'scene') -> World:
        """A world from the text of a scene file. name: shown as the file in messages; its folder is the base of relative file names in the text. Raises palpate.Error with name and line."""
    @staticmethod
    def torso(*, triangles: int = 20389) -> World:
        """The dissertation's open back with 43 bones. triangles: number in skin and bones. Raises palpate.Error for too few. Takes 0.6 s."""
    @staticmethod
    def trunk(*, triangles: int = 83164) -> World:
        """The closed body from neck to thighs. triangles: number in skin and bones, even. Raises palpate.Error for too few. Takes 1 to 2 s."""
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
        """The same body with another scene's force law, stiffness, maps and friction: the same triangles in the same order, in milliseconds. toml: text of a whole scene; its [body] is ignored. Raises palpate.Error with name and line."""
    @property
    def positions(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V, 3) vertices of the skin at rest, mm; a read-only view, like all arrays of a World."""
    @property
    def normals(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V, 3) unit vertex normals, pointing outwards, weighted by angle."""
    @property
    def triangles(self) -> numpy.typing.NDArray[numpy.int32]:
        """(F, 3) int32: three vertices each, counter-clockwise seen from outside."""
    @property
    def stiffness(self) -> numpy.typing.NDArray[numpy.float64]:
        """(V,) stiffness per vertex, N/mm."""
    @property
    def source_vertex(self) -> numpy.typing.NDArray[numpy.int32]:
        """(V,) int32: index of the given vertex for each vertex. Raises palpate.Error unless the world was made from a mesh."""
    @property
    def source_triangle(self) -> numpy.typing.NDArray[numpy.int32]:
        """(F,) int32: index of the given triangle for each triangle; -1 for one made by repair. Raises like `source_vertex`."""
    @property
    def built_vertex(self) -> numpy.typing.NDArray[numpy.int32]:
        """Index of the world's vertex for each given vertex; -1 for one that the world lacks. Raises like `source_vertex`."""
    @property
    def built_triangle(self) -> numpy.typing.NDArray[numpy.int32]:
        """Index of the world's triangle for each given triangle, or -1. Raises like `source_vertex`."""
    @property
    def landmarks(self) -> dict[str, numpy.typing.NDArray[numpy.float64]]:
        """Named points on the skin, (3,) mm, by the names of the bones ("spinous_T6"); {} for a mesh."""
    @property
    def landmark_normals(self) -> dict[str, numpy.typing.NDArray[numpy.float64]]:
        """Normals of the skin at the landmarks, (3,), by the same names."""
    def place(self, place: Union[str, numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) mm: the point of the skin at rest for a name ("T6", "left PSIS", "T6 right 30 mm"; docs/reference/names.md), or the one nearest to a point (3,). Raises palpate.Error, which suggests the name nearest in spelling."""
    def normal_at(self, place: Union[str, numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) unit normal of the triangle at a place, pointing outwards. Raises like `place`."""
    def triangle_at(self, place: Union[str, numpy.typing.ArrayLike]) -> int:
        """Triangle at a place, as a row of `triangles`. Raises like `place`."""
    def stiffness_at(self, place: Union[str, numpy.typing.ArrayLike]) -> float:
        """Stiffness at a place, N/mm, interpolated between the vertices. Raises like `place`."""
    def tips(self, place: Union[str, numpy.typing.ArrayLike], depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """(T, 3) mm: a path along the normal of a place, at these depths (T,) below the skin, mm; negative is above it. Raises like `place`."""
    def words(self, point: numpy.typing.ArrayLike) -> str:
        """A point (3,) in an examiner's words: "T6, 12 mm right and 8 mm up"; "" for a body without names."""
    @property
    def place_names(self) -> list[str]:
        """All names accepted by `place`; [] for a mesh."""
    def ellipses(self, xy: Union[str, Sequence[str], numpy.typing.ArrayLike]) -> numpy.typing.NDArray[numpy.float64]:
        """(N, 3): half axes, mm, the longer first, and direction of the longer against x, rad in [0, pi), of the deformation ellipses at xy (N, 2), mm, or at named places."""
    @property
    def notes(self) -> list[str]:
        """Notes for the user: ignored parts of a file, repairs, a doubtful unit."""
    @property
    def name(self) -> str:
        """Name of the body."""
    @property
    def closed(self) -> bool:
        """Whether the skin has no border."""
    @property
    def fingers(self) -> int:
        """Number of fingers in the scene."""
    def __repr__(self) -> str:
        """Short description."""
    def finger_settings(self, n: int = 1) -> list[FingerSettings]:
        """List of n FingerSettings: the scene's fingers in order, then point fingers with its friction."""
    def with_lumps(self, lumps: Optional[Sequence[Lump]]) -> World:
        """The same body with only these lumps, in about 30 ms per lump: the same triangles in the same order. Requires layered tissue: a built-in body, or a mesh under a scene with [tissue] layer_table. Raises palpate.Error."""
    @property
    def lumps(self) -> list[dict[str, Any]]:
        """Lumps under the skin, one dict each: name; foot (3,) on the skin above its centre, axis (3,) out of the skin, across and up (3,), mm; half_axes_mm (3,), depth_mm of its top; young_kpa, layer_kpa of the tissue around it; tissue_mm over the bone; mobility_mm_per_n; share: what it adds to the force of a fingertip right over it, by the depth of the press, mm; note, all of this in a line."""
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
    """Settings of a finger: radius, stiffness, friction, relaxation. Checked on creation; immutable, `replace` makes a changed copy.

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
        """Keyword arguments only; omitted ones have their default. Raises palpate.Error."""
    @property
    def radius_mm(self) -> float:
        """Radius of the finger, mm; 0 is a point."""
    @property
    def stiffness_ratio(self) -> float:
        """Tangential divided by normal stiffness."""
    @property
    def mu_static(self) -> float:
        """Coefficient of static friction."""
    @property
    def mu_dynamic(self) -> float:
        """Coefficient of friction while slipping."""
    @property
    def max_depth_mm(self) -> float:
        """Maximum depth that is felt, mm."""
    @property
    def tick_s(self) -> float:
        """Length of a tick, s."""
    @property
    def catch_up_mm_per_s(self) -> float:
        """Maximum speed of the point on the skin relative to the tip, mm/s."""
    @property
    def relaxation_share(self) -> float:
        """Fraction of the force that relaxes during a hold."""
    @property
    def relaxation_time_s(self) -> float:
        """Time constant of the relaxation, s."""
    @property
    def relaxation_share_2(self) -> float:
        """Fraction of a second relaxation term."""
    @property
    def relaxation_time_2_s(self) -> float:
        """Time constant of the second term, s."""
    @property
    def force_shading(self) -> bool:
        """Whether the force is smoothed over coarse triangles."""
    def replace(self, **kwargs: Any) -> FingerSettings:
        """A copy with some values changed, named as in the constructor. Raises TypeError for an unknown name, palpate.Error for a value out of range."""
    def __repr__(self) -> str:
        """The call of the constructor."""
    def __eq__(self, other: object) -> bool:
        """Whether all values are equal."""
    def __hash__(self) -> int:
        """Hash of all values."""

class Touch:
    """Contact of a finger in one tick: an immutable snapshot. Arrays are read-only views of it."""

    @property
    def force(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) force on the finger, N."""
    @property
    def tip(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) position of the finger, mm."""
    @property
    def proxy(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) point on the skin that it presses, mm; the tip when free."""
    @property
    def anchor(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) point on the skin held by friction, mm; the tip when free."""
    @property
    def hold(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) point in space where friction holds the tip, mm; the tip when free."""
    @property
    def normal(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) unit normal, out of the skin; zeros when free."""
    @property
    def depth_mm(self) -> float:
        """Depth along the normal, mm; 0 when free."""
    @property
    def tissue_mm(self) -> float:
        """Effective tissue thickness over the bone under the finger, larger over a narrow one, mm; 0 when free or unknown."""
    @property
    def rest_mm(self) -> float:
        """Effective depth at which the skin under the finger would stay without force, mm."""
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
        """Radius of the finger, mm; 0 is a point."""
    @property
    def lump_force(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) part of `force` added by the lumps under the skin, N."""
    @property
    def lump_share(self) -> float:
        """Normal force of the lumps divided by that of the press without them; 0 where that is 0."""
    @property
    def lump(self) -> int:
        """Index in World.lumps of the nearest movable lump that is felt; -1 for none."""
    @property
    def lump_moved(self) -> numpy.typing.NDArray[numpy.float64]:
        """(2,) displacement of that lump from its place, mm across and up."""
    def __repr__(self) -> str:
        """Short description."""

class Finger:
    """One finger on a world, one tick per call. Keeps its world alive. Not thread-safe."""

    def __init__(self, world: World, settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None) -> None:
        """settings: a FingerSettings, or None for the scene's first finger. Raises palpate.Error if they do not suit the world."""
    @property
    def world(self) -> World:
        """The world that it touches."""
    @property
    def settings(self) -> FingerSettings:
        """Its settings."""
    def lift(self) -> None:
        """Lifts the finger. The next tip may be anywhere; the motion in between makes no contact."""
    def reset(self) -> None:
        """Resets to the initial state: lifts the finger, restarts its clock (for a breathing body) and puts moved lumps back."""
    @overload
    def step(self, tip: numpy.typing.ArrayLike) -> Touch:
        """One tick with the tip at (3,), mm, FingerSettings.tick_s after the last. A ball's tip is its centre.

        An array of float64 is fastest. A tip that is not finite is lost: status 1, no force, and the finger stays as it was.
        Raises TypeError for what is not a number, ValueError for another shape. The interpreter's lock is kept.
        """
    @overload
    def step(self, x: float, y: float, z: float) -> Touch:
        """The same with three coordinates."""

class Lump:
    """A lump under the skin: a node, a cyst, a hard band. Checked on creation; immutable.

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
        """Keyword arguments only. Raises palpate.Error, or ValueError for wrong shapes."""
    @property
    def name(self) -> str:
        """Name as given."""
    @property
    def at(self) -> Union[str, numpy.typing.ArrayLike]:
        """Place on the skin above its centre: a name, or x and y, mm."""
    @property
    def depth_mm(self) -> float:
        """Depth of its top below the skin at rest, mm."""
    @property
    def half_axes_mm(self) -> numpy.typing.NDArray[numpy.float64]:
        """(3,) half axes: across, across, into the body, mm."""
    def __repr__(self) -> str:
        """The call of the constructor."""
    def __eq__(self, other: object) -> bool:
        """Whether all values are equal."""
    def __hash__(self) -> int:
        """Hash of all values."""

def _world_of(toml: str, mesh: Any, hash: str) -> World:
    """Rebuilds a World from its pickle."""
def _native_rollout_seconds(world: World, tips: numpy.typing.ArrayLike) -> float:
    """Time in s of a C++ loop over the path (T, 3) of one finger, storing its outputs; for tools/bench-python."""
class Fingers:
    """A batch of fingers on one world, or shared among several; they keep their state between calls.

    One call at a time: a second, from another thread, raises RuntimeError. After a fork the child may use it, threads and all. `with` closes it.
    """

    def __init__(self, world: Union[World, Sequence[World]], n: int, *, settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None, threads: int = 1) -> None:
        """n fingers; world: one, or several, and all begin in the first; settings: None for the (first) scene's, a FingerSettings for all, or a sequence of n; threads: share the work of a call above 5,000 ticks. Raises palpate.Error if the settings do not suit a world."""
    def step(self, tips: numpy.typing.ArrayLike, *, substeps: int = 1, fields: Optional[Sequence[str]] = None, out: Optional[dict[str, numpy.typing.NDArray[Any]]] = None, mask: Optional[numpy.typing.ArrayLike] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Moves every finger to its tip (n, 3), mm, and returns its contact in the last tick.

        substeps: ticks that the way takes, in a straight line from where the finger was sent last: tick k is at from + (to - from) * (k / substeps)
        fields, out: as for World.rollout, arrays (n, ...)
        mask: (n,) bool, those that move; the others' clocks stand still, and their rows of `out` stay as they are; None: all

        Arrays are fresh unless `out` is given. The interpreter's lock is released, Ctrl-C interrupts: some fingers have moved then. Raises RuntimeError while another call is at work, ValueError for shapes.
        """
    def reset(self, mask: Optional[numpy.typing.ArrayLike] = None, worlds: Optional[numpy.typing.ArrayLike] = None) -> None:
        """Resets the fingers with True in mask (n,), or all for None.

        worlds: (n,) whole numbers of the worlds that they go to, as they were given, read for all but used where the mask is True; None: each stays in its world. Raises RuntimeError, ValueError.
        """
    def lift(self, mask: Optional[numpy.typing.ArrayLike] = None) -> None:
        """Lifts the fingers with True in mask (n,), or all for None; their next tips may be anywhere. Raises RuntimeError, ValueError."""
    def touches(self) -> list[Touch]:
        """List of the n Touch of the last ticks, for Skin.apply. Raises RuntimeError during another call."""
    def close(self) -> None:
        """Ends its threads. Later calls raise ValueError; closing again has no effect."""
    def __enter__(self) -> Fingers:
        """Returns itself."""
    def __exit__(self, *args: Any) -> None:
        """Calls close()."""
    def __len__(self) -> int:
        """Number of fingers."""
    @property
    def world(self) -> World:
        """The world that they touch; the first of several."""
    @property
    def worlds(self) -> list[World]:
        """List of the worlds that they touch."""
    @property
    def threads(self) -> int:
        """Number of threads that share the work of a call."""

class Tools:
    """A batch of tools of several pads, rigid bodies with a pose each, on one world or shared among several; they keep their state between calls.

    tool: "head", a linear ultrasound head of 60 x 12 mm, x along it; "palm", "fingertip", "knuckle" (docs/explanation/tools.md). In its frame the skin is below, z points away from it. Lumps that move stay at their places.

    One call at a time, as Fingers. `with` closes it.
    """

    def __init__(self, world: Union[World, Sequence[World]], n: int, *, tool: str = 'head', settings: Optional[Union[FingerSettings, Sequence[FingerSettings]]] = None, threads: int = 1) -> None:
        """n tools, all in the first world; settings: of every pad, whose radius is the tool's; None: the scene's. Raises palpate.Error for a world that breathes or has a detecting box, ValueError for an unknown tool."""
    def step(self, positions: numpy.typing.ArrayLike, rotations: numpy.typing.ArrayLike, *, substeps: int = 1, out: Optional[dict[str, numpy.typing.NDArray[Any]]] = None, mask: Optional[numpy.typing.ArrayLike] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Moves every tool to its pose and returns its contact in the last tick: force (n, 3), N; moment (n, 3), N mm, about its position; depth (n,), mm, of its deepest pad; touching (n,) int32, pads on the skin.

        positions: (n, 3), mm, of its frame; rotations: (n, 3, 3), from its frame to the body's, columns its x, y and z
        substeps: ticks that the way takes, in a straight line and about one axis
        out, mask: as for Fingers.step

        The interpreter's lock is released, Ctrl-C interrupts. Raises RuntimeError during another call, ValueError for shapes and what is no rotation.
        """
    def reset(self, mask: Optional[numpy.typing.ArrayLike] = None, worlds: Optional[numpy.typing.ArrayLike] = None) -> None:
        """Lifts the tools with True in mask (n,), or all for None; their next poses may be anywhere. worlds: as for Fingers.reset. Raises RuntimeError, ValueError."""
    def touches(self) -> list[Touch]:
        """List of a Touch for each pad of each tool in the last ticks. Raises RuntimeError during another call."""
    def close(self) -> None:
        """Ends its threads. Later calls raise ValueError; closing again has no effect."""
    def __enter__(self) -> Tools:
        """Returns itself."""
    def __exit__(self, *args: Any) -> None:
        """Calls close()."""
    def __len__(self) -> int:
        """Number of tools."""
    @property
    def pads(self) -> int:
        """Number of pads of a tool."""

class Skin:
    """The skin of a world, deformed by fingers.

    Its arrays are live, read-only views: the next `apply` changes what they show. They are for the thread that applies; `copy` is for others and for later.
    """

    def __init__(self, world: World, *, strain: bool = True, fingers: int = 16) -> None:
        """Begins at rest. strain: also compute the strain; fingers: maximum number applied at once. Raises palpate.Error."""
    def apply(self, touches: Union[Touch, Iterable[Touch]], *, tick: int = 0) -> None:
        """Deforms the skin by these touches, whatever its state before; an empty list brings it to rest.

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
        """(V, 3) float32 unit normals; a live view."""
    @property
    def displacement(self) -> numpy.typing.NDArray[numpy.float32]:
        """(V, 3) float32, mm from rest, 0 where the skin does not move; a live view."""
    @property
    def strain(self) -> numpy.typing.NDArray[numpy.float32]:
        """(V,) float32, 0.1 is 10 % longer, below 0 shorter; zeros without strain. A live view."""
    @property
    def changed(self) -> numpy.typing.NDArray[numpy.int64]:
        """(R, 2) int64: ranges of vertices, first and end, written by the last `apply`; a new array."""
    @property
    def moved_vertices(self) -> int:
        """Number of vertices within reach of a finger in the last `apply`."""
    @property
    def status(self) -> int:
        """Bits of the last `apply`: 1 a contact that is not finite, 2 without triangle, 4 more than there is room for, 8 a region without area, 16 without a vertex (docs/explanation/deformation.md)."""
    @property
    def world(self) -> World:
        """The world that the skin belongs to."""

class ReplayDifference:
    """First place where a replay differs from the recording."""

    @property
    def tick(self) -> int:
        """Tick of the servo loop."""
    @property
    def finger(self) -> str:
        """Name of the finger."""
    @property
    def field(self) -> str:
        """Name of the column."""
    @property
    def recorded(self) -> str:
        """Value in the file, as text."""
    @property
    def replayed(self) -> str:
        """Value of the replay, as text."""
    def __repr__(self) -> str:
        ...

class ReplayReport:
    """Result of replaying a session."""

    @property
    def identical(self) -> bool:
        """Whether every compared bit is the same."""
    @property
    def ticks(self) -> int:
        """Number of compared samples."""
    @property
    def different(self) -> int:
        """Number of samples that differ."""
    @property
    def unproven(self) -> int:
        """Samples that could not be compared, because earlier ticks are missing from the session."""
    @property
    def first_difference(self) -> Optional[ReplayDifference]:
        """The first difference, or None."""
    @property
    def notes(self) -> list[str]:
        """Notes, e.g. a body that differs from the recorded one."""
    @property
    def gaps(self) -> list[str]:
        """Spans with missing ticks, as text."""
    def __repr__(self) -> str:
        ...

class SessionRepair:
    """What was recovered from a damaged session, and what was lost."""

    @property
    def nothing_lost(self) -> bool:
        """Whether everything recorded is in the new file."""
    @property
    def samples(self) -> int:
        """Number of recovered samples."""
    @property
    def blocks(self) -> int:
        """Number of recovered blocks."""
    @property
    def events(self) -> int:
        """Number of recovered events."""
    @property
    def worlds(self) -> int:
        """Number of recovered worlds."""
    @property
    def attachments(self) -> int:
        """Number of recovered attachments."""
    @property
    def samples_lost(self) -> int:
        """Number of lost samples, as far as their times are known."""
    @property
    def blocks_lost(self) -> int:
        """Number of blocks that are missing or have a wrong checksum."""
    @property
    def bytes_missing(self) -> int:
        """Number of bytes missing at the end of the file."""
    @property
    def header_lost(self) -> bool:
        """Whether the header is lost: start time, rate, notes."""
    @property
    def lost(self) -> list[dict[str, Any]]:
        """Lost spans, one dict each: finger, first_tick, last_tick (inclusive), samples."""
    @property
    def gaps(self) -> list[dict[str, Any]]:
        """Spans that were never recorded, in the form of `lost`."""
    @property
    def other_lost(self) -> list[Any]:
        """Lost worlds, names and attachments, one line each."""
    @property
    def notes(self) -> list[Any]:
        """Other observations."""
    def __repr__(self) -> str:
        ...

def repair(file: Union[str, os.PathLike[str]], target: Union[str, os.PathLike[str]], *, overwrite: bool = False) -> SessionRepair:
    """Writes the readable parts of a damaged session into `target`; `file` is only read. A sample comes
    out with every bit, or not at all. Releases the GIL. Raises Error if nothing can be recovered, for
    a target that already exists, and for the same file twice.
    """
class SessionBlocks:
    """Iterator over a session, one dict of arrays at a time."""

    def __iter__(self) -> SessionBlocks:
        """Returns itself."""
    def __next__(self) -> dict[str, numpy.typing.NDArray[Any]]:
        """Returns the next non-empty block."""

class Session:
    """A recorded session, readable while it is being written. Not thread-safe: a concurrent call raises
    RuntimeError. Closes with `with`.
    """

    def __init__(self, file: Union[str, os.PathLike[str]]) -> None:
        """Raises Error for a file that is not a session, is damaged, or is of a later version."""
    @property
    def header(self) -> dict[str, Any]:
        """dict: started_utc, ended_utc, ended_by, software, machine, ticks_per_s, notes, tags,
        version, samples, dropped, first_tick, last_tick, seconds.
        """
    @property
    def fingers(self) -> list[dict[str, Any]]:
        """Fingers, one dict each: name, device, capabilities, placed."""
    @property
    def worlds(self) -> list[dict[str, Any]]:
        """Worlds, one dict each: number, scene (its text), folder, body, triangles, hash."""
    @property
    def columns(self) -> list[dict[str, Any]]:
        """Columns of `samples`, one dict each: name, type, unit, meaning."""
    def events(self, span: Optional[tuple[int, int]] = None) -> list[dict[str, Any]]:
        """Events, one dict each: tick, finger (None for all), kind, text. span: first and last tick, inclusive."""
    def samples(self, fields: Optional[list[str]] = None, finger: Any = 0, span: Optional[tuple[int, int]] = None) -> dict[str, numpy.typing.NDArray[Any]]:
        """Ticks of one finger (its number or name) as a dict of new arrays (N,) by column, or (N, 3) for tip,
        proxy, anchor, hold, normal, force, device_force, dent, lump_force. fields: None means every column. span: first and
        last tick, both included. Releases the GIL. Raises Error for a field, a finger, a damaged block.
        """
    def blocks(self, ticks: int = 10000, fields: Optional[list[str]] = None, finger: Any = 0, span: Optional[tuple[int, int]] = None) -> SessionBlocks:
        """Iterates over `samples`, this many ticks at a time; uses memory for one block, however long the
        session. Spans without samples are skipped.
        """
    def world(self, number: int = 0, folder: Union[str, os.PathLike[str]] = '') -> World:
        """Builds a recorded world. folder: current location of the files that its scene names. Raises Error."""
    def replay(self, span: Optional[tuple[int, int]] = None, folder: Union[str, os.PathLike[str]] = '') -> ReplayReport:
        """Replays the session and compares every bit of the span. Releases the GIL. Raises Error for a scene
        that can no longer be built.
        """
    def damaged_blocks(self) -> list[tuple[int, str]]:
        """Blocks that cannot be read: pairs of number and reason."""
    def close(self) -> None:
        """Closes the file; later calls raise ValueError."""
    def __enter__(self) -> Session:
        """Returns itself."""
    def __exit__(self, *args: Any) -> None:
        """Calls close()."""
    def __repr__(self) -> str:
        ...

class Law:
    """A force law, from depth to force: F = k h(depth), where k is the stiffness of the place at the
    reference depth (8 mm). Immutable. Made by `linear`, `power`, `stiffening`, `table`, `layered`,
    or `of` a world. Depths in mm under the skin, stiffness in N/mm, forces in N.
    """

    @staticmethod
    def linear() -> Law:
        """Hooke's law, h = depth."""
    @staticmethod
    def power(exponent: float = 1.6, reference_depth_mm: float = 8.0) -> Law:
        """h = d_ref (d / d_ref)^exponent, with an exponent of 1 to 3. Raises Error."""
    @staticmethod
    def stiffening(ratio: float = 5.0, depth_mm: float = 12.0, reference_depth_mm: float = 8.0) -> Law:
        """The slope grows along a half Gaussian to `ratio` times that of a light touch, reached at `depth_mm`.
        Raises Error.
        """
    @staticmethod
    def table(depth_mm: numpy.typing.ArrayLike, force_n: numpy.typing.ArrayLike, reference_depth_mm: float = 8.0) -> Law:
        """A measured law: arrays (R,) of at most 64 rows, increasing depths, non-decreasing forces; scaled so
        that it agrees with the map at the reference depth. Raises ValueError, Error.
        """
    @staticmethod
    def layered(fat_mm: float = 8.0) -> Law:
        """Skin, fat of this thickness (mm) and muscle over bone, solved by finite elements; depends on `tissue_mm`."""
    @staticmethod
    def of(world: World) -> Law:
        """The force law of a world."""
    @property
    def kind(self) -> str:
        """"linear", "power", "stiffening", "table" or "layered"."""
    @property
    def exponent(self) -> float:
        """Exponent of the power law."""
    @property
    def reference_depth_mm(self) -> float:
        """Depth at which every law agrees with Hooke's, mm."""
    def force(self, depth_mm: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """Normal force, N, in the broadcast shape of the arguments; 0 above the skin. `tissue_mm`: thickness over
        the bone, which only the layered law asks for.
        """
    def tangent(self, depth_mm: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """dF/dd, N/mm, for depths >= 0: the stiffness for small changes of depth. Shapes as for `force`."""
    def depth(self, force_n: numpy.typing.ArrayLike, stiffness: numpy.typing.ArrayLike = 1.0, tissue_mm: numpy.typing.ArrayLike = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """Smallest depth with this force, mm; 0 for a force that is not positive. Shapes as for `force`."""
    def __repr__(self) -> str:
        ...

class LayeredTissue:
    """Skin, fat and muscle over bone, solved by finite elements for a fingertip of 8 mm: what the
    bodies are made of. Immutable. Thicknesses beyond the solved ones count as the nearest.
    """

    def __init__(self, fat_mm: float = 8.0) -> None:
        """fat_mm: thickness of the fat, 0 to 60 mm, less where there is no room."""
    @staticmethod
    def from_table(file: Union[str, os.PathLike[str]]) -> LayeredTissue:
        """Reads a table written by `palpate tissue solve` or `palpate tissue fit profile`. Raises Error."""
    @property
    def thinnest_mm(self) -> float:
        """Thickness of the thinnest solved stack, mm."""
    @property
    def thickest_mm(self) -> float:
        """Thickness of the thickest solved stack, mm."""
    def secant(self, thickness_mm: numpy.typing.ArrayLike, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Force divided by depth, N/mm, in the broadcast shape of the arguments; depths > 0."""
    def force(self, thickness_mm: numpy.typing.ArrayLike, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Normal force on the fingertip, N, in the broadcast shape of the arguments."""
    def deepest(self, thickness_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Maximum depth of the skin, mm: the deepest that was solved, never down to the bone."""
    def pressed(self, thickness_mm: float, depth_mm: float, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Motion of pressed skin at these distances from the axis (N,): an array (N, 2), mm, into the body and away
        from the axis.
        """
    def law(self) -> Law:
        """The force law of this tissue, for Law's functions with `tissue_mm`."""

def published_moduli() -> list[tuple[str, float, float, str, str, str, bool]]:
    """Rows (tissue, low_kpa, high_kpa, how, source, doubt, is_default); palpate.tissue.moduli names them."""
def default_modulus(tissue: str) -> float:
    """Young's modulus (kPa) of "skin", "fat" or "muscle" in the solved stacks. Raises Error for any other word."""
def profile(q: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
    """The dissertation's half Gaussian: the share of the finger's motion at location ratio q, 1 under it, 0 from 1
    on. An array of q's shape.
    """
class FittedNumber:
    """A fitted number with its standard error. float() gives its value."""

    @property
    def name(self) -> str:
        """Its name; the key of a scene if there is one."""
    @property
    def value(self) -> float:
        """The value."""
    @property
    def standard_error(self) -> float:
        """Standard error; NaN for too few rows; 0 at the end of its range, or if not fitted."""
    @property
    def at_end(self) -> bool:
        """Whether it is at the end of its range; the best value may be beyond."""
    def __float__(self) -> float:
        """The value."""
    def __repr__(self) -> str:
        ...

class ForceFit:
    """A force law fitted to measured forces: F = k h(depth), h(8 mm) = 8 mm."""

    @property
    def form(self) -> str:
        """"linear", "power", "stiffening", "cubic" or "measured"."""
    @property
    def secant(self) -> FittedNumber:
        """k, N/mm: the value of a stiffness map."""
    @property
    def numbers(self) -> dict[str, FittedNumber]:
        """Parameters of the form by name: exponent, stiffening_ratio ..."""
    @property
    def offset(self) -> FittedNumber:
        """Depth at which the skin is met, mm below the table's 0."""
    @property
    def law(self) -> Law:
        """The Law with these parameters; a table if the engine has no such form."""
    @property
    def rms(self) -> float:
        """RMS of (fit - F) / max(F, 0.3 F_max), a fraction."""
    @property
    def unseen_rms(self) -> float:
        """RMS for rows left out of the fit, a fifth at a time."""
    @property
    def rows(self) -> int:
        """Number of fitted rows."""
    @property
    def deepest_mm(self) -> float:
        """Largest fitted depth from the contact, mm; beyond it the law is an extrapolation."""
    def force(self, depth_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Force, N, at depths of the curve; an array of their shape."""
    def __repr__(self) -> str:
        ...

class ProfileFit:
    """Fitted shape of pressed skin: it moves down by surface_mm * down(r)."""

    @property
    def form(self) -> str:
        """"half_gaussian", "power_tail", "two_gaussians" or "measured"."""
    @property
    def depth_mm(self) -> float:
        """Depth of the indenter, mm."""
    @property
    def surface_mm(self) -> float:
        """u0: depth of the skin on the axis, mm."""
    @property
    def numbers(self) -> dict[str, FittedNumber]:
        """Parameters of the form by name: radius_mm, exponent ..."""
    @property
    def rms(self) -> float:
        """RMS of the downward motion, as a fraction of surface_mm, within 40 mm."""
    @property
    def unseen_rms(self) -> float:
        """RMS for places left out of the fit."""
    def down(self, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Downward motion as a fraction of surface_mm, at distances from the axis at rest, mm; an array of their shape."""
    def outward(self, r_mm: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float64]:
        """Motion away from the axis as a fraction of surface_mm; 0 if not measured."""
    def __repr__(self) -> str:
        ...

def fit_forces(depth_mm: numpy.typing.ArrayLike, force_n: numpy.typing.ArrayLike, *, free_offset: bool = False, most_offset_mm: float = 0.6) -> list[ForceFit]:
    """All forms fitted to one curve: arrays (N,) in mm and N, at least four depths below the skin.
    free_offset: look for the contact between 0 and most_offset_mm. Raises ValueError, Error.
    """
def best_force_fit(fits: list[ForceFit]) -> ForceFit:
    """The form that predicts unseen rows best; the simplest of those nearly as good."""
def fit_shared_force(curves: list[tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike]], form: str, *, free_offset: bool = False) -> ForceFit:
    """One shape for several places, each with its own stiffness: pairs (depth_mm, force_n).
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
        """Name under which it was opened."""
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
        """Tick of the next reading."""
    def read(self, tick: Optional[int] = None) -> numpy.typing.NDArray[numpy.float64]:
        """Its position (3,), mm in the body's frame; NaN where it has none now. tick: which of a script's positions;
        None: the next. Raises ValueError once it is closed.
        """
    def write(self, force: numpy.typing.ArrayLike) -> None:
        """The force on the hand, three numbers, N; a device that only points drops it. Read before you write, once a
        tick. Raises ValueError.
        """
    def close(self) -> None:
        """Sets zero force and releases the driver. Closing again has no effect."""
    def __enter__(self) -> Device:
        """Returns itself."""
    def __exit__(self, *args: Any) -> None:
        """Calls close()."""
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
    """A device that plays tips (T, 3), mm, one per tick, and stays at the last. Raises ValueError, Error."""
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
        """Lifts the finger; the next tip may be anywhere."""
    def mark(self, text: str) -> None:
        """Sets a mark at the newest tick of the session. Raises ValueError if none is recorded."""
    @property
    def device_forces(self) -> numpy.typing.NDArray[numpy.float64]:
        """Forces sent to the devices in the last tick (F, 3), N: the contact force after the safety limits."""
    @property
    def ticks(self) -> int:
        """Number of ticks so far."""
    def close(self) -> None:
        """Sets zero force, returns the devices and completes the session file."""
    def __enter__(self) -> Loop:
        """Returns itself."""
    def __exit__(self, *args: Any) -> None:
        """Calls close()."""

def drive(world: World, devices: list[Device], seconds: float, *, settings: Any = None, session: Optional[Union[str, os.PathLike[str]]] = None, notes: str = '') -> dict[str, Any]:
    """The engine's servo thread for so many seconds, at the scene's rate, a finger a device, within the limits of
    the weakest device. A dict: ticks, overruns, slow_ticks, stalls, wall_s, compute_us and lateness_us (p50,
    p99, p99_9, max), note. session: a file that records every tick. Releases the GIL; Ctrl-C ends it without
    force. Raises Error, ValueError, RuntimeError (a device in use).
    """
