"""The two-level model of a class: the normal distribution that thresholds, or their changes, are drawn from."""
import math

from .ideal_observer import below
from .posterior import LN_T, T_POINTS


def cell_shares(mean, sd, grid):
    cell = grid[1] - grid[0]
    edges = [below((g - 0.5 * cell - mean) / sd) for g in grid] + [below((grid[-1] + 0.5 * cell - mean) / sd)]
    return [b - a for a, b in zip(edges, edges[1:])]


def fit_normal(grid, people):
    n = len(people)
    mean, sd, information = sum(grid[p.index(max(p))] for p in people) / n, 0.3, 0.0
    for _ in range(400):
        of_group, each = cell_shares(mean, sd, grid), []
        for values in people:
            weights = [s * v for s, v in zip(of_group, values)]
            total = sum(weights)
            first = sum(w * g for w, g in zip(weights, grid)) / total
            each.append((first, max(0.0, sum(w * g * g for w, g in zip(weights, grid)) / total - first * first)))
        new_mean = sum(m for m, _ in each) / n
        missing = sum(v for _, v in each)
        variance = missing / n + sum((m - new_mean) ** 2 for m, _ in each) / n
        information = max(n / sd ** 2 - missing / sd ** 4, 1e-3 * n / sd ** 2)
        new_sd = max(math.sqrt(variance), 0.03)
        moved = abs(new_mean - mean) + abs(new_sd - sd)
        mean, sd = new_mean, new_sd
        if moved < 1e-7:
            break
    return mean, sd, math.sqrt(n / (n - 1) / information)


def student95(n):
    z = 1.959963985
    return (z + (z ** 3 + z) / (4 * n) + (5 * z ** 5 + 16 * z ** 3 + 3 * z) / (96 * n ** 2)
            + (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / (384 * n ** 3)
            + (79 * z ** 9 + 776 * z ** 7 + 1482 * z ** 5 - 1920 * z ** 3 - 945 * z) / (92160 * n ** 4))


def group(people):
    if len(people) < 2:
        return None
    mean_ln, sd_ln, error = fit_normal(LN_T, people)
    mean = math.exp(mean_ln + 0.5 * sd_ln ** 2)
    reach = student95(len(people) - 1) * math.sqrt(error ** 2 * (1 + 0.5 * sd_ln ** 2))
    return {"people": len(people), "mean": mean, "low": mean * math.exp(-reach), "high": mean * math.exp(reach),
            "sd": mean * math.sqrt(math.expm1(sd_ln ** 2)), "mean_ln": mean_ln, "error_of_mean_ln": error,
            "sd_ln": sd_ln}


def difference(before, now):
    found = []
    for lag in range(2 * T_POINTS - 1):
        found.append(sum(before[i] * now[i + lag - T_POINTS + 1] for i in range(T_POINTS)
                         if 0 <= i + lag - T_POINTS + 1 < T_POINTS))
    return [v / max(found) for v in found]
