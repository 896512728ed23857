"""Every example runs as it stands, in a folder of its own, and makes its picture."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest
from conftest import SOURCE

EXAMPLES = sorted((SOURCE / "examples" / "python").glob("*.py"))


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    """What an example printed, and where its picture is; each is run once."""
    answers: dict[str, tuple[str, bytes]] = {}

    def run(name: str) -> tuple[str, bytes]:
        if name not in answers:
            folder = tmp_path_factory.mktemp(name)
            environment = {**os.environ, "MPLBACKEND": "Agg"}
            script = SOURCE / "examples" / "python" / f"{name}.py"
            done = subprocess.run([sys.executable, script], cwd=folder, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            answers[name] = done.stdout, (folder / f"{name}.png").read_bytes()
        return answers[name]

    return run


def test_all_six_are_there():
    assert len(EXAMPLES) == 6


@pytest.mark.parametrize("name", [example.stem for example in EXAMPLES])
def test_it_makes_its_picture_and_is_short(ran, name):
    _, picture = ran(name)
    assert picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 5000
    text = (SOURCE / "examples" / "python" / f"{name}.py").read_text()
    assert text.count("# %%") >= 2
    if name != "train_a_search_policy":
        assert len(re.findall(r"^[^#\n].*", text, re.MULTILINE)) < 45


def test_a_thousand_palpations_recover_the_map(ran):
    words, _ = ran("map_by_thousand_palpations")
    assert float(re.search(r"r = ([0-9.]+)", words).group(1)) > 0.999


def test_the_fitted_tissue_is_the_one_that_made_the_curve(ran):
    words, _ = ran("fit_a_tissue")
    secant, exponent = map(float, re.search(r"k = ([0-9.]+) N/mm, exponent = ([0-9.]+)", words).groups())
    assert secant == pytest.approx(0.8, rel=0.03)
    assert exponent == pytest.approx(1.63, abs=0.05)
    assert float(re.search(r"differ by ([0-9.]+) N", words).group(1)) < 0.05  # and a finger feels it


def test_the_trained_policy_beats_chance(ran):
    words, _ = ran("train_a_search_policy")
    chance, trained = map(float, re.search(r"chance ([0-9.]+) %.*trained ([0-9.]+) %", words).groups())
    assert trained > chance + 15
