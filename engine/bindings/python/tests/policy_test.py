"""The example that trains a policy, which takes a minute: it makes its picture, and what it has learnt beats chance."""

from __future__ import annotations

import re

from conftest import expect_picture


def test_it_makes_its_picture(run_example):
    expect_picture(run_example, "train_a_search_policy")


def test_the_trained_policy_beats_chance(run_example):
    words, _ = run_example("train_a_search_policy")
    chance, trained = map(float, re.search(r"chance ([0-9.]+) %.*trained ([0-9.]+) %", words).groups())
    assert trained > chance + 15
