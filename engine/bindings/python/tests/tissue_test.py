"""Laws and layers as functions of arrays: against closed forms, against each other, against the command."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

import palpate
from palpate.tissue import LayeredTissue, Law


def test_the_laws_are_their_formulas():
    depth = np.linspace(-1.0, 12.0, 53)
    pressed = np.maximum(depth, 0.0)
    np.testing.assert_allclose(Law.linear().force(depth, 0.7), 0.7 * pressed, rtol=1e-14)
    np.testing.assert_allclose(Law.power(1.63).force(depth, 0.7), 0.7 * 8 * (pressed / 8) ** 1.63, rtol=1e-12)
    # dh/dd goes from 1 to 5 along a half Gaussian, all scaled so that h(8 mm) = 8 mm.
    stiffening = Law.stiffening(ratio=5.0, depth_mm=12.0)
    np.testing.assert_allclose(stiffening.force(8.0, 0.7), 0.7 * 8, rtol=1e-12)
    np.testing.assert_allclose(stiffening.tangent(12.0) / stiffening.tangent(0.0), 5.0, rtol=1e-9)


@pytest.mark.parametrize("law", [Law.power(2.1), Law.stiffening(), Law.layered(12.0), Law.table([2, 6, 12], [0.5, 3, 9])])
def test_tangent_is_the_slope_and_depth_the_inverse(law):
    depth = np.array([1.1, 3.3, 5.2, 7.3])
    step = 1e-6
    slope = (law.force(depth + step, 0.4, 40.0) - law.force(depth - step, 0.4, 40.0)) / (2 * step)
    np.testing.assert_allclose(law.tangent(depth, 0.4, 40.0), slope, rtol=1e-5)
    np.testing.assert_allclose(law.depth(law.force(depth, 0.4, 40.0), 0.4, 40.0), depth, rtol=1e-9)


def test_arguments_broadcast_and_a_number_is_an_array_without_axes():
    force = Law.power().force(np.linspace(1, 9, 5)[:, None], [0.3, 0.5, 0.9])
    assert force.shape == (5, 3)
    assert Law.power().force(8.0, 0.5).shape == ()
    assert float(Law.power().force(8.0, 0.5)) == pytest.approx(4.0)


def test_the_world_says_by_which_law_it_is_felt(torso):
    stiff = torso.rebuilt('[body]\nkind = "torso"\n[tissue]\nforce_law = "power"\nexponent = 2.2\n')
    law = Law.of(stiff)
    assert (law.kind, law.exponent) == ("power", 2.2)
    touch = palpate.Finger(stiff)
    for tip in stiff.tips("T6 right 40 mm", np.linspace(-1, 5, 600)):
        felt = touch.step(tip)
    expected = law.force(felt.depth_mm, stiff.stiffness_at(felt.proxy))
    assert np.linalg.norm(felt.force) == pytest.approx(float(expected), rel=1e-9)


def test_layers_agree_with_their_own_law_and_thin_tissue_is_stiffer():
    layers = LayeredTissue(fat_mm=8.0)
    depth = np.array([2.0, 5.0, 8.0])
    # The map's number is the secant at 8 mm: with it the law gives the library's own force back.
    for thickness in (20.0, 45.0):
        by_law = layers.law().force(depth, layers.secant(thickness, 8.0), thickness)
        np.testing.assert_allclose(by_law, layers.force(thickness, depth), rtol=0.02)
    secants = layers.secant(np.linspace(layers.thinnest_mm, layers.thickest_mm, 9), 4.0)
    assert np.all(np.diff(secants) < 0)


def test_pressed_skin_follows_on_the_axis_and_not_far_away():
    moved = LayeredTissue().pressed(40.0, 6.0, np.array([0.0, 15.0, 500.0]))
    assert moved[0] == pytest.approx([6.0, 0.0], abs=0.1)
    assert 0.1 < moved[1, 0] < 6.0
    assert moved[2] == pytest.approx([0.0, 0.0])


def test_the_half_gaussian_is_1_under_the_finger_and_0_on_the_rim():
    q = np.array([0.0, 0.3, 1.0, 2.0])
    rim = np.exp(-1.96 * np.pi)
    expected = (np.exp(-1.96 * np.pi * np.minimum(q, 1) ** 2) - rim) / (1 - rim)
    np.testing.assert_allclose(palpate.tissue.profile(q), expected, atol=1e-12)


def test_published_moduli_are_those_of_the_command(command):
    answer = subprocess.run([command, "tissue", "moduli", "--json"], capture_output=True, text=True, check=True).stdout
    rows = json.loads(answer)
    rows = rows["moduli"] if isinstance(rows, dict) else rows
    ours = palpate.tissue.moduli()
    assert len(ours) == len(rows) > 10
    assert {modulus.tissue for modulus in ours} == {"skin", "fat", "muscle"}
    assert palpate.tissue.default_modulus("fat") == next(m.low_kpa for m in ours if m.tissue == "fat" and m.is_default)
    with pytest.raises(palpate.Error, match="muscel"):
        palpate.tissue.default_modulus("muscel")


def test_what_makes_no_sense_is_refused():
    with pytest.raises(palpate.Error):
        Law.power(exponent=9.0)
    with pytest.raises(palpate.Error):
        Law.table([2, 1], [1, 2])
    with pytest.raises(ValueError):
        Law.table([1, 2, 3], [1, 2])
    with pytest.raises(TypeError, match="depth_mm"):
        Law.linear().force("deep")


def test_a_table_of_the_command_is_read(command, tmp_path):
    run = [command, "tissue", "solve", "--layer", "skin:2:150", "--layer", "fat:8:10", "--depths", "2,4", "-o", "own.json"]
    subprocess.run(run, cwd=tmp_path, check=True, capture_output=True, timeout=300)
    table = json.loads((tmp_path / "own.json").read_text())
    layers = LayeredTissue.from_table(tmp_path / "own.json")
    assert layers.thinnest_mm == layers.thickest_mm == 10.0
    for shape in table["shapes"]:
        assert float(layers.force(10.0, shape["depth_mm"])) == pytest.approx(shape["force_n"], rel=1e-6)
    with pytest.raises(palpate.Error, match="nowhere"):
        LayeredTissue.from_table(tmp_path / "nowhere.json")
