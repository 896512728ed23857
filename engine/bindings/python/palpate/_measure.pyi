"""Photographs of dots; use palpate.measure.

Made by tools/python-stubs from the docstrings; not edited by hand.
"""

import os
from typing import Any, Callable, Iterable, Iterator, Optional, Sequence, Union, overload

import numpy
import numpy.typing


class Estimate:
    """A number and its standard deviation. float() gives the number."""

    @property
    def value(self) -> float:
        """The value."""
    @property
    def sd(self) -> float:
        """Standard deviation."""
    def __float__(self) -> float:
        """The number."""
    def __repr__(self) -> str:
        ...

class KeyEllipse:
    """Ellipse through the places that move by level_mm."""

    @property
    def level_mm(self) -> float:
        """2 or 4."""
    @property
    def half_major_mm(self) -> Estimate:
        """Half the major axis."""
    @property
    def half_minor_mm(self) -> Estimate:
        """Half the minor axis."""
    @property
    def major_over_minor(self) -> Estimate:
        """Ratio of the axes."""
    @property
    def direction_deg(self) -> Estimate:
        """Direction of the major axis, from the right towards the head, in (-90, 90]."""
    def __repr__(self) -> str:
        ...

class Measurement:
    """Measurement from two pictures, with its verdict. Values that were not fitted are None."""

    @property
    def accepted(self) -> bool:
        """Whether no finding rejects it."""
    @property
    def findings(self) -> list[dict[str, Any]]:
        """Findings against it, one dict each: severity ("refusal", "warning"), code (stable),
        text (what was seen and what to do).
        """
    @property
    def ellipse(self) -> Optional[KeyEllipse]:
        """The key ellipse, of 2 mm; None without a fit."""
    @property
    def ellipse_4_mm(self) -> Optional[KeyEllipse]:
        """The ellipse of 4 mm."""
    @property
    def peak_mm(self) -> Optional[Optional[Estimate]]:
        """Motion of the skin under the contact, mm."""
    @property
    def drag_deg(self) -> Optional[Estimate]:
        """Direction in which it was pulled, in (-180, 180]."""
    @property
    def residual_rms_mm(self) -> Optional[float]:
        """RMS residual of the dots, mm."""
    @property
    def inside_share(self) -> Optional[float]:
        """Fraction of the ellipse inside the area of dots."""
    @property
    def drift(self) -> dict[str, Any]:
        """Motion of the body between the pictures: right_mm, headwards_mm, length_mm, turn_deg,
        scale_percent; empty without a fit.
        """
    @property
    def dots(self) -> dict[str, numpy.typing.NDArray[Any]]:
        """A dict of arrays, one row per dot: site (N, 2) column and row, before_px, after_px (NaN:
        hidden), skin_mm, moved_mm without the body's own motion (N, 2), residual_mm (N,).
        """
    @property
    def contour_mm(self) -> numpy.typing.NDArray[numpy.float64]:
        """Traced 2 mm contour on the skin (N, 2), mm; empty if there is none."""
    @property
    def matched(self) -> int:
        """Number of dots found in both pictures."""
    @property
    def seconds(self) -> float:
        """Computation time, s."""
    def row(self, name: str, place_mm: tuple[float, float]) -> str:
        """Row of a key point table under `row_header`, for maps; empty without a fit. Raises ValueError."""
    def __repr__(self) -> str:
        ...

def dots(before: Union[str, os.PathLike[str], numpy.typing.NDArray[numpy.uint8]], after: Union[str, os.PathLike[str], numpy.typing.NDArray[numpy.uint8]], *, again: Optional[Union[str, os.PathLike[str], numpy.typing.NDArray[numpy.uint8]]] = None, spacing_mm: float = 30.0, drift_mm: Optional[float] = None, head: str = 'top', contact_px: Optional[tuple[float, float]] = None, partial: bool = False) -> Measurement:
    """Measures one press. before, after, again (a second picture before it, which tells how far the body moves
    by itself): files (JPEG, PNG, TIFF) or arrays (H, W, 3) of uint8. spacing_mm: of the stencil. drift_mm:
    how far the body may have moved, sd; None: 0.4 or what `again` shows. head: the pictures' edge that is
    towards it. contact_px: the marked contact. partial: the ellipse may leave the dots. Never raises for what
    the pictures show: see Measurement.accepted. Releases the GIL. Raises Error, ValueError.
    """
def row_header() -> str:
    """The columns of Measurement.row, with a line end."""
class MeanEllipse:
    """Mean of several presses. An unknown standard error is NaN."""

    @property
    def half_major_mm(self) -> Estimate:
        """Half the major axis."""
    @property
    def major_over_minor(self) -> Estimate:
        """Ratio of the axes."""
    @property
    def direction_deg(self) -> Estimate:
        """Direction of the major axis, from the right towards the head, in (-90, 90]; with an sd of 52 it is undetermined."""
    @property
    def hardly_determined(self) -> bool:
        """Whether the direction's standard error is above 10 degrees, or the presses disagree on it."""
    @property
    def resultant(self) -> float:
        """Agreement of the directions, from 0 (none) to 1 (all equal)."""
    @property
    def freedom(self) -> float:
        """Degrees of freedom of the errors; 0 if unknown."""
    @property
    def subjects(self) -> int:
        """Number of people."""
    @property
    def presses(self) -> int:
        """Number of presses."""
    def __repr__(self) -> str:
        ...

class DragMean:
    """Mean of the presses pulled in one direction."""

    @property
    def drag_deg(self) -> Optional[float]:
        """Direction of the pull, from the right towards the head; None if unknown."""
    @property
    def mean(self) -> MeanEllipse:
        """Mean of these presses."""
    def __repr__(self) -> str:
        ...

class PointMean:
    """Mean of all presses at a point."""

    @property
    def name(self) -> str:
        """Name of the point."""
    @property
    def place_mm(self) -> tuple[float, float]:
        """Place on the map, mm: right, headwards."""
    @property
    def drags(self) -> list[DragMean]:
        """Means by direction of the pull; at least one."""
    @property
    def mean(self) -> MeanEllipse:
        """Mean over the drags; the tissue's own if `along_drag` is known."""
    @property
    def along_drag(self) -> Optional[Estimate]:
        """Factor by which a drag stretches the ellipse along itself; None unless two drags 60 degrees or more
        apart were measured.
        """
    @property
    def half_major_4_mm(self) -> Optional[float]:
        """Half the major axis of the 4 mm ellipse; None if not measured."""
    @property
    def peak_mm(self) -> Optional[float]:
        """Motion under the contact, mm; None if not measured."""
    @property
    def stiffness_n_per_mm(self) -> Optional[float]:
        """Stiffness; None if not measured."""
    @property
    def mirrored_from(self) -> str:
        """Name of the point that this one mirrors; empty if measured."""
    @property
    def remark(self) -> str:
        """Reason why the direction may not be the tissue's own; empty for none."""
    def __repr__(self) -> str:
        ...

class Averages:
    """One ellipse per point, averaged over presses and people."""

    @property
    def points(self) -> list[PointMean]:
        """Points in the order of the tables, then the mirrored ones."""
    def key_points(self, by_drag: bool = False) -> str:
        """Table of key points for maps, as text; by_drag: one row per point and drag."""
    def __repr__(self) -> str:
        ...

def average(tables: list[Union[str, Union[str, os.PathLike[str]]]], *, drag: Optional[Union[float, str]] = None, mirrors: dict[str, str] = {}, averaging: str = 'tensorial') -> Averages:
    """Averages presses. tables: files (CSV), or texts of such tables; each of several is one person's if its
    rows do not say. drag: only presses pulled that way, degrees or a word ("up"). mirrors: points that were not
    measured as mirror images, {from: to}. averaging: "tensorial", or "plain" as the dissertation prints.
    Raises Error with file and line, ValueError.
    """
class StencilSheet:
    """A sheet of paper."""

    @property
    def name(self) -> str:
        """Row and column of a tile, e.g. "r1c2"; empty for a single sheet."""
    @property
    def svg(self) -> str:
        """The drawing, in mm; print it at 100 %."""
    def __repr__(self) -> str:
        ...

def stencil(*, spacing_mm: float = 30.0, columns: int = 11, rows: int = 13, hole_mm: float = 8.0, page: str = 'auto', scale_target: bool = False) -> list[StencilSheet]:
    """Stencil sheet for the dots, at true size. spacing_mm: 5 to 100; columns, rows: 2 to 60; hole_mm:
    less than half the spacing; page: "auto", "a4", "a3", "a2" or "tiled-a4"; scale_target: with a
    ruler of 100 mm. Raises Error for what is out of range or does not fit, ValueError.
    """
def synthesize(seed: int, *, megapixels: float = 2.0, drift_mm: float = 0.3, tail: Optional[str] = None, half_major_mm: Optional[float] = None, ratio: Optional[float] = None, direction_deg: Optional[float] = None, drag_deg: Optional[float] = None, peak_mm: Optional[float] = None) -> tuple[numpy.typing.NDArray[numpy.uint8], numpy.typing.NDArray[numpy.uint8], numpy.typing.NDArray[numpy.uint8], dict[str, Any]]:
    """Pictures before, again before and after a press, arrays (H, W, 3) of uint8, and the truth as a dict;
    palpate.measure.synthesize names them. Releases the GIL. Raises ValueError.
    """
