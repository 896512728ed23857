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
import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from report_oracle.lumps import lump_groups  # noqa: E402: beside this file
from report_oracle.records import Records  # noqa: E402: beside this file
from report_oracle.trainees import Trainee, class_numbers, occasions  # noqa: E402: beside this file

TOLERANCE = 1e-6


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
