"""A class with a real broker, attacked with the certificate of one of its stations (s02), and with nothing at all."""
import base64
import hashlib
import json
import os
import pathlib
import sqlite3
import stat
import time
import uuid
import zlib

import mqtt
from lab import Mend, attack, judged

CLASS = "osteo-1"
FOLDER = "instruments/class/palpate/classroom/"
KEEPER = FOLDER + "row_keeper.cpp"
CONFIGURATION = FOLDER + "class_folder.cpp"
NOW_MS = int(time.time() * 1000)


class Class:
    """Made, served with its broker, and up: s01 is honest, s02 is not."""

    def __init__(self, lab):
        self.lab, self.port, self.folder = lab, lab.free_port(), lab.folder / "class"
        made = lab.run("class", "init", self.folder, "--class", CLASS, "--stations", "3", "--port", str(self.port))
        if made.returncode != 0:
            raise RuntimeError(made.stderr.decode())

    def serve(self):
        self.server = self.lab.start(self.lab.palpate, "class", "serve", self.folder, "--broker", "--json", log="serve.log")
        if not self.lab.wait_for(lambda: self.report().get("connected"), 10):
            raise RuntimeError("the class did not come up: " + (self.lab.folder / "serve.log").read_text()[-300:])
        return self

    def reports(self):
        log = self.lab.folder / "serve.log"
        lines = log.read_text().splitlines() if log.exists() else []
        return [json.loads(line) for line in lines if line.startswith("{") and line.endswith("}")]

    def report(self):
        return (self.reports() or [{}])[-1]

    def refused(self):
        return self.report().get("refused", 0)

    def station(self, name, client_id=None, **options):
        return mqtt.Client(self.folder / "stations" / name, self.port, client_id or f"palpate-{CLASS}-{name}", **options)

    def rows(self, sql, *values):
        with sqlite3.connect(f"file:{self.folder / 'class.results'}?mode=ro", uri=True, timeout=5) as database:
            return database.execute(sql, values).fetchall()

    def send(self, client, name, rows):
        for kind, body in rows:
            client.publish(f"palpate/v1/{CLASS}/st/{name}/{kind}", mqtt.row(body))


def uuid7(ms=NOW_MS):
    raw = bytearray(ms.to_bytes(6, "big") + os.urandom(10))
    raw[6], raw[8] = 0x70 | raw[6] & 15, 0x80 | raw[8] & 63
    return str(uuid.UUID(bytes=bytes(raw)))


def station_id(name):
    digits = list(hashlib.sha256(f"palpate station\n{CLASS}\n{name}".encode()).hexdigest()[:32])
    digits[12] = "8"
    digits[16] = "89ab"[ord(digits[16]) % 4]
    return str(uuid.UUID("".join(digits)))


def station_row(name, called=None):
    return "station", {"id": station_id(name), "name": called or name, "certificate_sha256": "", "device": "none",
                       "calibrated_ms": 0}


def trainee_row(trainee, created_ms, class_id=CLASS):
    return "trainee", {"id": trainee, "class_id": class_id, "created_ms": created_ms, "dominant_hand": "", "consent": True,
                       "key_ref": ""}


def session_row(session, trainee, station, start_ms):
    return "session", {"id": session, "trainee_id": trainee, "station_id": station_id(station), "kind": "practice",
                       "start_ms": start_ms, "end_ms": 0, "app_version": "1", "rng_seed": "7", "device": "none", "file": "",
                       "file_sha256": ""}


def deletion_row(trainee, at_ms):
    return "delete", {"trainee_sha256": hashlib.sha256(f"palpate deleted\n{trainee}".encode()).hexdigest(), "at_ms": at_ms}


def honest_day(group, created_ms=NOW_MS - 60_000):
    """A trainee of s01 with a session: their ids."""
    trainee, session = uuid7(), uuid7()
    client = group.station("s01")
    group.send(client, "s01", [station_row("s01"), ("class", {"id": CLASS, "label": "", "retain_days": 365,
                                                              "retain_samples_days": 90}),
                               trainee_row(trainee, created_ms), session_row(session, trainee, "s01", NOW_MS - 50_000)])
    if not group.lab.wait_for(lambda: group.rows("SELECT 1 FROM session WHERE id = ?", session), 8):
        raise RuntimeError("the honest rows did not arrive: " + str(group.report()))
    return client, trainee, session


@attack("class-kick", "class", [Mend(CONFIGURATION, '"use_username_as_clientid true\\n"', '""')], 25)
def class_kick(lab):
    """With s02's certificate, connects under the client ids of the collector and of s01, again and again."""
    group = Class(lab).serve()
    victim = group.station("s01")
    seen = len(group.reports())
    end = time.monotonic() + 4
    tries = 0
    while time.monotonic() < end:
        for client_id in (f"palpate-{CLASS}-ingest", f"palpate-{CLASS}-s01"):
            group.station("s02", client_id).close()
            tries += 1
        time.sleep(0.1)
    looks = group.reports()[seen:]
    off = sum(not look["connected"] for look in looks)
    alive = victim.alive()
    return judged(looks and off == 0 and alive, f"{tries} connections under others' client ids: collector off in {off} of "
                  f"{len(looks)} looks, s01 {'stayed' if alive else 'was thrown out'}")


@attack("class-sessions", "class", [Mend(CONFIGURATION, '"use_username_as_clientid true\\n"', '""')], 30)
def class_sessions(lab):
    """Opens 300 sessions that never end with one station's certificate, each with a queue."""
    group = Class(lab).serve()
    for i in range(300):
        group.station("s02", f"session-{i}", clean=False, expiry_s=0xFFFFFFFF).close()
    # One that was never opened is there already: all of them are the certificate's one session.
    fresh = group.station("s02", "never-seen-before", clean=False)
    return judged(fresh.session_was_there, f"300 sessions opened; {'all are one' if fresh.session_was_there else 'each is kept'}")


@attack("class-foreign-rows", "class", [Mend(KEEPER, "  if (auto why = ownershipObjection(sent)) return why;\n", "")], 25)
def class_foreign_rows(lab):
    """With s02's certificate, overwrites s01's station row and its trainee's session."""
    group = Class(lab).serve()
    _, trainee, session = honest_day(group)
    thief = group.station("s02")
    stolen = session_row(session, trainee, "s01", NOW_MS - 50_000)
    stolen[1]["end_ms"], stolen[1]["device"] = NOW_MS - 40_000, "forged"
    group.send(thief, "s02", [station_row("s01", "forged"), stolen])
    done = lab.wait_for(lambda: group.refused() >= 2 or group.rows("SELECT 1 FROM session WHERE device = 'forged'"), 6)
    names = group.rows("SELECT count(*) FROM station WHERE name = 'forged'")[0][0]
    sessions = group.rows("SELECT count(*) FROM session WHERE device = 'forged'")[0][0]
    return judged(done and names + sessions == 0,
                  f"rows of s01 overwritten by s02: {names} station, {sessions} session; {group.refused()} refused")


@attack("class-foreign-trainee", "class", [
    Mend(KEEPER, "if (known && known->class_id != trainee->class_id && other(ownerOfTrainee(trainee->id))) {", "if (false) {"),
    Mend(KEEPER, "if (!owner.empty() && owner != sent.station) return;  // sits here too", "// sits here too")], 25)
def class_foreign_trainee(lab):
    """With s02's certificate, moves a trainee of s01 into an invented class that keeps nothing."""
    group = Class(lab).serve()
    _, trainee, _ = honest_day(group)
    thief = group.station("s02")
    group.send(thief, "s02", [("class", {"id": "invented", "label": "", "retain_days": 0, "retain_samples_days": 0}),
                              trainee_row(trainee, NOW_MS - 60_000, "invented")])
    lab.wait_for(lambda: group.refused() >= 1 or group.rows("SELECT 1 FROM trainee WHERE class_id = 'invented'"), 6)
    where = group.rows("SELECT class_id FROM trainee WHERE id = ?", trainee)[0][0]
    days = group.rows("SELECT min(retain_days) FROM class")[0][0]
    return judged(where == CLASS and days > 0, f"the trainee of s01 is in class {where}; shortest retention {days} days")


@attack("class-foreign-deletion", "class", [Mend(KEEPER, "        return owner != sent.station;\n", "        return false;\n"),
                                            Mend(KEEPER, "if (owner != sent.station) ++others[session.station_id];", "")], 25)
def class_foreign_deletion(lab):
    """With s02's certificate, has a trainee of s01 deleted, and every later row of theirs by the year 9999."""
    group = Class(lab).serve()
    honest, trainee, session = honest_day(group)
    thief = group.station("s02")
    group.send(thief, "s02", [station_row("s02"), deletion_row(trainee, 253402300799000)])
    lab.wait_for(lambda: group.rows("SELECT 1 FROM station WHERE name = 's02'"), 5)
    lab.wait_for(lambda: any(look.get("said") for look in group.reports()), 4)
    later = uuid7()
    group.send(honest, "s01", [session_row(later, trainee, "s01", NOW_MS - 10_000)])
    lab.wait_for(lambda: group.rows("SELECT 1 FROM session WHERE id = ?", later), 4)
    there = {row[0] for row in group.rows("SELECT id FROM session")}
    return judged({session, later} <= there, f"sessions of s01's trainee in the class: {len(there & {session, later})} of 2")


@attack("class-future-rows", "class", [Mend(KEEPER, "ahead_ms > kClockSkewMs", "false && ahead_ms > kClockSkewMs")], 25)
def class_future_rows(lab):
    """Sends rows dated to the year 9999, which no retention would ever reach."""
    group = Class(lab).serve()
    thief = group.station("s02")
    group.send(thief, "s02", [station_row("s02"), trainee_row(uuid7(), 253402300799000)])
    done = lab.wait_for(lambda: group.refused() >= 1 or group.rows("SELECT 1 FROM trainee"), 6)
    kept = group.rows("SELECT count(*) FROM trainee")[0][0]
    return judged(done and kept == 0, f"rows of the year 9999 kept: {kept}; refused: {group.refused()}")


@attack("class-fast-clock", "class", [
    Mend(KEEPER, "    if (only_heard || training::deletedMark(trainee.id) != mark) continue;\n",
         "    if (only_heard || training::deletedMark(trainee.id) != mark || trainee.created_ms > deletion.at_ms) continue;\n")], 25)
def class_fast_clock(lab):
    """A trainee whose station's clock runs ahead is deleted by a notice that is dated before."""
    group = Class(lab).serve()
    honest, trainee, _ = honest_day(group, created_ms=int(time.time() * 1000) + 90_000)
    group.send(honest, "s01", [deletion_row(trainee, int(time.time() * 1000))])
    gone = lab.wait_for(lambda: not group.rows("SELECT 1 FROM trainee WHERE id = ?", trainee), 5)
    return judged(gone, f"after the notice {0 if gone else 1} trainee is left")


@attack("class-trainee-id", "class", [
    Mend("instruments/teach/palpate/training/records/trainee_code.cpp", "key.empty() ? computeSha256(text) : computeHmacSha256(key, text)",
         "key != \"-\" ? computeSha256(text) : computeHmacSha256(key, text)")], 20)
def class_trainee_id(lab):
    """Who has seen a trainee's card works out the pseudonym from the class's name and the code."""
    group = Class(lab)
    made = lab.run("train", "results", "codes", "--count", "20", "--class", group.folder, "--json")
    codes = json.loads(made.stdout)["codes"]

    def guessed(code):
        raw = bytearray(hashlib.sha256(f"palpate trainee\n{CLASS}\n{code}".encode()).digest()[:16])
        raw[6], raw[8] = 0x80 | raw[6] & 15, 0x80 | raw[8] & 63
        return str(uuid.UUID(bytes=bytes(raw)))
    right = sum(guessed(one["code"]) == one["trainee"] for one in codes)
    return judged(len(codes) == 20 and right == 0, f"{right} of {len(codes)} pseudonyms guessed from the card")


def memory_mb(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    return 0.0


@attack("class-inbox", "class", [
    Mend(FOLDER + "collector.cpp", "bytes_of[at->station] >= kMaxStationBytes || inbox_bytes >= kMaxInboxBytes || ", "")], 40)
def class_inbox(lab):
    """5,000 messages of some 300 bytes that unpack to 64 kB each, while the database is locked."""
    group = Class(lab).serve()
    lock = sqlite3.connect(group.folder / "class.results", timeout=5, isolation_level=None)
    lock.execute("BEGIN IMMEDIATE")
    before = memory_mb(group.server)
    thief = group.station("s02")
    digest = hashlib.sha256(b"x").hexdigest()
    sent = size = 0
    for version in range(5000):
        body = json.dumps({"id": "flood", "version": version, "text": "x" * 64_000, "sha256": digest}).encode()
        packed = base64.b64encode(zlib.compress(body, 9)).decode()
        message = json.dumps({"seq": version, "id": str(uuid.uuid4()), "t": 1.0, "z": packed}).encode()
        size += len(message)
        thief.publish(f"palpate/v1/{CLASS}/st/s02/protocol", message, wait=False)
        sent += 1
        if sent % 50 == 0:
            thief.drain(50)
    lab.wait_for(lambda: group.report().get("dropped", 0) + group.report().get("inbox", 0) > 4000, 8)
    after = memory_mb(group.server)
    lock.execute("ROLLBACK")
    lock.close()
    return judged(after - before < 100, f"{sent} messages of {size // sent} bytes: the collector grew from {before:.0f} to "
                  f"{after:.0f} MB, {group.report().get('dropped')} dropped")


@attack("class-disk-share", "class", [
    Mend(KEEPER, "if (!deletes && bytesOf(sent.station) + static_cast<std::int64_t>(sent.bytes) > rules_.station_bytes) {",
         "if (!deletes && bytesOf(sent.station) < 0) {")], 30)
def class_disk_share(lab):
    """Fills the class's disk with rows of one station."""
    group = Class(lab)
    settings = group.folder / "class.toml"
    settings.write_text(settings.read_text().replace("station_megabytes = 256", "station_megabytes = 1"))
    group.serve()
    thief = group.station("s02")
    for version in range(60):
        group.send(thief, "s02", [("protocol", {"id": "flood", "version": version, "text": "x" * 60_000,
                                               "sha256": hashlib.sha256(b"x").hexdigest()})])
    lab.wait_for(lambda: group.refused() > 30 or len(group.rows("SELECT 1 FROM protocol")) >= 60, 10)
    _, _, session = honest_day(group)
    kept = group.rows("SELECT count(*) FROM protocol")[0][0]
    return judged(kept <= 18, f"{kept} of 60 rows of 60 kB kept with a share of 1 MB; s01 writes on ({session[:8]})")


@attack("class-key-mode", "class", [
    Mend(CONFIGURATION, "  if ((allowed & (fs::perms::group_all | fs::perms::others_all)) == fs::perms::none) return {};\n", "  return {};\n")], 20)
def class_key_mode(lab):
    """A station's key lies readable for everybody: does `class check` say so?"""
    group = Class(lab)
    key = group.folder / "stations" / "s01" / "station.key"
    modes = {stat.S_IMODE(file.stat().st_mode) for file in group.folder.rglob("*.key")}
    key.chmod(0o644)
    checked = lab.run("class", "check", group.folder, "--json", seconds=15)
    said = [step for step in json.loads(checked.stdout)["steps"] if "keys" in step["what"]]
    named = bool(said) and not said[0]["ok"] and "station.key" in said[0]["detail"]
    return judged(modes == {0o600} and named, f"keys were made with modes {sorted(oct(mode) for mode in modes)}; one of mode 644 "
                  f"{'is' if named else 'is not'} refused by `class check`")


@attack("class-password-argv", "class", [
    Mend(FOLDER + "postgres_sql.cpp", "  if (has_password) {\n", "  if (has_password && connection.empty()) {\n")], 15)
def class_password_argv(lab):
    """A database's password on the command line, where every user of the computer sees it."""
    said = []
    for address in ("postgresql://teacher:hunter2@localhost:1/osteo", "host=/nowhere dbname=osteo password=hunter2"):
        ended = lab.run("train", "results", "class", address, seconds=10)
        said.append((ended.returncode, ended.stderr.decode()))
    told = sum(code != 0 and ".pgpass" in text and "hunter2" not in text for code, text in said)
    return judged(told == 2, f"{told} of 2 addresses with a password refused, with a word on ~/.pgpass")
