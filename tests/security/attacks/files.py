"""Attacks by files: what a stranger puts into a recording or into records, what another user of the computer lays in a
shared folder, and what one can read there."""
import csv
import json
import os
import pathlib
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import threading
import time

import lab

SOUND = lab.ROOT / "tests" / "data" / "sessions" / "version_3" / "trunk.session"
OUTPUT = "engine/host/palpate/base/output_file.cpp"
DATABASE = "engine/host/palpate/trace/database.cpp"
SCHEMA = "engine/host/palpate/trace/recording_schema.cpp"
WRITER = "engine/host/palpate/trace/recording_writer.cpp"
READABLE = "engine/cli/kit/readable_text.cpp"
ACCESS = "engine/cli/serve/access.cpp"
BUNDLE = "engine/host/palpate/engine/recording_bundle.cpp"
SECRET = "-----BEGIN OPENSSH PRIVATE KEY----- of the victim"


def recording(room, name="theirs.session", statements=()):
    """A sound recording that its sender has changed with SQL."""
    file = room.folder / name
    shutil.copy(SOUND, file)
    database = sqlite3.connect(file)
    for sql, *values in statements:
        database.execute(sql, values)
    database.commit()
    database.close()
    return file


def mode_of(file):
    try:
        return stat.S_IMODE(os.stat(file).st_mode)
    except FileNotFoundError:
        return None


class Modes(threading.Thread):
    """Looks again and again at which files below a folder others may open, and which there are at all."""

    def __init__(self, folder):
        super().__init__(daemon=True)
        self.folder = pathlib.Path(folder)
        self.seen, self.open, self.looks = set(), set(), 0
        self.done = threading.Event()

    def run(self):
        while not self.done.is_set():
            self.looks += 1
            for place, folders, files in os.walk(self.folder):
                for name in folders + files:
                    mode = mode_of(os.path.join(place, name))
                    if mode is None:
                        continue
                    self.seen.add(name)
                    if mode & 0o077:
                        self.open.add(f"{name} {mode:o}")

    def end(self):
        self.done.set()
        self.join()
        return self


# --- recordings of strangers

NEVER_ENDS = """CREATE VIEW columns AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)
 SELECT i AS position, 'tick' AS name, 'u64' AS type FROM n WHERE i < 0"""


@lab.attack("recording_that_never_ends", "files", [
    lab.Mend(SCHEMA, '  requireKnownSchema(database, schemaOfRecordings(), "a recording");\n', ""),
    lab.Mend(DATABASE, "{SQLITE_DBCONFIG_ENABLE_VIEW, 0}", "{SQLITE_DBCONFIG_ENABLE_VIEW, 1}"),
    lab.Mend(DATABASE, "kFreeSteps + kStepsPerByte * bytes ? 1 : 0", "kFreeSteps + kStepsPerByte * bytes ? 0 : 0"),
], seconds=40)
def recording_that_never_ends(room):
    """A recording with a view of endless recursion in place of a table hangs whoever reads or only lists it."""
    hostile = recording(room, "a.session", [["DROP TABLE columns"], [NEVER_ENDS]])
    sound = recording(room, "b.session")
    hung = []
    for words in (["recording", "info", hostile], ["recording", "list", room.folder], ["recording", "export", hostile, "--json", "out.json"], ["recording", "report", hostile],
                  ["recording", "replay", hostile], ["recording", "bundle", hostile, "-o", "out.session"]):
        if room.run(*words, seconds=4.0).returncode is None:
            hung.append(words[0])
    listed = room.run("recording", "list", room.folder, seconds=4.0).stdout.decode()
    said = room.run("recording", "info", hostile, seconds=4.0)
    package = pathlib.Path(room.palpate).parent / "python"
    python = "not built"
    # One that was built before the sources is another version's.
    if any(core.stat().st_mtime > (lab.ROOT / DATABASE).stat().st_mtime for core in package.glob("palpate/_core*.so")):
        code = f"import palpate; palpate.Session({str(hostile)!r})"
        ran = room.run_program(sys.executable, "-c", code, seconds=8.0, env=dict(os.environ, PYTHONPATH=str(package)))
        python = "refused it" if ran.returncode == 1 and b"columns" in ran.stderr else "hung or took it"
    held = not hung and said.returncode == 2 and str(sound) + "  " in listed and python != "hung or took it"
    return lab.judged(held, f"{len(hung)} of 6 commands hung; info: exit {said.returncode}; the sound one beside it "
                            f"{'is' if str(sound) + '  ' in listed else 'is not'} listed; Python {python}")


EVIL_PLUGIN = """#include <stdio.h>
__attribute__((constructor)) static void run(void) { FILE* file = fopen("owned", "w"); if (file) fclose(file); }
"""


@lab.attack("scene_brings_a_plugin", "files", [
    lab.Mend("engine/host/palpate/device/back_ends.cpp", 'name.back_end->name == "plugin" && !isPluginOfFolders(name.which)', "false"),
    lab.Mend("engine/view/viewer/devices/device_control.cpp", "if (device::deviceNamedInFile(device.name).back_end->is_inside) {",
             "if (device::deviceNamedInFile(device.name).back_end != nullptr) {"),
], seconds=60)
def scene_brings_a_plugin(room):
    """A stranger's scene names a library that came with it as the plugin of a device, in three ways of saying where."""
    (room.folder / "evil.c").write_text(EVIL_PLUGIN)
    made = room.run_program("cc", "-shared", "-fPIC", "evil.c", "-o", "evil.so")
    room.start("Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp", log="display.txt")
    display = room.wait_for(lambda: (room.folder / "display.txt").read_text().strip())
    if made.returncode != 0 or not display:
        return lab.broken("no compiler or no X server to try it with")
    environment = dict(os.environ, DISPLAY=f":{display}", HOME=str(room.folder), LIBGL_ALWAYS_SOFTWARE="1")
    environment.pop("PALPATE_DEVICE_PLUGINS", None)
    taken, shown = [], 0
    for words in ("plugin:./evil.so", "plugin:evil.so", f"plugin:{room.folder}/evil.so"):
        (room.folder / "scene.toml").write_text(
            f'[body]\nkind = "back"\n[[device]]\nname = "{words}"\nfinger = "left"\n'
            '[[finger]]\nname = "a"\nat_mm = [0, 0]\nscript = [{ do = "press" }]\n')
        ran = room.run("run", "scene.toml", "--no-state", "--frames", "60", "--verbose", env=environment, seconds=15.0)
        shown += b"frame 60 " in ran.stdout
        if (room.folder / "owned").exists():
            taken.append(words.partition("/")[0])
            (room.folder / "owned").unlink()
    return lab.judged(not taken and shown == 3, f"{shown} of 3 windows were shown; their code ran in {len(taken)}")


def scene_naming(file):
    return f'[[finger]]\nname = "index"\ntrajectory = "{file}"\n'


@lab.attack("bundle_packs_a_key", "files", [
    lab.Mend("engine/cli/recording/bundle_command.cpp", "  refuseFilesOutside(recording, arguments, settings);\n", ""),
    lab.Mend(BUNDLE, "if (const std::vector<fs::path> files = outside(); !files.empty()) {",
             "if (const std::vector<fs::path> files = {}; !files.empty()) {"),
], seconds=20)
def bundle_packs_a_key(room):
    """A stranger's scene names the victim's private key, by its path or by a link, and waits for the bundle."""
    home = room.folder / "home"
    theirs = room.folder / "theirs"
    home.mkdir()
    theirs.mkdir()
    key = home / "id_rsa"
    key.write_text(SECRET)
    (theirs / "path.csv").symlink_to(key)
    packed, codes = [], []
    for name, named in (("path", key), ("link", theirs / "path.csv"), ("relative", "../home/id_rsa")):
        file = recording(room, f"theirs/{name}.session", [["UPDATE worlds SET scene = ?, folder = ?", scene_naming(named), str(theirs)]])
        out = room.folder / f"{name}.out"
        ran = room.run("recording", "bundle", file, "-o", out)
        codes.append(ran.returncode)
        if out.exists() and SECRET.encode() in out.read_bytes():
            packed.append(name)
    asked = room.run("recording", "bundle", theirs / "path.session", "-o", room.folder / "asked.out", "--include", key)
    given = (room.folder / "asked.out").exists() and SECRET.encode() in (room.folder / "asked.out").read_bytes()
    held = not packed and all(code == 2 for code in codes) and given
    return lab.judged(held, f"packed by {packed or 'none'} of 3 ways, exit codes {codes}; with --include "
                            f"{'packed' if given else 'NOT packed'} (exit {asked.returncode})")


HOSTILE_WORDS = "\x1b]0;owned\x07\x1b[2J\x9b31m\x7f\u202egpj.exe\rsafe\nsoftware    forged"


@lab.attack("escapes_for_a_terminal", "files", [
    lab.Mend(READABLE, "  if (letter < 0x20) return letter == '\\t' || letter == '\\n';\n", ""),
], seconds=20)
def escapes_for_a_terminal(room):
    """Notes, names, events and errors of a stranger carry escape sequences for the terminal of whoever looks."""
    recording(room, "a.session", [["UPDATE session SET notes = ?, tags = ?, software = ?", *[HOSTILE_WORDS] * 3],
                                  ["UPDATE fingers SET name = ?, device = ?", *[HOSTILE_WORDS] * 2],
                                  ["INSERT INTO events(tick, kind, text) VALUES (1, ?, ?)", *[HOSTILE_WORDS] * 2]])
    (room.folder / "a.toml").write_text(f'[body]\nkind = "{HOSTILE_WORDS[:6]}"\n\x1b[2J = 1\n')
    broken = room.folder / "a\x1b[2J.session"
    broken.write_text("none")
    bad, bytes_seen = [], 0
    for words in (["recording", "info", "a.session"], ["recording", "list", "."], ["recording", "report", "a.session", "-o", "a.html"], ["simulate", "a.toml"],
                  ["recording", "info", broken], ["recording", "list", ".", "--json"], ["recording", "trim", "a.session", "-o", "b.session", "--json"]):
        ran = room.run(*words, seconds=10.0)
        text = (ran.stdout + ran.stderr).decode("utf-8", "replace")
        bytes_seen += len(text)
        if any((ord(c) < 32 and c not in "\n\t") or 127 <= ord(c) < 160 or c == "\u202e" for c in text) or "\nsoftware    forged" in text:
            bad.append(words[0])
    return lab.judged(not bad and bytes_seen > 500, f"{bytes_seen} characters of 7 commands; escapes in {bad or 'none'}")


@lab.attack("formulas_for_a_spreadsheet", "files", [
    lab.Mend("engine/core/palpate/base/csv.cpp", 'isFormula(text) ? "\'" : ""', 'isFormula(text) ? "" : ""'),
], seconds=30)
def formulas_for_a_spreadsheet(room):
    """Labels and names that begin like a formula go into the tables that a teacher opens in a spreadsheet."""
    formulas = ['=HYPERLINK("http://evil","x")', "=cmd|'/c calc'!A1", "@SUM(1)", "-2+3+cmd|'/c calc'!A1", "+1+1", "\t=1"]
    made = room.run("train", "--trainee", "seed=1", "--fast", "--class", "osteo", "--kind", "pre-test", "--records", "a.results",
                    "--json", seconds=15.0)
    database = sqlite3.connect(room.folder / "a.results")
    database.execute("UPDATE class SET label = ?", [formulas[0]])
    database.execute("UPDATE station SET name = ?, device = ?", formulas[1:3])
    database.execute("UPDATE session SET device = ?, app_version = ?", formulas[3:5])
    database.execute("INSERT INTO event SELECT 'e' || substr(id, 2), id, 0, 'pause', ? FROM session LIMIT 1", [formulas[5]])
    database.commit()
    database.close()
    room.run("train", "results", "export", "a.results", "--csv", "tables", seconds=10.0)
    recording(room, "a.session", [["UPDATE fingers SET name = ?", formulas[1]]])
    room.run("recording", "export", "a.session", "--csv", "tables/forces.csv")
    cells, formulas_seen, numbers = 0, [], 0
    for file in sorted((room.folder / "tables").glob("*.csv")):
        for row in csv.reader(file.open(newline="")):
            for cell in row:
                cells += 1
                try:
                    float(cell)
                    numbers += 1
                except ValueError:
                    if cell[:1] in "=+-@\t\r" and cell:
                        formulas_seen.append(cell)
    held = not formulas_seen and numbers > 1000
    return lab.judged(held, f"{cells} cells, {numbers} of them numbers, {len(formulas_seen)} formulas "
                            f"{formulas_seen[:1]} (records: exit {made.returncode})")


# --- other users of the computer

@lab.attack("links_laid_in_a_shared_folder", "files", [
    lab.Mend(OUTPUT, "  refuseUntrustedLinks(target_);\n", ""),
    lab.Mend("instruments/study/lab/commands/bench_arguments.cpp", 'file_ = folder_->path() / (file_or_name + ".stl");',
             'file_ = std::filesystem::temp_directory_path() / fmt::format("palpate_{}_{}.stl", file_or_name, getpid());'),
], seconds=40)
def links_laid_in_a_shared_folder(room):
    """Somebody lays links where another user's files will be written, to have files of that user replaced."""
    shared = room.folder / "shared"
    shared.mkdir()
    shared.chmod(0o1777)
    victim = room.folder / "victim.txt"
    victim.write_text("precious")
    session = recording(room, "a.session")
    (shared / "out.csv").symlink_to(victim)
    written = room.run("recording", "export", session, "--csv", shared / "out.csv")
    direct = victim.read_bytes() == b"precious"
    # The shell's number becomes the command's: the link is laid under the name that it had until now.
    shell = subprocess.Popen(["sh", "-c", 'echo $$; read go; exec "$0" "$@"', room.palpate, "study", "bench", "load", "torso_5000"],
                             stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=room.folder,
                             env=dict(os.environ, TMPDIR=str(shared)))
    number = int(shell.stdout.readline())
    (shared / f"palpate_torso_5000_{number}.stl").symlink_to(victim)
    try:
        shell.communicate(b"go\n", timeout=min(25.0, room.left()))
    except subprocess.TimeoutExpired:
        shell.kill()
        shell.communicate()
    named = victim.exists() and victim.read_bytes() == b"precious"
    left = [file.name for file in shared.iterdir() if not file.is_symlink()]
    return lab.judged(direct and named and not left and shell.returncode == 0,
                      f"a link as target: exit {written.returncode}, victim {'whole' if direct else 'REPLACED'}; a link under the old "
                      f"name of a temporary mesh: exit {shell.returncode}, victim {'whole' if named else 'REPLACED'}; left: {left or 'nothing'}")


def dome(file):
    """A small closed bump of 200 mm as an OBJ file."""
    lines, across = [], 21
    for i in range(across):
        for j in range(across):
            x, y = 10.0 * i - 100.0, 10.0 * j - 100.0
            lines.append(f"v {x} {y} {max(0.0, 20.0 - (x * x + y * y) / 500.0)}")
    for i in range(across - 1):
        for j in range(across - 1):
            a = i * across + j + 1
            lines += [f"f {a} {a + across} {a + 1}", f"f {a + 1} {a + across} {a + across + 1}"]
    file.write_text("\n".join(lines) + "\n")


def started_server(room, runtime, *more):
    """A running `palpate serve` and its first line; None where it gave none."""
    log = f"serve{time.monotonic_ns()}.txt"
    old = os.umask(0)
    process = room.start(room.palpate, "serve", "dome.obj", "--port", "0", "--json", *more, log=log,
                         env=dict(os.environ, XDG_RUNTIME_DIR=str(runtime)))
    os.umask(old)

    def first_line():
        text = (room.folder / log).read_text()
        return json.loads(text.splitlines()[0]) if '"serving"' in text and "\n" in text else None
    return process, room.wait_for(first_line, 12.0)


@lab.attack("reading_what_runs", "files", [
    lab.Mend(WRITER, "    : file_(file, OutputFile::Unfinished::remove, OutputFile::Access::owner_only),", "    : file_(file),"),
    lab.Mend("instruments/teach/palpate/training/trainee/trainee_course.cpp",
             "makePrivateFolder(settings.recording.parent_path(), ExistingFolder::closed);",
             "std::filesystem::create_directories(settings.recording.parent_path());"),
    lab.Mend("engine/host/palpate/base/system/files_posix.cpp", "constexpr mode_t kOwnersFile = 0600;", "constexpr mode_t kOwnersFile = 0666;"),
], seconds=40)
def reading_what_runs(room):
    """Another user reads a session, records, keys and tokens while they are written, at any moment (umask 0)."""
    dome(room.folder / "dome.obj")
    runtime = room.folder / "runtime"
    runtime.mkdir(mode=0o700)
    private = room.folder / "records"
    private.mkdir()
    watched = [Modes(private), Modes(runtime)]
    for watch in watched:
        watch.start()
    process, line = started_server(room, runtime, "--record", "records/run.session")
    room.wait_for(lambda: (private / "run.session.partial-wal").exists(), 5.0)
    old = os.umask(0)
    trained = room.start(room.palpate, "train", "--trainee", "seed=1", "--records", "records/new/a.results", "--kind", "pre-test",
                         log="train.txt", env=dict(os.environ, HOME=str(room.folder)))
    os.umask(old)
    room.wait_for(lambda: list((private / "new").glob("sessions/*-wal")), 15.0)
    time.sleep(0.5)
    for one in (process, trained):
        if one and one.poll() is None:
            os.killpg(one.pid, signal.SIGKILL)
            one.wait()
    seen = set().union(*(watch.end().seen for watch in watched))
    exposed = sorted(set().union(*(watch.open for watch in watched)))
    kinds = [ending for ending in (".partial", ".partial-wal", ".results", "sessions", ".json") if any(n.endswith(ending) for n in seen)]
    return lab.judged(line and not exposed and len(kinds) == 5,
                      f"{sum(watch.looks for watch in watched)} looks at {len(seen)} names ({', '.join(kinds)}): open to others: "
                      f"{exposed[:4] or 'none'}")


@lab.attack("tokens_of_the_dead", "files", [
    lab.Mend(ACCESS, "    if (isOfDeadServer(", "    if (folder.empty() && isOfDeadServer("),
    lab.Mend("engine/host/palpate/base/private_folder.cpp", "  requirePrivateFolder(folder);\n  return folder;", "  return folder;"),
], seconds=40)
def tokens_of_the_dead(room):
    """The token file of a server that was killed stays for whoever finds it; a folder is laid where it will be written."""
    dome(room.folder / "dome.obj")
    runtime = room.folder / "runtime"
    runtime.mkdir(mode=0o700)
    first, line = started_server(room, runtime)
    if not line:
        return lab.broken("the server did not start")
    tokens = pathlib.Path(line["token_file"])
    mode, folder_mode = mode_of(tokens), mode_of(tokens.parent)
    os.killpg(first.pid, signal.SIGKILL)
    first.wait()
    stays = tokens.exists()
    second, again = started_server(room, runtime)
    gone = not tokens.exists() and again and pathlib.Path(again["token_file"]).exists()
    second.terminate()
    second.wait()
    squatted = room.folder / "squatted"
    squatted.mkdir(mode=0o700)
    (squatted / "palpate").mkdir()
    (squatted / "palpate").chmod(0o777)
    third, taken = started_server(room, squatted)
    refused = not taken and third.poll() == 2
    held = mode == 0o600 and folder_mode == 0o700 and stays and gone and refused
    return lab.judged(held, f"token file {mode:o} in a folder {folder_mode:o}; after kill -9 {'there' if stays else 'gone'}, at the next start "
                            f"{'gone' if gone else 'STILL THERE'}; an open folder in its place {'refused' if refused else 'TAKEN'}")


@lab.attack("limit_on_a_files_size", "files", [
    lab.Mend("engine/cli/kit/command_line.cpp", "  system::makeFailedWritesErrors();\n", "")], seconds=60)
def size_limit(room):
    """A folder in which files may not grow: a run is to say so and leave the earlier file, not to be killed in a write."""
    (room.folder / "felt").mkdir()
    earlier = room.folder / "felt" / "forces.csv"
    earlier.write_text("earlier\n")
    limited = ["sh", "-c", 'ulimit -f 1; exec "$@"', "sh", room.palpate]
    run = room.run_program(*limited, "simulate", "--seconds", "0.5", "--no-pictures", "--no-plot", "--overwrite", "--out", "felt", seconds=30.0)
    words = run.stderr.decode(errors="replace").strip().splitlines()
    told = run.returncode == 2 and words and "cannot be written: File too large" in words[-1]
    left = [file.name for file in (room.folder / "felt").iterdir() if file.suffix == ".partial"]
    return lab.judged(told and not left and earlier.read_text() == "earlier\n",
                      f"exit code {run.returncode}, {words[-1][:80] if words else 'no word'}, left {left}")
