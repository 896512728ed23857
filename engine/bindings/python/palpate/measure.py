"""From photographs of a dotted back to the key ellipse, and synthetic photographs with known truth.

    found = palpate.measure.dots("before.jpg", "after.jpg", again="before2.jpg")
    if found.accepted and found.ellipse is not None:
        print(found.ellipse)
    else:
        for finding in found.findings:
            print(finding["severity"], finding["text"])

Several presses and people become key points for the maps:

    means = palpate.measure.average(["me.csv", "you.csv"], mirrors={"P4": "P6"})
    pathlib.Path("keys.csv").write_text(means.key_points())

docs/howto/measure-a-person.md is the protocol and says what the numbers mean.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from palpate import _measure
from palpate._measure import (
    Averages,
    DragMean,
    Estimate,
    KeyEllipse,
    MeanEllipse,
    Measurement,
    PointMean,
    StencilSheet,
    average,
    dots,
    row_header,
    stencil,
)

__all__ = [
    "Averages",
    "DragMean",
    "Estimate",
    "KeyEllipse",
    "MeanEllipse",
    "Measurement",
    "PointMean",
    "StencilSheet",
    "Synthetic",
    "average",
    "dots",
    "row_header",
    "stencil",
    "synthesize",
]


class Synthetic(NamedTuple):
    """Three synthetic pictures (H, W, 3) of uint8 of a back, and the ground truth.

    truth: half_major_mm, half_minor_mm, major_over_minor, direction_deg (of the ellipse of 2 mm), drag_deg, peak_mm,
    contact_px, px_per_mm.
    """

    before: NDArray[np.uint8]
    again: NDArray[np.uint8]
    after: NDArray[np.uint8]
    truth: dict[str, Any]


def synthesize(
    seed: int,
    *,
    megapixels: float = 2.0,
    drift_mm: float = 0.3,
    tail: str | None = None,
    half_major_mm: float | None = None,
    ratio: float | None = None,
    direction_deg: float | None = None,
    drag_deg: float | None = None,
    peak_mm: float | None = None,
) -> Synthetic:
    """Paints a press; omitted values are drawn from the seed.

    tail: "compact" (the half Gaussian), "long", "half-space", "windowed". drift_mm: how far the body moves between the
    pictures, sd. The rest: of the ellipse through the places that move by 2 mm, the way of the pull, and the motion of
    the skin under the stick (0: nothing is pressed). Raises ValueError.
    """
    return Synthetic(
        *_measure.synthesize(
            seed,
            megapixels=megapixels,
            drift_mm=drift_mm,
            tail=tail,
            half_major_mm=half_major_mm,
            ratio=ratio,
            direction_deg=direction_deg,
            drag_deg=drag_deg,
            peak_mm=peak_mm,
        )
    )
