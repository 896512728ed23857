"""Pictures of a body without a window or a display, as arrays.

    skin = palpate.Skin(world, strain=True)
    skin.apply([touch])
    picture = palpate.view.render(world, skin, [touch], colours="strain", camera=palpate.view.Camera(look_at="T6", zoom=4))
    palpate.view.save("t6.png", picture)

The first picture makes an OpenGL context (Mesa draws in software where there is no graphics card) on a thread of its own;
it stays for the next ones, and holds the newest world. Any thread may ask; pictures are drawn one after the other. A
process that was forked from one that has drawn cannot draw (RuntimeError).
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palpate import _view
from palpate._core import Skin, Touch, World

if TYPE_CHECKING:
    from palpate.notebook import Widget

__all__ = ["Camera", "render", "save", "widget"]


@dataclass(frozen=True)
class Camera:
    """Position of the camera; values of None are taken from the scene.

    side: "back", "left", "right", "above", "front", "table" (as one stands beside a table). yaw_deg, pitch_deg: turned
    from there; positive sees more of the patient's right, and looks from above. zoom: 1 shows the whole body. look_at:
    the place in the middle, words ("T6 right 30 mm") or three numbers in mm. distance_mm: of the eye from there; 0: so
    far that the whole body is seen.
    """

    side: str | None = None
    yaw_deg: float | None = None
    pitch_deg: float | None = None
    zoom: float | None = None
    look_at: str | ArrayLike | None = None
    distance_mm: float | None = None


def render(
    world: World,
    skin: Skin | None = None,
    touches: Touch | Sequence[Touch] = (),
    *,
    size: tuple[int, int] = (640, 480),
    camera: Camera = Camera(),
    colours: str | None = None,
    show: str | Sequence[str] | None = None,
    opacity: float | None = None,
    bones: bool = False,
    finger: str | None = None,
    radius_mm: float | None = None,
    shading: str | None = None,
    skin_tone: float | None = None,
    dent_contrast: float | None = None,
    lens: bool | None = None,
    stiffness_range: ArrayLike | None = None,
    scalar: str | None = None,
    stereo: str | None = None,
    white_background: bool | None = None,
    labels: bool = True,
    title: str = "",
    supersampling: int = 2,
) -> NDArray[np.uint8]:
    """A picture (H, W, 3) of uint8, rows from the top.

    skin: as it is now (copied before the drawing begins); None: as `touches` leave it, at rest without any.
    touches: the fingers that are drawn; radius_mm: theirs, None: as the scene has it (a point is drawn as a fingertip).
    size: width and height, pixels. supersampling: each pixel is the mean of this many squared, 1 to 4.
    colours: "plain", "strain" (blue: pressed together), "stiffness", "ellipses", "scalar" (a number of the body's file,
    named by `scalar`). show: overlays, any of wireframe, triangles, leaves, planes, box, ellipses, rings, arrows,
    contact, normals, section, names. opacity: of the skin, 0 to 1; bones=True is 0.35 where it is not given.
    finger: "finger" (what "auto" is here), "hand", "ball", "none". stereo: "mono", "anaglyph-dubois", "sbs-half" ... (docs/explanation/rendering.md).
    lens: a close view from beside the finger in a corner.
    labels: legends, a scale, numbers beside the fingers; title: upper left.

    What is None is as the scene has it. What cannot be shown is a warning (UserWarning). Releases the GIL; the skin
    may be changed at once afterwards. Raises palpate.Error where nothing can be drawn, ValueError and TypeError for
    options, RuntimeError in a forked process.
    """
    options: dict[str, Any] = {
        "side": camera.side,
        "yaw_deg": camera.yaw_deg,
        "pitch_deg": camera.pitch_deg,
        "zoom": camera.zoom,
        "look_at": camera.look_at,
        "distance_mm": camera.distance_mm,
        "colours": colours,
        "show": show,
        "opacity": 0.35 if bones and opacity is None else opacity,
        "finger": finger,
        "radius_mm": radius_mm,
        "shading": shading,
        "skin_tone": skin_tone,
        "dent_contrast": dent_contrast,
        "lens": lens,
        "stiffness_range": stiffness_range,
        "scalar": scalar,
        "stereo": stereo,
        "white_background": white_background,
        "labels": labels,
        "title": title,
    }
    picture, notes = _view.draw(world, skin, touches, size, supersampling, options)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return picture


def save(file: str | os.PathLike[str], picture: NDArray[np.uint8]) -> None:
    """Writes a picture (H, W, 3) of uint8 as a PNG file. Raises ValueError, palpate.Error."""
    _view.save(file, picture)


def widget(*, height: int = 640, site: str | os.PathLike[str] | None = None) -> Widget:
    """The page of `tools/build-web` for a cell of a notebook: press there, and get the contact data here.

    height: of the cell, pixels. site: the page's folder; None: $PALPATE_SITE, the wheel's, the installed one, or that
    of a build.
    See palpate.notebook.Widget. Raises FileNotFoundError where no page is built.
    """
    from palpate.notebook import Widget

    return Widget(height=height, site=site)
