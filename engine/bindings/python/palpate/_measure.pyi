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
        """The number."""
    @property
    def sd(self) -> float:
        """Its standard deviation."""
    def __float__(self) -> float:
        """The number."""
    def __repr__(self) -> str:
        ...

class KeyEllipse:
    """The ellipse through the places that move by level_mm."""

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
        """Of the major axis, from the right towards the head, in (-90, 90]."""
    def __repr__(self) -> str:
        ...

class Measurement:
    """What two pictures say, and whether to believe it. What was not fitted is None."""

    @property
    def accepted(self) -> bool:
        """Nothing refuses it."""
    @property
    def findings(self) -> list[dict[str, Any]]:
        """What speaks against it, a dict each: severity ("refusal", "warning"), code (stable),
        text (what was seen and what to do).
        """
    @property
    def ellipse(self) -> Optional[KeyEllipse]:
        """The key ellipse, of 2 mm; None without a fit."""
    @property
    def ellipse_4_mm(self) -> Optional[KeyEllipse]:
        """That of 4 mm."""
    @property
    def peak_mm(self) -> Optional[Optional[Estimate]]:
        """How far the skin moved under the contact."""
    @property
    def drag_deg(self) -> Optional[Estimate]:
        """The way it was pulled, in (-180, 180]."""
    @property
    def residual_rms_mm(self) -> Optional[float]:
        """Of the dots about the fit."""
    @property
    def inside_share(self) -> Optional[float]:
        """Of the ellipse that lies within the dots."""
    @property
    def drift(self) -> dict[str, Any]:
        """How the body moved between the pictures: right_mm, headwards_mm, length_mm, turn_deg,
        scale_percent; empty without a fit.
        """
    @property
    def dots(self) -> dict[str, numpy.typing.NDArray[Any]]:
        """A dict of arrays, a row a dot: site (N, 2) column and row, before_px, after_px (NaN:
        hidden), skin_mm, moved_mm without the body's own motion (N, 2), residual_mm (N,).
        """
    @property
    def contour_mm(self) -> numpy.typing.NDArray[numpy.float64]:
        """The traced contour of 2 mm on the skin (N, 2), mm; empty where there is none."""
    @property
    def matched(self) -> int:
        """Dots that both pictures show."""
    @property
    def seconds(self) -> float:
        """That it took."""
    def row(self, name: str, place_mm: tuple[float, float]) -> str:
        """A line of a table of key points under `row_header`, for maps; empty without a fit. Raises ValueError."""
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
    """The columns of Measurement.row, with the line's end."""
class MeanEllipse:
    """The mean of some presses. A standard error that nothing is known of is NaN."""

    @property
    def half_major_mm(self) -> Estimate:
        """Half the major axis."""
    @property
    def major_over_minor(self) -> Estimate:
        """Ratio of the axes."""
    @property
    def direction_deg(self) -> Estimate:
        """Of the major axis, from the right towards the head, in (-90, 90]; an sd of 52 says nothing."""
    @property
    def hardly_determined(self) -> bool:
        """The direction's standard error is above 10 degrees, or the presses do not agree on it."""
    @property
    def resultant(self) -> float:
        """How much the directions agree: 1 all alike, 0 not at all."""
    @property
    def freedom(self) -> float:
        """Degrees of freedom behind the errors; 0: not known."""
    @property
    def subjects(self) -> int:
        """People."""
    @property
    def presses(self) -> int:
        """Presses."""
    def __repr__(self) -> str:
        ...

class DragMean:
    """The presses of one way of pulling."""

    @property
    def drag_deg(self) -> Optional[float]:
        """That way, from the right towards the head; None: not said."""
    @property
    def mean(self) -> MeanEllipse:
        """Their mean."""
    def __repr__(self) -> str:
        ...

class PointMean:
    """What all presses of a point say."""

    @property
    def name(self) -> str:
        """Of the point."""
    @property
    def place_mm(self) -> tuple[float, float]:
        """On the map: right, headwards."""
    @property
    def drags(self) -> list[DragMean]:
        """By the way the skin was pulled; at least one."""
    @property
    def mean(self) -> MeanEllipse:
        """Over the drags; the tissue's own where `along_drag` is known."""
    @property
    def along_drag(self) -> Optional[Estimate]:
        """By how much a drag stretches the ellipse along itself; None unless two drags 60 degrees or more
        apart were measured.
        """
    @property
    def half_major_4_mm(self) -> Optional[float]:
        """Of the ellipse of 4 mm; None: not measured."""
    @property
    def peak_mm(self) -> Optional[float]:
        """Under the contact; None: not measured."""
    @property
    def stiffness_n_per_mm(self) -> Optional[float]:
        """None: not measured."""
    @property
    def mirrored_from(self) -> str:
        """The point that this one mirrors; empty: measured."""
    @property
    def remark(self) -> str:
        """What stands between the pulled direction and a word about the tissue; empty: nothing."""
    def __repr__(self) -> str:
        ...

class Averages:
    """An ellipse a point, of several presses and people."""

    @property
    def points(self) -> list[PointMean]:
        """In the order of the tables, then the mirrored ones."""
    def key_points(self, by_drag: bool = False) -> str:
        """The table that maps are made of, as text; by_drag: a row a point and drag."""
    def __repr__(self) -> str:
        ...

def average(tables: list[Union[str, Union[str, os.PathLike[str]]]], *, drag: Optional[Union[float, str]] = None, mirrors: dict[str, str] = {}, averaging: str = 'tensorial') -> Averages:
    """Means of presses. tables: files (CSV), or texts of such a table; of several each is one person's where its
    rows do not say. drag: only presses pulled that way, degrees or a word ("up"). mirrors: points that nobody
    measured as mirror images, {from: to}. averaging: "tensorial", or "plain" as the dissertation prints.
    Raises Error with file and line, ValueError.
    """
class StencilSheet:
    """A sheet of paper."""

    @property
    def name(self) -> str:
        """Of a tile, "r1c2": row and column; empty: the only one."""
    @property
    def svg(self) -> str:
        """The drawing, in mm, to be printed at 100 %."""
    def __repr__(self) -> str:
        ...

def stencil(*, spacing_mm: float = 30.0, columns: int = 11, rows: int = 13, hole_mm: float = 8.0, page: str = 'auto', scale_target: bool = False) -> list[StencilSheet]:
    """The sheet to punch for the dots, at true size. spacing_mm: 5 to 100; columns, rows: 2 to 60; hole_mm:
    less than half the spacing; page: "auto", "a4", "a3", "a2" or "tiled-a4"; scale_target: with a
    ruler of 100 mm. Raises Error for what is out of range or does not fit, ValueError.
    """
def synthesize(seed: int, *, megapixels: float = 2.0, drift_mm: float = 0.3, tail: Optional[str] = None, half_major_mm: Optional[float] = None, ratio: Optional[float] = None, direction_deg: Optional[float] = None, drag_deg: Optional[float] = None, peak_mm: Optional[float] = None) -> tuple[numpy.typing.NDArray[numpy.uint8], numpy.typing.NDArray[numpy.uint8], numpy.typing.NDArray[numpy.uint8], dict[str, Any]]:
    """Pictures before, before again and after a press, arrays (H, W, 3) of uint8, and the truth as a dict;
    palpate.measure.synthesize names them. Releases the GIL. Raises ValueError.
    """
