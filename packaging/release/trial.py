"""What every trial stands on: an environment without anything of this machine, commands that fail in one line, the kept forces."""
import json
import pathlib
import re
import subprocess
import tarfile

from release import shared_objects
from release.basics import HERE

KEPT = json.loads((HERE / "first/kept.json").read_text())
TEST_KEY = HERE / "test_key/test.pub"
# Nothing of this machine's setup: neither its folders of modules nor its libraries.
CLEAN = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": "/nonexistent", "LC_ALL": "C.UTF-8"}


class Failed(Exception):
    pass


class Skipped(Exception):
    pass


def run(*command, **options) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **({"env": CLEAN} | options))
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command[:5]))}: exit code {done.returncode}: {(done.stderr or done.stdout).strip()[-1200:]}")
    return done.stdout


def the(folder: pathlib.Path, pattern: str) -> pathlib.Path:
    found = sorted(folder.glob(pattern))
    if not found:
        raise Skipped(f"there is no {pattern}")
    return found[0]


def felt(text: str, which: str) -> str:
    """The line of forces must be the kept one."""
    lines = [line for line in text.splitlines() if "force" in line]
    if not lines or lines[-1] != KEPT[which]:
        raise Failed(f"felt {lines[-1:]}; kept is {KEPT[which]}")
    return "the kept forces"


def unpacked(archive: pathlib.Path, work: pathlib.Path) -> pathlib.Path:
    """The folder that it holds."""
    with tarfile.open(archive) as tar:
        tar.extractall(work)
    return work / archive.name.removesuffix(".tar.gz")


def only_the_system(files, work: pathlib.Path, left: re.Pattern = shared_objects.OF_THE_SYSTEM) -> None:
    """What the loader takes lies in `work`, or is the system's; what that loads itself is its own affair."""
    for file in files:
        if file.is_symlink():
            continue
        found = dict(re.findall(r"(?m)^\s*(\S+) => (.+?)(?: \(|$)", run("ldd", file)))
        for name in shared_objects.needed(file):
            if not left.match(name) and str(work.resolve()) not in found.get(name, "not found"):
                raise Failed(f"{file.name} loads {name}: {found.get(name, 'not found')}")
