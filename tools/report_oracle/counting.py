"""Trials, answers and visits, by plain counting."""
import math


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
