"""Every example runs as it stands, in a folder of its own, and makes its picture; the longest is in policy_test.py."""

from __future__ import annotations

import re

import pytest
from conftest import EXAMPLES, expect_picture

SHORT = sorted(set(EXAMPLES) - {"train_a_search_policy"})


def test_all_six_are_there():
    assert len(EXAMPLES) == 6


@pytest.mark.parametrize("name", SHORT)
def test_it_makes_its_picture_and_is_short(run_example, name):
    text = expect_picture(run_example, name)
    assert len(re.findall(r"^[^#\n].*", text, re.MULTILINE)) < 45


def test_a_thousand_palpations_recover_the_map(run_example):
    words, _ = run_example("map_by_thousand_palpations")
    assert float(re.search(r"r = ([0-9.]+)", words).group(1)) > 0.999


def test_the_fitted_tissue_is_the_one_that_made_the_curve(run_example):
    words, _ = run_example("fit_a_tissue")
    secant, exponent = map(float, re.search(r"k = ([0-9.]+) N/mm, exponent = ([0-9.]+)", words).groups())
    assert secant == pytest.approx(0.8, rel=0.03)
    assert exponent == pytest.approx(1.63, abs=0.05)
    assert float(re.search(r"differ by ([0-9.]+) N", words).group(1)) < 0.05  # and a finger feels it
