"""Sittings with lumps: lumps found, false alarms, and the cue that is needed."""
import json
import math
import statistics

from .counting import spread, wilson
from .ideal_observer import below
from .posterior import places, step_quantile
from .records import LUMPS


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
