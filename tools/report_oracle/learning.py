"""The filtered learning curve of a person, and its exponential."""
import math

from .posterior import (CELL, LN_T, PRIOR_SD, PRIOR_T, T_POINTS, likelihood_of, prior_weights, step_quantile, summary,
                        updated, wandered)


def blurred(values, sd):
    found = []
    for to in range(T_POINTS):
        shares = [math.exp(-0.5 * (CELL * (to - start) / sd) ** 2) for start in range(T_POINTS)]
        found.append(sum(s * v for s, v in zip(shares, values)) / sum(shares))
    return [v / max(found) for v in found]


def value_at(values, ln_t):
    at = min(max((ln_t - LN_T[0]) / CELL, 0.0), T_POINTS - 1.0)
    low = min(int(at), T_POINTS - 2)
    return values[low] * (1 - (at - low)) + values[low + 1] * (at - low)


def learning(course):
    if sum(bool(p.answers) for p in course) < 3:
        return None
    curves = []
    for i in range(49):
        z = -3 + 6 * i / 48
        start = PRIOR_T * math.exp(PRIOR_SD * z)
        for j in range(25):
            end = start * math.exp(-(-0.3 + 2.1 * j / 24))
            curves += [[start, end, pace, math.exp(-0.5 * z * z)] for pace in (0.7, 1.0, 1.5, 2.2, 3.3, 5.0, 7.5)]

    def at(curve, n):
        return curve[1] + (curve[0] - curve[1]) * math.exp(-n / curve[2])

    for n, point in enumerate(course):
        told = blurred(likelihood_of(point.answers, point.choices), 0.1)
        for curve in curves:
            curve[3] *= value_at(told, math.log(at(curve, n)))
    heaviest = max(c[3] for c in curves)
    curves = [c for c in curves if c[3] >= heaviest * 1e-6]

    def place(session, quantity):
        cells = sorted((quantity(c), c[3]) for c in curves)
        total = sum(w for _, w in cells)
        median, low, high = (step_quantile(cells, s * total) for s in (0.5, 0.025, 0.975))
        return {"session": session, "median": median, "low": low, "high": high}

    last = len(course) - 1
    return {"first_block": course[0].block["id"], "start": place(0.0, lambda c: c[0]),
            "end": place(float(last), lambda c: c[1]), "pace_sessions": place(0.0, lambda c: c[2])["median"],
            "curve": [place(i / 4, lambda c, n=i / 4: at(c, n)) for i in range(4 * last + 1)]}


def curves(points):
    courses = []
    for point in points:
        if point.threshold is None:
            continue
        if not courses or courses[-1][-1].hand() != point.hand():
            courses.append([])
        courses[-1].append(point)
    rows, fit = [], None
    for course in courses:
        weights = prior_weights()
        for n, point in enumerate(course):
            weights = updated(wandered(weights, 0.2) if n else weights, point.answers, point.choices)
            rows.append({**summary(weights), "block": point.block["id"]})
        fit = learning(course)
    return rows, fit
