"""The threshold of each block, and how two of one person compare."""
import math

from .counting import answers_of, boxes, counts, spread, tally
from .ideal_observer import ideal
from .posterior import EACH, LAPSES, LN_T, SLOPE_POINTS, prior_weights, slopes, step_quantile, summary, t_weights, updated


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
