#!/usr/bin/python3
"""Computes posteriors of thresholds from answers; writes what palpate's must equal to 1e-9.

    tools/check_posterior.py -o tests/data/training/posterior.json

Shares nothing with the product but the model of docs/explanation/training-methods.md: the grid, the prior, the psychometric
function, an ideal observer for places that were left out. Products of probabilities are sums of logarithms here, the observer is
integrated by Gauss and Hermite and found by bisection, and the information of a level is taken from its definition.
instruments/teach/tests/training/posterior_test.cpp reads the file. The answers are drawn here, from numpy's generator with a fixed seed.

Needs Python 3 and numpy; some seconds.
"""
import argparse
import json
import math

import numpy as np

LAPSES = np.array([0.0, 0.02, 0.05, 0.10])
LAPSE_WEIGHTS = np.array([0.25, 0.45, 0.22, 0.08])
NODES, NODE_WEIGHTS = np.polynomial.hermite_e.hermegauss(120)
NORMAL_BELOW = np.vectorize(lambda z: 0.5 * math.erfc(-z / math.sqrt(2)))


def share_felt(d_prime, choices):
    right = np.sum(NODE_WEIGHTS * NORMAL_BELOW(NODES + d_prime) ** (choices - 1)) / math.sqrt(2 * math.pi)
    return (right - 1 / choices) / (1 - 1 / choices)


def d_prime_at(share, choices):
    low, high = 0.0, 12.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if share_felt(middle, choices) < share else (low, middle)
    return 0.5 * (low + high)


def ideal(choices, kept={}):
    """d' at one half, and the slope between a quarter and three quarters."""
    if choices not in kept:
        rise = math.log(math.log(4) / math.log(4 / 3))
        kept[choices] = (d_prime_at(0.5, choices),
                         rise / math.log(d_prime_at(0.75, choices) / d_prime_at(0.25, choices)))
    return kept[choices]


class Grid:
    def __init__(self, choices):
        self.choices = choices
        standard_t = np.linspace(-3, 3, 61)
        standard_s = np.linspace(-1.5, 1.5, 7)
        self.ln_t = math.log(0.22) + 0.8 * standard_t
        self.slopes = np.exp(math.log(ideal(choices)[1]) + 0.45 * standard_s)
        self.ln_weights = (-0.5 * standard_t[:, None, None] ** 2 - 0.5 * standard_s[None, :, None] ** 2
                           + np.log(LAPSE_WEIGHTS)[None, None, :])

    def right(self, change, choices):
        factor = ideal(choices)[0] / ideal(self.choices)[0]
        steeper = ideal(choices)[1] / ideal(self.choices)[1]
        ratio = change / (np.exp(self.ln_t) * factor)
        felt = -np.expm1(-math.log(2) * ratio[:, None] ** (self.slopes[None, :] * steeper))
        guess = 1 / choices
        return guess + (1 - guess - LAPSES)[None, None, :] * felt[:, :, None]

    def add(self, answer):
        right = self.right(answer["change"], answer["choices"])
        with np.errstate(divide="ignore"):  # a lapse rate of zero can be ruled out for good
            self.ln_weights = self.ln_weights + np.log(right if answer["correct"] else 1 - right)

    def weights(self):
        weights = np.exp(self.ln_weights - self.ln_weights.max())
        return weights / weights.sum()

    def diffuse(self, sd):
        away = np.exp(-0.5 * ((self.ln_t[:, None] - self.ln_t[None, :]) / sd) ** 2)
        away /= away.sum(axis=0)[None, :]
        with np.errstate(divide="ignore"):
            self.ln_weights = np.log(np.einsum("ij,jsl->isl", away, self.weights()))

    def information(self, level):
        def entropy(p):
            return -p * np.log(p) - (1 - p) * np.log1p(-p)
        weights = self.weights()
        of_t = weights.sum(axis=(1, 2))
        keep = of_t > 1e-15
        right = (weights * self.right(level, self.choices)).sum(axis=(1, 2))
        return entropy(right.sum()) - np.sum(of_t[keep] * entropy(right[keep] / of_t[keep]))


def summary_of(grid, mark):
    of_t = grid.weights().sum(axis=(1, 2))
    cell = grid.ln_t[1] - grid.ln_t[0]
    borders = np.append(grid.ln_t - 0.5 * cell, grid.ln_t[-1] + 0.5 * cell)
    below = np.append(0.0, np.cumsum(of_t))
    # Where nothing lies the cumulative curve is flat: interpolate over rising places only.
    rising = np.append(True, np.diff(below) > 0)
    at = [float(np.exp(np.interp(share, below[rising], borders[rising]))) for share in (0.025, 0.5, 0.975)]
    mean = float(np.sum(of_t * grid.ln_t))
    return {"low": at[0], "median": at[1], "high": at[2], "mean_ln": mean,
            "sd_ln": float(math.sqrt(np.sum(of_t * (grid.ln_t - mean) ** 2))),
            "below_mark": float(np.interp(math.log(mark), borders, below))}


def drawn_answers(random, count, choices, least_choices, threshold):
    answers = []
    for _ in range(count):
        change = float(np.exp(random.uniform(math.log(0.04), math.log(0.8))))
        among = int(random.integers(least_choices, choices + 1))
        felt = 1 - 2 ** -(change / threshold) ** 1.5
        right = bool(random.uniform() < 1 / among + (1 - 1 / among) * felt * 0.97)
        answers.append({"change": change, "correct": right, "choices": among})
    return answers


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("-o", "--out", required=True)
    out = options.parse_args().out
    random = np.random.default_rng(20261122)
    sequences = [
        ("forty of twelve", 12, drawn_answers(random, 40, 12, 12, 0.18), 0.0),
        ("some places left out", 12, drawn_answers(random, 60, 12, 2, 0.3), 0.0),
        ("two intervals", 2, drawn_answers(random, 200, 2, 2, 0.1), 0.0),
        ("eight places", 8, drawn_answers(random, 30, 8, 4, 0.1), 0.0),
        ("all wrong", 12, [dict(a, correct=False) for a in drawn_answers(random, 30, 12, 12, 0.2)], 0.0),
        ("all right", 12, [dict(a, correct=True) for a in drawn_answers(random, 30, 12, 12, 0.2)], 0.0),
        ("then another day", 12, drawn_answers(random, 40, 12, 10, 0.14), 0.2),
        ("five hundred", 12, drawn_answers(random, 500, 12, 12, 0.25), 0.0),
    ]
    kept = []
    for name, choices, answers, diffusion in sequences:
        grid = Grid(choices)
        for answer in answers:
            grid.add(answer)
        if diffusion > 0:
            grid.diffuse(diffusion)
        levels = [0.04, 0.1, 0.2, 0.4, 0.8]
        kept.append({"name": name, "choices": choices, "answers": answers, "diffusion": diffusion, "mark": 0.2,
                     "summary": summary_of(grid, 0.2),
                     "threshold_weights": grid.weights().sum(axis=(1, 2)).tolist(),
                     "every_37th_weight": grid.weights().ravel()[::37].tolist(),
                     "levels": levels, "information": [float(grid.information(level)) for level in levels]})
    ideals = [{"choices": choices, "d_prime": ideal(choices)[0], "slope": ideal(choices)[1]}
              for choices in (2, 3, 6, 8, 12, 20, 40)]
    with open(out, "w", encoding="utf-8") as file:
        json.dump({"made_by": "tools/check_posterior.py", "ideal_observers": ideals, "sequences": kept}, file)
        file.write("\n")


if __name__ == "__main__":
    main()
