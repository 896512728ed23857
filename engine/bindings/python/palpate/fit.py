"""From measured curves to tissue: a force law, a shape of pressed skin, or any number of a scene.

    fits = palpate.fit.force(depth_mm, force_n)       # every form, the best of them first
    fits[0].law.force(depth_mm, fits[0].secant.value)

    found = palpate.fit.scene(world, toml_of, start, low, high, tips=tips, force=measured)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike, NDArray

from palpate._core import (
    FingerSettings,
    FittedNumber,
    ForceFit,
    ProfileFit,
    World,
    best_force_fit,
    fit_forces,
    fit_profiles,
    fit_shared_force,
    least_squares,
)

__all__ = ["FittedNumber", "ForceFit", "Fitted", "ProfileFit", "force", "numbers", "profile", "scene", "shared_force"]


def force(depth_mm: ArrayLike, force_n: ArrayLike, *, free_offset: bool = False) -> list[ForceFit]:
    """Every form of force law fitted to one curve (N,), the best first, the others by how well they predict unseen rows.

    Give the pressing part alone, with at least four depths below the skin. `free_offset` looks for the contact between
    0 and 0.6 mm. Raises ValueError, palpate.Error.
    """
    fits = fit_forces(depth_mm, force_n, free_offset=free_offset)
    best = best_force_fit(fits).form
    return sorted(fits, key=lambda fit: (fit.form != best, fit.unseen_rms))


def shared_force(
    curves: Sequence[tuple[ArrayLike, ArrayLike]], form: str = "power", *, free_offset: bool = False
) -> ForceFit:
    """One shape for several places, each with its own stiffness: pairs (depth_mm, force_n), arrays (N,).

    Raises ValueError, palpate.Error.
    """
    return fit_shared_force(list(curves), form, free_offset=free_offset)


def profile(
    depth_mm: float, r_mm: ArrayLike, down_mm: ArrayLike, outward_mm: ArrayLike | None = None
) -> list[ProfileFit]:
    """Every form of pressed skin fitted to places (N,) under one depth of the indenter, that which foretells unseen
    places best first.

    Raises ValueError, palpate.Error.
    """
    fits = fit_profiles(depth_mm, r_mm, down_mm, outward_mm)
    return sorted(fits, key=lambda fit: fit.unseen_rms)


@dataclass(frozen=True)
class Fitted:
    """Fitted numbers (K,) with their standard errors; `rms` is that of the residuals."""

    numbers: NDArray[Any]
    standard_errors: NDArray[Any]
    rms: float
    at_bound: list[bool]


def numbers(
    residuals: Callable[[NDArray[Any]], ArrayLike], start: ArrayLike, low: ArrayLike, high: ArrayLike
) -> Fitted:
    """Least squares within bounds: `residuals` takes the numbers (K,) and returns the residuals (N,).

    Deterministic; derivatives are differences. What `residuals` raises goes through. Raises ValueError.
    """
    count = 0

    def counted(values: NDArray[Any]) -> ArrayLike:
        nonlocal count
        import numpy as np

        missed = np.asarray(residuals(values), dtype=float).ravel()
        count = missed.size
        return missed

    found, errors, squares, at_bound = least_squares(counted, start, low, high)
    return Fitted(found, errors, float((squares / max(count, 1)) ** 0.5), at_bound)


def scene(
    world: World,
    toml_of: Callable[[NDArray[Any]], str],
    start: ArrayLike,
    low: ArrayLike,
    high: ArrayLike,
    *,
    tips: ArrayLike,
    force: ArrayLike,
    settings: FingerSettings | None = None,
) -> Fitted:
    """Numbers of a scene by which its body answers as it was measured.

    `toml_of` writes the scene (without a body) for some numbers; `world.rebuilt` makes it, one finger follows `tips`
    (T, 3), and the length of its force is compared with `force` (T,), N. Raises ValueError, palpate.Error.
    """
    import numpy as np

    path = np.asarray(tips, dtype=float)
    wanted = np.asarray(force, dtype=float)
    if path.ndim != 2 or wanted.shape != path.shape[:1]:
        raise ValueError(f"expected tips (T, 3) and force (T,), not {path.shape} and {wanted.shape}")

    def missed(values: NDArray[Any]) -> ArrayLike:
        felt = world.rebuilt(toml_of(values)).rollout(path[None], settings=settings, fields=("force",))
        rest: NDArray[Any] = np.linalg.norm(felt["force"][0], axis=1) - wanted
        return rest

    return numbers(missed, start, low, high)
