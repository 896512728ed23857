"""Drawing without a display; use palpate.view.

Made by tools/python-stubs from the docstrings; not edited by hand.
"""

import os
from typing import Any, Callable, Iterable, Iterator, Optional, Sequence, Union, overload

import numpy
import numpy.typing

import palpate._core


def draw(world: palpate._core.World, skin: Any, touches: Any, size: tuple[int, int], supersampling: int, options: dict[str, Any]) -> tuple[numpy.typing.NDArray[numpy.uint8], list[str]]:
    """A picture (H, W, 3) of uint8 and notes about it; palpate.view.render has the words."""
def save(file: Union[str, os.PathLike[str]], picture: Any) -> None:
    """Writes an array (H, W, 3) of uint8 as a PNG file. Raises ValueError, Error."""
def _close() -> None:
    """Ends the drawing thread; the next picture starts a new one."""
