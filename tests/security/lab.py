"""What an attack on the built command is written with: a folder of its own, processes that end with it, free ports, and
the list that `tools/check-security` runs. An attack shares no code with what it attacks; it speaks the protocol itself."""
import contextlib
import dataclasses
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ATTACKS = []


@dataclasses.dataclass(frozen=True)
class Mend:
    """One piece of a defence and how to take it out: `old` stands exactly once in `file` and becomes `new`."""
    file: str
    old: str
    new: str


@dataclasses.dataclass(frozen=True)
class Outcome:
    held: bool
    seen: str  # one line: what was observed, with its numbers


@dataclasses.dataclass(frozen=True)
class Attack:
    name: str
    area: str
    about: str
    mends: tuple
    run: object
    seconds: float
    target: str


def held(seen):
    return Outcome(True, seen)


def broken(seen):
    return Outcome(False, seen)


def judged(is_held, seen):
    return Outcome(bool(is_held), seen)


def attack(name, area, mends, seconds=30.0, target="palpate_command"):
    """Registers a function of a Lab that returns an Outcome. Its first line of documentation says what is tried.

    mends: what to take out so that the attack must succeed (`--self-test`). seconds: its limit; an attack that runs
    past it counts as failed. target: what is built again after the mends were taken out."""
    def register(function):
        about = (function.__doc__ or "").strip().splitlines()[0]
        ATTACKS.append(Attack(name, area, about, tuple(mends), function, seconds, target))
        return function
    return register


class Lab:
    """One attack's surroundings: everything in it ends with it."""

    def __init__(self, palpate, seconds):
        self.palpate = str(palpate)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="palpate-security-"))
        self.deadline = time.monotonic() + seconds
        self._processes = []

    def left(self):
        """Seconds until this attack's limit, at least a tenth."""
        return max(0.1, self.deadline - time.monotonic())

    def run(self, *words, seconds=10.0, **options):
        """Runs `palpate WORDS...` to its end. A result with returncode None was still running after `seconds` and was killed."""
        return self.run_program(self.palpate, *words, seconds=seconds, **options)

    def run_program(self, *command, seconds=10.0, env=None, stdin=None, cwd=None):
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   stdin=subprocess.PIPE if stdin is not None else subprocess.DEVNULL, env=env,
                                   cwd=cwd or self.folder, start_new_session=True)
        try:
            out, err = process.communicate(stdin, timeout=min(seconds, self.left()))
            return subprocess.CompletedProcess(command, process.returncode, out, err)
        except subprocess.TimeoutExpired:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            out, err = process.communicate()
            return subprocess.CompletedProcess(command, None, out, err)

    def start(self, *command, log="log.txt", env=None):
        """Starts a program that runs until the attack ends; its output goes to `log` in the folder."""
        with open(self.folder / log, "ab") as out:
            process = subprocess.Popen([str(word) for word in command], stdout=out, stderr=out, stdin=subprocess.DEVNULL,
                                       env=env, cwd=self.folder, start_new_session=True)
        self._processes.append(process)
        return process

    def wait_for(self, condition, seconds=10.0, step_s=0.05):
        """The first true value of condition(), or None after `seconds`."""
        end = time.monotonic() + min(seconds, self.left())
        while time.monotonic() < end:
            value = condition()
            if value:
                return value
            time.sleep(step_s)
        return None

    @staticmethod
    def free_port(kind=socket.SOCK_STREAM):
        with socket.socket(socket.AF_INET, kind) as probe:
            probe.bind(("127.0.0.1", 0))
            return probe.getsockname()[1]

    def close(self):
        for process in self._processes:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
