"""Fits find the numbers that made the curves."""

from __future__ import annotations

import numpy as np
import pytest

import palpate


def pressed(exponent: float, secant: float, noise: float, rows: int = 40, seed: int = 1):
    depth = np.linspace(0.25, 10.0, rows)
    force = secant * 8.0 * (depth / 8.0) ** exponent
    return depth, force * (1.0 + noise * np.random.default_rng(seed).standard_normal(rows))


@pytest.mark.parametrize("exponent", [1.0, 1.63, 2.2])
def test_a_power_law_is_found_with_its_standard_errors(exponent):
    fits = palpate.fit.force(*pressed(exponent, 0.4, 0.05))
    assert sorted(fit.form for fit in fits) == ["cubic", "linear", "measured", "power", "stiffening"]
    power = next(fit for fit in fits if fit.form == "power")
    number = power.numbers["exponent"]
    assert number.value == pytest.approx(exponent, abs=0.05)
    assert power.secant.value == pytest.approx(0.4, rel=0.05)
    assert number.at_end or 0.0 < number.standard_error < 0.05


def test_without_noise_the_form_that_made_the_rows_foretells_them_and_its_law_gives_them_back():
    depth, force = pressed(1.63, 0.8, 0.0)
    best = palpate.fit.force(depth, force)[0]
    assert best.form == "power"
    assert best.unseen_rms < 1e-6
    np.testing.assert_allclose(best.law.force(depth, best.secant.value), force, rtol=1e-5)
    np.testing.assert_allclose(best.force(depth), force, rtol=1e-5)


def test_places_share_a_shape_and_keep_their_stiffness():
    shared = palpate.fit.shared_force([pressed(1.5, k, 0.02, seed=i) for i, k in enumerate((0.2, 0.5, 1.1))])
    assert shared.numbers["exponent"].value == pytest.approx(1.5, abs=0.03)
    assert shared.secant.value == pytest.approx(0.5, rel=0.05)


def test_the_shape_of_pressed_skin_is_found():
    radius = np.linspace(0.0, 60.0, 61)
    down = 6.0 * (1.0 + (radius / 14.0) ** 2) ** -1.2
    fits = {fit.form: fit for fit in palpate.fit.profile(6.0, radius, down)}
    tail = fits["power_tail"]
    assert tail.numbers["width_mm"].value == pytest.approx(14.0, rel=1e-3)
    assert tail.numbers["exponent"].value == pytest.approx(1.2, rel=1e-3)
    np.testing.assert_allclose(tail.surface_mm * tail.down(radius), down, atol=0.01)
    assert tail.rms < 0.1 * fits["half_gaussian"].rms


def test_numbers_of_a_scene_are_found_by_feeling_it(torso):
    def scene(values):
        exponent, secant = values
        return (
            '[body]\nkind = "torso"\n[tissue]\nforce_law = "power"\n'
            f'exponent = {exponent}\n[stiffness]\nsource = "constant"\nconstant_n_per_mm = {secant}\n'
        )

    tips = torso.tips("T6 right 40 mm", np.linspace(-1.0, 9.0, 200))
    truth = torso.rebuilt(scene([1.63, 0.8])).rollout(tips[None], fields=("force",))["force"][0]
    noise = 1.0 + 0.03 * np.random.default_rng(4).standard_normal(len(tips))
    measured = np.linalg.norm(truth, axis=1) * noise
    found = palpate.fit.scene(torso, scene, [1.2, 0.4], [1.0, 0.05], [3.0, 5.0], tips=tips, force=measured)
    assert found.numbers == pytest.approx([1.63, 0.8], rel=0.02)
    assert np.all(np.abs(found.numbers - [1.63, 0.8]) < 5 * found.standard_errors)
    assert not any(found.at_bound)


def test_least_squares_stay_within_their_bounds_and_let_errors_through():
    found = palpate.fit.numbers(lambda n: [n[0] - 3.0, 2 * (n[1] + 1.0)], [0.0, 0.0], [-5.0, -0.5], [5.0, 5.0])
    assert found.numbers == pytest.approx([3.0, -0.5], abs=1e-6)
    assert found.at_bound == [False, True]

    def broken(_):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        palpate.fit.numbers(broken, [0.0], [-1.0], [1.0])


def test_too_little_is_refused_in_words():
    with pytest.raises(palpate.Error):
        palpate.fit.force([1.0, 2.0], [0.1, 0.2])
    with pytest.raises(ValueError, match="rows"):
        palpate.fit.force([1.0, 2.0, 3.0], [0.1, 0.2])
    with pytest.raises(ValueError, match=r"force_n\[1\]"):
        palpate.fit.force([1.0, 2.0, 3.0, 4.0], [0.1, float("nan"), 0.2, 0.3])
    with pytest.raises(ValueError, match="start"):
        palpate.fit.numbers(lambda n: n, [9.0], [0.0], [1.0])
