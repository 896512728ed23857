"""The posterior of a block's answers on its grid of thresholds, slopes and lapse rates."""
import math

from .ideal_observer import ideal

T_POINTS, SLOPE_POINTS = 61, 7
LAPSES = [(0.0, 0.25), (0.02, 0.45), (0.05, 0.22), (0.10, 0.08)]
PRIOR_T, PRIOR_SD, PRIOR_SLOPE_SD = 0.22, 0.8, 0.45


def places(points, reach):
    return [reach * (2 * i / (points - 1) - 1) for i in range(points)]


LN_T = [math.log(PRIOR_T) + PRIOR_SD * z for z in places(T_POINTS, 3)]
CELL = LN_T[1] - LN_T[0]
EACH = SLOPE_POINTS * len(LAPSES)


def slopes(choices):
    return [math.exp(math.log(ideal(choices)[1]) + PRIOR_SLOPE_SD * z) for z in places(SLOPE_POINTS, 1.5)]


def normalised(weights):
    total = sum(weights)
    return [w / total if w / total >= 1e-200 else 0.0 for w in weights]


def prior_weights():
    return normalised([math.exp(-0.5 * t * t) * math.exp(-0.5 * s * s) * lapse
                       for t in places(T_POINTS, 3) for s in places(SLOPE_POINTS, 1.5) for _, lapse in LAPSES])


RIGHT = {}


def right_table(change, felt, choices):
    key = (change, felt, choices)
    if key not in RIGHT:
        factor = math.log(ideal(felt)[0] / ideal(choices)[0])
        slope_factor = ideal(felt)[1] / ideal(choices)[1]
        guess = 1 / felt
        cells = []
        for ln_t in LN_T:
            over = math.log(change) - ln_t - factor
            for slope in slopes(choices):
                found = 1 - math.exp(-math.log(2) * math.exp(slope * slope_factor * over))
                cells += [guess + (1 - guess - lapse) * found for lapse, _ in LAPSES]
        RIGHT[key] = cells, [1 - p for p in cells]
    return RIGHT[key]


def updated(weights, answers, choices):
    for change, correct, felt in answers:
        if felt < 2:
            continue
        likelihood = right_table(change, felt, choices)[0 if correct else 1]
        weights = normalised([w * p for w, p in zip(weights, likelihood)])
    return weights


def t_weights(weights):
    return [sum(weights[t * EACH:(t + 1) * EACH]) for t in range(T_POINTS)]


def likelihood_of(answers, choices):
    before = t_weights(prior_weights())
    now = [w / b for w, b in zip(t_weights(updated(prior_weights(), answers, choices)), before)]
    return [w / max(now) for w in now]


def grid_quantile(values, weights, share):
    cell, total = values[1] - values[0], 0.0
    for value, weight in zip(values, weights):
        if total + weight >= share and weight > 0:
            return value + cell * ((share - total) / weight - 0.5)
        total += weight
    return values[-1] + 0.5 * cell


def step_quantile(cells, share):
    total = 0.0
    for value, weight in cells:
        total += weight
        if total >= share:
            return value
    return cells[-1][0]


def summary(weights):
    of_t = t_weights(weights)
    mean = sum(w * t for w, t in zip(of_t, LN_T))
    sd = math.sqrt(sum(w * (t - mean) ** 2 for w, t in zip(of_t, LN_T)))
    median, low, high = (math.exp(grid_quantile(LN_T, of_t, s)) for s in (0.5, 0.025, 0.975))
    return {"median": median, "low": low, "high": high, "mean_ln": mean, "sd_ln": sd}


def wandered(weights, sd):
    moved = [0.0] * len(weights)
    for start in range(T_POINTS):
        reach = [math.exp(-0.5 * (CELL * (to - start) / sd) ** 2) for to in range(T_POINTS)]
        total = sum(reach)
        for to in range(T_POINTS):
            share = reach[to] / total
            if share < 1e-18:
                continue
            for i in range(EACH):
                moved[to * EACH + i] += share * weights[start * EACH + i]
    return normalised(moved)
