"""A trainee, and a class of them, in the numbers of a report."""
import math

from .counting import boxes, left_out, spread, tally, trial_statistics
from .groups import difference, fit_normal, group, student95
from .learning import curves
from .posterior import CELL, T_POINTS
from .records import LUMPS, TESTS
from .thresholds import Point, change_between, why_not


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
