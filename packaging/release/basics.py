"""What every maker of an artefact stands on: the release itself, and commands that fail in one line."""
import os
import pathlib
import subprocess
import sys
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable  # the one that the module is built for


@dataclass
class Release:
    out: pathlib.Path
    build: pathlib.Path  # of this machine; those of other systems lie beside it
    site: pathlib.Path
    version: str
    epoch: int
    key: pathlib.Path | None


class Missing(Exception):
    """Something is not built or not installed; said in one line."""


def run(*command, **options) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise Missing(f"{' '.join(map(str, command[:4]))}: {(done.stderr or done.stdout).strip()[-1500:]}")
    return done.stdout


def wanted(file: pathlib.Path, how: str) -> pathlib.Path:
    if not file.exists():
        raise Missing(f"{file} is not there: {how}")
    return file
