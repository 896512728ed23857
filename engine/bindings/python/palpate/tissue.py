"""Force laws and layered tissue as functions of arrays, and what is published about soft tissue.

Depths in mm under the skin, forces in N, stiffness in N/mm, Young's moduli in kPa.
"""

from __future__ import annotations

from typing import NamedTuple

from palpate._core import Law, LayeredTissue, default_modulus, profile, published_moduli

__all__ = ["Law", "LayeredTissue", "Modulus", "default_modulus", "moduli", "profile"]


class Modulus(NamedTuple):
    """Young's modulus at rest as published; low and high are equal for a single value."""

    tissue: str
    low_kpa: float
    high_kpa: float
    how: str
    source: str
    doubt: str
    is_default: bool


def moduli() -> list[Modulus]:
    """Published moduli of skin, fat and muscle, and the defaults of this project.

    Published stiffness of one tissue spreads over two or three powers of ten: the defaults represent nobody.
    """
    return [Modulus(*row) for row in published_moduli()]
