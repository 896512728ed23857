"""The exported tables of a class, as they are counted."""
import csv
import re
import tomllib
from pathlib import Path

TESTS = ("pre_test", "post_test", "exam", "retention")
LUMPS = ("lump", "lump_exam")


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
