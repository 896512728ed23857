#!/usr/bin/env python3
"""Computes every number of a training report again from the exported tables, and says where they differ.

  palpate train results export FILE.results --csv TABLES
  palpate train results report FILE.results --out page.html            (or: palpate train results report FILE.results --json > report.json)
  tools/check_report.py page.html TABLES

Plain Python, no packages, and no code of palpate's: counting, quantiles, Wilson's intervals, the posterior of each
block on its grid, the filtered learning curve and its exponential, the two-level model of a class. Every number of the
report must be met within 1e-6 (of itself where it is larger than 1), and no number may be in it that is not computed
here. Exit code 0: all met; 1: not.
"""
import csv
import json
import math
import re
import statistics
import sys
import tomllib
from pathlib import Path

TOLERANCE = 1e-6
TESTS = ("pre_test", "post_test", "exam", "retention")
LUMPS = ("lump", "lump_exam")

# ---- reading


def table(folder, name):
    with open(Path(folder) / name, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    texts = {"id", "text", "kind", "method", "verdict", "excluded", "name", "label", "device", "app_version", "file",
             "file_sha256", "sha256", "state_json", "change_meaning", "protocol_id", "class_id", "rng_seed", "lumps"}
    for row in rows:
        for key, value in row.items():
            if key in texts or key.endswith("_id"):
                continue
            if value in ("true", "false"):
                row[key] = value == "true"
            elif re.fullmatch(r"-?\d+", value):
                row[key] = int(value)
            elif re.fullmatch(r"-?[\d.]+([eE][-+]?\d+)?", value):
                row[key] = float(value)
            elif value == "":
                row[key] = None
    return rows


class Records:
    def __init__(self, folder):
        self.protocols = table(folder, "protocols.csv")
        self.settings = {(p["id"], p["version"]): tomllib.loads(p["text"]) for p in self.protocols}
        self.classes = {c["id"]: c["label"] for c in table(folder, "classes.csv")}
        self.trainees = sorted(table(folder, "trainees.csv"), key=lambda t: t["id"])
        self.sessions = sorted(table(folder, "sessions.csv"), key=lambda s: s["start_ms"])
        self.blocks, self.trials, self.visits, self.events = {}, {}, {}, {}
        for block in sorted(table(folder, "blocks.csv"), key=lambda b: b["number"]):
            self.blocks.setdefault(block["session_id"], []).append(block)
        for trial in sorted(table(folder, "trials.csv"), key=lambda t: t["number"]):
            self.trials.setdefault(trial["block_id"], []).append(trial)
        for visit in table(folder, "site_visits.csv"):
            self.visits.setdefault(visit["trial_id"], []).append(visit)
        for event in table(folder, "events.csv"):
            self.events.setdefault(event["session_id"], []).append(event)

    def rules(self, block):
        settings = self.settings.get((block["protocol_id"], block["protocol_version"]), {})
        places = settings.get("sites") or [None] * 12
        return len(places), 1000.0 * settings.get("exploration", {}).get("dwell_s", 0.3)


# ---- the ideal observer, by a finer rule and by bisection


def below(x):
    return 0.5 * math.erfc(-x / math.sqrt(2))


def ideal_right(d, choices):
    step = 0.05
    return sum(step * math.exp(-0.5 * x * x) / math.sqrt(2 * math.pi) * below(d + x) ** (choices - 1)
               for x in (-9 + step * i for i in range(361)))


def d_prime(share, choices):
    wanted = 1 / choices + (1 - 1 / choices) * share
    low, high = 0.0, 8.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ideal_right(middle, choices) < wanted else (low, middle)
    return 0.5 * (low + high)


IDEAL = {}


def ideal(choices):
    """d' at the threshold, and the slope."""
    if choices not in IDEAL:
        quarter, half, most = (d_prime(s, choices) for s in (0.25, 0.5, 0.75))
        IDEAL[choices] = half, math.log(math.log(4) / math.log(4 / 3)) / math.log(most / quarter)
    return IDEAL[choices]


# ---- the posterior

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


def grid_quantile(values, weights, share):
    cell, total = values[1] - values[0], 0.0
    for value, weight in zip(values, weights):
        if total + weight >= share and weight > 0:
            return value + cell * ((share - total) / weight - 0.5)
        total += weight
    return values[-1] + 0.5 * cell


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


# ---- counting


def left_out(trial):
    if trial["kind"] == "warm_up":
        return ""
    return trial["excluded"] or ("fewer than two places felt" if trial["sites_felt"] < 2 else "")


def counts(trial):
    return trial["kind"] != "warm_up" and not left_out(trial)


def quantile(values, share):
    at = share * (len(values) - 1)
    low = int(at)
    high = min(low + 1, len(values) - 1)
    return values[low] + (at - low) * (values[high] - values[low])


def spread(values):
    if not values:
        return None
    values = sorted(values)
    return {"count": len(values), "mean": sum(values) / len(values), "least": values[0],
            "lower_quartile": quantile(values, 0.25), "median": quantile(values, 0.5),
            "upper_quartile": quantile(values, 0.75), "greatest": values[-1]}


def wilson(part, whole):
    z = 1.959963984540054
    p = part / whole
    middle = (p + z * z / (2 * whole)) / (1 + z * z / whole)
    half = z / (1 + z * z / whole) * math.sqrt(p * (1 - p) / whole + z * z / (4 * whole * whole))
    return max(0.0, middle - half), min(1.0, middle + half)


def corrected(share, chance):
    return (share - chance) / (1 - chance) if chance < 1 else 0.0


def answers_of(trials):
    """(place, correct, chance, expected) of those that count."""
    return [(t["change"], t["correct"], 1 / max(t["sites_felt"], 1), 0.0) for t in trials if counts(t)]


def shares(group):
    n, right = len(group), sum(a[1] for a in group)
    low, high = wilson(right, n)
    chance = sum(a[2] for a in group) / n
    return {"trials": n, "correct": right, "share": right / n, "low": low, "high": high, "chance": chance,
            "corrected": corrected(right / n, chance)}


def levels(answers):
    groups = {}
    for answer in answers:
        groups.setdefault(answer[0], []).append(answer)
    return [{"change": change, **shares(groups[change])} for change in sorted(groups)]


def boxes(answers, first=0.03, last=1 + 1e-9, count=10):
    width = math.log(last / first) / count
    groups = {}
    for answer in answers:
        at = math.log(answer[0] / first) / width
        if 0 <= at < count:
            groups.setdefault(int(at), []).append(answer)
    rows = []
    for box in sorted(groups):
        group = groups[box]
        n = len(group)
        rows.append({"from": first * math.exp(width * box), "to": first * math.exp(width * (box + 1)),
                     "middle": math.exp(sum(math.log(a[0]) for a in group) / n), **shares(group),
                     "expected": sum(a[3] for a in group) / n})
    return rows


def histogram(values, width, count):
    bins = [0] * count
    for value in values:
        bins[min(max(int(value // width), 0), count - 1)] += 1
    return {"box_width": width, "counts": bins}


def sites(records, chosen):
    number = max((c for _, c, _ in chosen), default=0)
    rows = []
    for site in range(1, number + 1):
        all_trials = [(t, felt_ms) for t, c, felt_ms in chosen if t["kind"] != "warm_up" and site <= c]
        visits = [(v, felt_ms) for t, felt_ms in all_trials for v in records.visits.get(t["id"], [])
                  if v["site"] == site]
        n, touched = max(len(all_trials), 1), max(len(visits), 1)
        rows.append({"site": site, "trials": len(all_trials),
                     "felt": sum(v["dwell_ms"] >= felt_ms - 0.5 for v, felt_ms in visits),
                     "presses_per_trial": sum(v["presses"] for v, _ in visits) / n,
                     "dwell_s_per_trial": sum(v["dwell_ms"] for v, _ in visits) / 1000 / n,
                     "peak_force_n": sum(v["peak_force_n"] for v, _ in visits) / touched,
                     "greatest_force_n": max([0.0] + [v["peak_force_n"] for v, _ in visits]),
                     "deepest_mm": max([0.0] + [v["deepest_mm"] for v, _ in visits])})
    return rows


def tally(chosen):
    shown = [t for t, _, _ in chosen]
    asked = [(t, c) for t, c, _ in chosen if t["kind"] != "warm_up"]
    counted = [t for t in shown if counts(t)]
    easy = [t for t in counted if t["kind"] == "easy"]
    return {"shown": len(shown), "warm_up": len(shown) - len(asked), "excluded": len(asked) - len(counted),
            "counted": len(counted), "correct": sum(t["correct"] for t in counted),
            "timeouts": sum(t["timed_out"] for t, _ in asked),
            "not_all_felt": sum(t["sites_felt"] < c for t, c in asked), "easy": len(easy),
            "easy_wrong": sum(not t["correct"] for t in easy)}


def trial_statistics(records, chosen):
    numbers = tally(chosen)
    if not chosen:
        return numbers
    shown = [t for t, _, _ in chosen]
    asked = [t for t in shown if t["kind"] != "warm_up"]
    counted = [t for t in shown if counts(t)]
    number = max(c for _, c, _ in chosen)
    answers = [[0] * (number + 1) for _ in range(number)]
    wrong = {"beside": 0, "other_side": 0, "elsewhere": 0, "none": 0}
    for trial in counted:
        truth, answer = trial["site_true"], trial["site_answer"]
        known = 1 <= answer <= number
        answers[truth - 1][answer - 1 if known else number] += 1
        if answer == truth:
            continue
        same_side = (answer - 1) // 6 == (truth - 1) // 6
        where = ("none" if not known else
                 "beside" if number == 12 and same_side and abs(answer - truth) == 1 else
                 "other_side" if number == 12 and abs(answer - truth) == 6 else "elsewhere")
        wrong[where] += 1
    search = [t["search_force_n"] for t in asked if t["search_force_n"] > 0]
    palpate = [t["palpate_force_n"] for t in asked if t["palpate_force_n"] > 0]
    touched = [t for t in asked if t["peak_force_n"] > 0]
    seconds = [t["seconds"] for t in asked]
    speed = [t["mean_speed_mm_per_s"] for t in touched]
    numbers.update({
        "levels": levels(answers_of(shown)), "boxes": boxes(answers_of(shown)),
        "sites": sites(records, chosen), "answers": answers, "wrong": wrong,
        "seconds": spread(seconds),
        "seconds_correct": spread([t["seconds"] for t in counted if t["correct"]]),
        "seconds_wrong": spread([t["seconds"] for t in counted if not t["correct"]]),
        "places_felt": spread([t["sites_felt"] for t in asked]),
        "mean_force_n": spread([t["mean_force_n"] for t in touched]),
        "peak_force_n": spread([t["peak_force_n"] for t in touched]),
        "search_force_n": spread(search), "palpate_force_n": spread(palpate), "speed_mm_per_s": spread(speed),
        "seconds_boxes": histogram(seconds, 5.0, 24), "search_force_boxes": histogram(search, 0.25, 40),
        "palpate_force_boxes": histogram(palpate, 0.25, 40), "speed_boxes": histogram(speed, 10.0, 30)})
    return numbers


# ---- thresholds


def attention(answers, choices, threshold, slope):
    """How much likelier guesses explain a run of answers than the fitted curve, nat, at most."""
    lapse, total, highest, easy, missed = 0.02, 0.0, 0.0, 0, 0
    for change, correct, felt in answers:
        if felt < 2:
            continue
        t, s, guess = threshold, slope, 1 / felt
        if felt != choices:
            (at, steep), (all_at, all_steep) = ideal(felt), ideal(choices)
            t, s = threshold * at / all_at, slope * steep / all_steep
        f = 1 - math.exp(-math.log(2) * (change / t) ** s)
        right = guess + (1 - guess - lapse) * f
        guessed = guess if correct else 1 - guess
        total = max(0.0, total + math.log(guessed / (right if correct else 1 - right)))
        highest = max(highest, total)
        if f >= 0.9:
            easy += 1
            missed += not correct
    return {"easy": easy, "easy_missed": missed, "evidence": highest, "warned": highest >= 5.25}


class Point:
    """A block with its trials."""

    def __init__(self, records, session, block):
        self.session, self.block = session, block
        self.choices, felt_ms = records.rules(block)
        trials = records.trials[block["id"]]
        self.start_ms = trials[0]["start_ms"]
        self.chosen = [(t, self.choices, felt_ms) for t in trials]
        self.answers = [(t["change"], t["correct"], min(t["sites_felt"], self.choices)) for t in trials if counts(t)]
        self.kind, self.nth = session["kind"], 0
        self.weights = self.threshold = None
        if block["method"] != "mastery" and len(self.answers) >= 10:
            self.weights = updated(prior_weights(), self.answers, self.choices)
            self.threshold = summary(self.weights)
            self.slope = sum(w * slopes(self.choices)[i // len(LAPSES) % SLOPE_POINTS]
                             for i, w in enumerate(self.weights))
            self.lapse = sum(w * LAPSES[i % len(LAPSES)][0] for i, w in enumerate(self.weights))
            self.attention = attention(self.answers, self.choices, self.threshold["median"], self.slope)

    def measures(self):
        return self.threshold is not None and self.kind in ("pre_test", "post_test", "retention")

    def hand(self):
        return self.block["change_meaning"], self.choices, self.session["device"]

    def likelihood(self):
        before = t_weights(prior_weights())
        now = [w / b for w, b in zip(t_weights(self.weights), before)]
        return [w / max(now) for w in now]

    def numbers(self):
        block = self.block
        asked = [t for t, _, _ in self.chosen if t["kind"] != "warm_up"]
        found = {"block": block["id"], "kind": self.kind, "nth": self.nth, "start_ms": self.start_ms,
                 "method": block["method"], "change_meaning": block["change_meaning"],
                 "protocol": block["protocol_id"], "protocol_version": block["protocol_version"],
                 "device": self.session["device"], "choices": self.choices, "finished": block["finished"],
                 "verdict": block["verdict"], "mastered_change": block["mastered_change"],
                 "trials": tally(self.chosen), "seconds": spread([t["seconds"] for t in asked]),
                 "places_felt": spread([t["sites_felt"] for t in asked]), "threshold": self.threshold}
        if self.threshold:
            found.update({"slope": self.slope, "lapse": self.lapse, "attention": self.attention,
                          "stored": {"median": block["threshold"], "low": block["threshold_low"],
                                     "high": block["threshold_high"]}})
        return found

    def fit(self):
        changes = [0.03 * (1 / 0.03) ** (i / 48) for i in range(49)]
        found = {"block": self.block["id"], "changes": changes, "mean": [], "low": [], "high": [],
                 "answers": boxes(answers_of(t for t, _, _ in self.chosen))}
        guess = 1 / self.choices
        for change in changes:
            cells = []
            for i, weight in enumerate(self.weights):
                slope = slopes(self.choices)[i // len(LAPSES) % SLOPE_POINTS]
                lapse = LAPSES[i % len(LAPSES)][0]
                felt = 1 - math.exp(-math.log(2) * (change / math.exp(LN_T[i // EACH])) ** slope)
                cells.append((guess + (1 - guess - lapse) * felt, weight))
            found["mean"].append(sum(p * w for p, w in cells))
            cells.sort()
            found["low"].append(step_quantile(cells, 0.025))
            found["high"].append(step_quantile(cells, 0.975))
        return found


def step_quantile(cells, share):
    total = 0.0
    for value, weight in cells:
        total += weight
        if total >= share:
            return value
    return cells[-1][0]


def change_between(before, now):
    ln = math.log(now["median"] / before["median"])
    wide = math.hypot(*(0.5 * math.log(s["high"] / s["low"]) for s in (before, now)))
    return {"ratio": math.exp(ln), "low": math.exp(ln - wide), "high": math.exp(ln + wide), "clear": abs(ln) > wide}


def why_not(a, b):
    if a.block["change_meaning"] != b.block["change_meaning"]:
        return "one is a change of compliance, the other of stiffness"
    if a.choices != b.choices:
        return "they asked about different numbers of places"
    if a.session["device"] != b.session["device"]:
        return "they were felt with different devices"
    if (a.block["protocol_id"], a.block["protocol_version"]) != (b.block["protocol_id"], b.block["protocol_version"]):
        return "they follow different protocols"
    if a.attention["warned"] or b.attention["warned"]:
        return "answers in a row were like guesses where changes were easy to feel (inattention)"
    return None


# ---- learning


def likelihood_of(answers, choices):
    before = t_weights(prior_weights())
    now = [w / b for w, b in zip(t_weights(updated(prior_weights(), answers, choices)), before)]
    return [w / max(now) for w in now]


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


# ---- groups


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


# ---- the report


class Trainee:
    def __init__(self, records, row):
        self.row, self.records = row, records
        self.sessions = [s for s in records.sessions if s["trainee_id"] == row["id"]]
        self.points, self.tests, self.practice = [], [], []
        for session in self.sessions:
            for block in records.blocks.get(session["id"], []):
                if block["id"] not in records.trials or session["kind"] in LUMPS:
                    continue
                point = Point(records, session, block)
                (self.tests if session["kind"] in TESTS else self.practice).extend(point.chosen)
                if session["kind"] != "free":
                    self.points.append(point)
        self.points.sort(key=lambda p: p.start_ms)
        seen = {}
        for point in self.points:
            point.nth = seen[point.kind] = seen.get(point.kind, 0) + 1
        measured = [p for p in self.points if p.measures()]
        self.ends = (measured[0], measured[-1]) if len(measured) > 1 else None

    def compared(self):
        if self.ends is None:
            return None
        before, now = self.ends
        found = {"before": before.block["id"], "now": now.block["id"], "why_not": why_not(before, now)}
        if found["why_not"] is None:
            found.update(change_between(before.threshold, now.threshold))
        return found

    def numbers(self, whole):
        excluded = {}
        for trial, _, _ in self.tests + self.practice:
            if left_out(trial):
                excluded[left_out(trial)] = excluded.get(left_out(trial), 0) + 1
        of = (lambda chosen: trial_statistics(self.records, chosen)) if whole else tally
        found = {"trainee": self.row["id"][:8], "points": [p.numbers() for p in self.points],
                 "tests": of(self.tests), "practice": of(self.practice), "compared": self.compared(),
                 "excluded": excluded,
                 "changed_results": sum(p.threshold is not None and p.block["threshold"] > 0 and
                                        abs(p.threshold["median"] - p.block["threshold"]) > 1e-6
                                        for p in self.points)}
        if not whole:
            return found
        found["curve"], found["learning"] = curves(self.points)
        found["sittings"] = []
        for s in self.sessions:
            kinds = [e["kind"] for e in self.records.events.get(s["id"], [])]
            found["sittings"].append({**{key: s[key] for key in ("id", "kind", "start_ms", "end_ms", "app_version",
                                                                "device", "file", "file_sha256")},
                                      "events": {kind: kinds.count(kind) for kind in kinds}})
        found["fits"] = [p.fit() for p in self.points if p.threshold and p.kind in TESTS]
        return found


def occasions(trainees, with_group, least=1):
    keys = {}
    for trainee in trainees:
        for place, point in enumerate(trainee.points):
            if point.threshold:
                keys.setdefault((point.kind, point.nth), []).append((place, point))
    kinds = ["practice", "mastery", "pre_test", "post_test", "exam", "retention"]
    order = sorted(keys, key=lambda k: (sum(p for p, _ in keys[k]) / len(keys[k]), kinds.index(k[0]), k[1]))
    rows = []
    for key in order:
        points = [p for _, p in keys[key]]
        if len(points) < least:
            continue
        rows.append({"kind": key[0], "nth": key[1], "medians": spread([p.threshold["median"] for p in points])})
        if with_group:
            verdicts = [p.block["verdict"] for p in points if p.block["verdict"] != "none"]
            rows[-1]["group"] = group([p.likelihood() for p in points])
            rows[-1]["verdicts"] = {v: verdicts.count(v) for v in verdicts}
    return rows


def class_numbers(records, trainees):
    collapsed, changes, better, worse = [], [], 0, 0
    for trainee in trainees:
        for p in trainee.points:
            if p.threshold is None or p.kind not in TESTS:
                continue
            guess = 1 / p.choices
            for change, correct, felt in p.answers:
                found = 1 - math.exp(-math.log(2) * (change / p.threshold["median"]) ** p.slope)
                collapsed.append((change / p.threshold["median"], correct, 1 / felt,
                                  guess + (1 - guess - p.lapse) * found))
        compared = trainee.compared()
        if compared and compared["why_not"] is None:
            changes.append(difference(*(p.likelihood() for p in trainee.ends)))
            if compared["clear"]:
                better, worse = better + (compared["ratio"] < 1), worse + (compared["ratio"] >= 1)
    tests = [c for t in trainees for c in t.tests]
    practice = [c for t in trainees for c in t.practice]
    found = {"occasions": occasions(trainees, True), "tests": trial_statistics(records, tests),
             "practice": trial_statistics(records, practice), "collapsed": boxes(collapsed, 0.25, 8.0),
             "change": None}
    if changes:
        found["change"] = {"trainees": len(changes), "clearly_better": better, "clearly_worse": worse}
        if len(changes) > 1:
            grid = [CELL * (lag - T_POINTS + 1) for lag in range(2 * T_POINTS - 1)]
            mean, sd, error = fit_normal(grid, changes)
            reach = student95(len(changes) - 1) * error
            found["change"].update({"factor": math.exp(-mean), "low": math.exp(-mean - reach),
                                    "high": math.exp(-mean + reach), "sd_ln": sd})
    return found


# ---- sittings with lumps


def judged(trial, diameters):
    """Of each finding: its lump's number or None, and how far beside the nearest lump."""
    pairs, nearest = [], [None] * len(trial["findings"])
    for f, finding in enumerate(trial["findings"]):
        if "x_mm" not in finding:
            continue
        for i, lump in enumerate(trial["hidden"]):
            away = math.hypot(finding["x_mm"] - lump["x_mm"], finding["y_mm"] - lump["y_mm"])
            nearest[f] = away if nearest[f] is None else min(nearest[f], away)
            if away <= max(10.0, 0.5 * diameters[lump["size"]]):
                pairs.append((away, f, i))
    own, taken = [None] * len(nearest), set()
    for _, f, i in sorted(pairs):
        if own[f] is None and i not in taken:
            own[f] = i
            taken.add(i)
    return own, nearest


def cue_threshold(sought):
    if not sought:
        return {"median": 0.0, "low": 0.0, "high": 0.0}
    places_ln = places(121, 6.0)
    weights = []
    for place in places_ln:
        total = 0.0
        for spread_ln in (0.5, 1.0, 1.7, 2.5, 3.4):
            weight = math.exp(-0.5 * (place / 2.0) ** 2)
            for ln_cue, hit in sought:
                right = 0.98 * below((ln_cue - place) / spread_ln)
                weight *= right if hit else 1.0 - right
            total += weight
        weights.append(total)
    cells, total = list(zip(map(math.exp, places_ln), weights)), sum(weights)
    median, low, high = (step_quantile(cells, s * total) for s in (0.5, 0.025, 0.975))
    return {"median": median, "low": low, "high": high}


def rate(answers):
    part, whole = sum(answers), len(answers)
    low, high = wilson(part, whole) if whole else (0.0, 1.0)
    return {"part": part, "whole": whole, "share": part / whole if whole else 0.0, "low": low, "high": high}


def d_prime_of(hits, alarms):
    def scaled(answers):
        share = (sum(answers) + 0.5) / (len(answers) + 1)
        z = statistics.NormalDist().inv_cdf(share)
        density = math.exp(-0.5 * z * z) / math.sqrt(2 * math.pi)
        return z, share * (1 - share) / ((len(answers) + 1) * density ** 2)
    (hit, hit_variance), (alarm, alarm_variance) = scaled(hits), scaled(alarms)
    half = 1.959964 * math.sqrt(hit_variance + alarm_variance)
    return {"value": hit - alarm, "low": hit - alarm - half, "high": hit - alarm + half}


def lump_statistics(bodies, diameters):
    bodies = [b for b in bodies if b["over"]]
    grades, said = {g: [[], [], []] for g in ("size", "depth", "hardness")}, {}
    by_mobility, mobility_right, errors, sought = {False: [], True: []}, [], [], []
    in_vain = 0
    for g in grades:
        said[g] = [[0, 0, 0] for _ in range(3)]
    for body in bodies:
        own, nearest = judged(body, diameters)
        in_vain += own.count(None)
        for i, lump in enumerate(body["hidden"]):
            hit = i in own
            sought.append((math.log(max(lump["cue"], 1e-4)), hit))
            by_mobility[lump["mobile"]].append(hit)
            for g in grades:
                grades[g][lump[g]].append(hit)
            if not hit:
                continue
            finding = body["findings"][own.index(i)]
            errors.append(nearest[own.index(i)])
            for g in grades:
                if finding[g] >= 0:
                    said[g][lump[g]][finding[g]] += 1
            if finding["mobile"] >= 0:
                mobility_right.append((finding["mobile"] == 1) == lump["mobile"])
    known_with = [bool(b["findings"]) for b in bodies if b["hidden"]]
    said_without = [bool(b["findings"]) for b in bodies if not b["hidden"]]
    error = spread(errors) if errors else {"count": 0, "median": 0.0, "greatest": 0.0}
    return {"bodies": len(bodies), "false_places": in_vain, "found": rate([hit for _, hit in sought]),
            "known_with": rate(known_with), "known_without": rate([not s for s in said_without]),
            "d_prime": d_prime_of(known_with, said_without) if known_with and said_without else None,
            "cue": cue_threshold(sought), "by_size": [rate(a) for a in grades["size"]],
            "by_depth": [rate(a) for a in grades["depth"]], "by_hardness": [rate(a) for a in grades["hardness"]],
            "fixed": rate(by_mobility[False]), "mobile": rate(by_mobility[True]), "said_size": said["size"],
            "said_depth": said["depth"], "said_hardness": said["hardness"], "mobility_right": rate(mobility_right),
            "error_mm": {key: error[key] for key in ("count", "median", "greatest")}}


def lump_groups(records, wanted):
    groups = {}
    for session in records.sessions:
        if session["kind"] not in LUMPS or session["trainee_id"][:8] not in wanted:
            continue
        for block in records.blocks.get(session["id"], []):
            task = records.settings.get((block["protocol_id"], block["protocol_version"]), {}).get("lump")
            if block["id"] not in records.trials or task is None:
                continue
            key = (LUMPS.index(session["kind"]), block["protocol_id"], block["protocol_version"])
            bodies = [json.loads(t["lumps"]) for t in records.trials[block["id"]]]
            start_ms = records.trials[block["id"]][0]["start_ms"]
            groups.setdefault(key, (task, []))[1].append((start_ms, block["id"], session, block, bodies))
    found = []
    for key, (task, sittings) in sorted(groups.items()):
        sittings.sort(key=lambda s: s[:2])
        diameters = task["diameters_mm"]
        found.append({"kind": LUMPS[key[0]], "protocol": key[1], "protocol_version": key[2], "diameters_mm": diameters,
                      "depths_mm": task["depths_mm"], "ratios": task["ratios"],
                      "all": lump_statistics([b for s in sittings for b in s[4]], diameters),
                      "sittings": [{"block": block["id"], "trainee": session["trainee_id"][:8], "start_ms": start_ms,
                                    "device": session["device"], "finished": block["finished"],
                                    "verdict": block["verdict"], **lump_statistics(bodies, diameters)}
                                   for start_ms, _, session, block, bodies in sittings]})
    return found


def expected_report(report, records):
    found = {"protocols": [{key: p[key] for key in ("id", "version", "sha256")} for p in records.protocols]}
    wanted = {t["trainee"] for t in report["trainees"]}
    if lumps := lump_groups(records, wanted):
        found["lumps"] = lumps
    if report["of"] == "trainee":
        row = next(t for t in records.trainees if t["id"][:8] in wanted)
        found["trainees"] = [Trainee(records, row).numbers(True)]
        others = [Trainee(records, t) for t in records.trainees if t["class_id"] == row["class_id"]]
        found["others"] = occasions(others, False, 5) if len(others) >= 5 else []
    else:
        trainees = [Trainee(records, t) for t in records.trainees if t["id"][:8] in wanted]
        found["trainees"] = [t.numbers(False) for t in trainees]
        found["all"] = class_numbers(records, trainees)
    return found


# ---- holding the two against each other

WORDS = ("report", "of", "records", "class", "threshold_definition", "sentences")


def differences(have, want, where=""):
    """How many numbers were held against each other, and what differs."""
    if isinstance(have, dict) and isinstance(want, dict):
        keys = [k for k in have if where or k not in WORDS]
        wrong = [f"{where}/{k}: only in one of the two" for k in set(keys) ^ set(want)]
        parts = [differences(have[k], want[k], f"{where}/{k}") for k in keys if k in want]
        return sum(n for n, _ in parts), wrong + [w for _, ws in parts for w in ws]
    if isinstance(have, list) and isinstance(want, list):
        if len(have) != len(want):
            return 0, [f"{where}: {len(have)} entries, computed {len(want)}"]
        parts = [differences(h, w, f"{where}/{i}") for i, (h, w) in enumerate(zip(have, want))]
        return sum(n for n, _ in parts), [w for _, ws in parts for w in ws]
    if isinstance(have, (int, float)) and isinstance(want, (int, float)):
        near = abs(have - want) <= TOLERANCE * max(1.0, abs(want))
        return 1, [] if near else [f"{where}: {have!r}, computed {want!r}"]
    return 0, [] if (have or None) == (want or None) else [f"{where}: {have!r}, computed {want!r}"]


def report_in(path):
    text = Path(path).read_text(encoding="utf-8")
    if text.lstrip().startswith("{"):
        return json.loads(text)
    found = re.search(r'<script type="application/json" id="numbers">(.*?)</script>', text, re.S)
    if found is None:
        sys.exit(f"{path}: holds no numbers")
    return json.loads(found.group(1))


def main():
    if sys.argv[1:2] in (["-h"], ["--help"]):
        print(__doc__.strip())
        sys.exit()
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    report = report_in(sys.argv[1])
    numbers, wrong = differences(report, expected_report(report, Records(sys.argv[2])))
    for line in wrong[:40]:
        print(line)
    print(f"{numbers} numbers, {len(wrong)} differ")
    sys.exit(1 if wrong or numbers == 0 else 0)


if __name__ == "__main__":
    main()
