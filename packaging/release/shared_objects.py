"""Shared libraries that bring along what they load: copies under names of their own, found from where they lie, so that neither
the system's versions nor those of another program are met. What every Linux has is left to it. Files may be of another processor."""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
from dataclasses import dataclass

from release.basics import Missing

# Of glibc and the compiler: older than the newest symbol asked of them means "cannot be used", whatever is brought along.
OF_THE_SYSTEM = re.compile(r"^(linux-vdso|ld-linux-x86-64|ld-linux-aarch64|lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+))\.so")
# What draws is the driver's, and a driver loads its own Xlib and expat: a second Xlib in the same program would not know the first
# one's display.
OF_A_DESKTOP = re.compile(OF_THE_SYSTEM.pattern + r"|^lib(X\w+|xcb(-\w+)?|GL|GLX|EGL|OpenGL|GLdispatch|expat)\.so")


@dataclass(frozen=True)
class System:
    """Whose libraries are brought along, and which of them are left to it."""
    root: pathlib.Path = pathlib.Path("/")  # another one: Debian packages of another processor, unpacked
    multiarch: str = "x86_64-linux-gnu"
    strip: str = "strip"
    left: re.Pattern = OF_THE_SYSTEM

    def places(self, file) -> dict:
        """Name -> file of everything that the loader takes for it."""
        if self.root == pathlib.Path("/"):
            return dict(re.findall(r"(?m)^\s*(\S+) => (/\S+)", out("ldd", file)))
        return {one.name: one for folder in ("usr/lib", "lib") for one in (self.root / folder / self.multiarch).glob("*.so.*")}

    def stripped(self, file: pathlib.Path) -> None:
        out(self.strip, "--strip-unneeded", file)


def out(*command) -> str:
    try:
        return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout
    except FileNotFoundError as error:
        raise Missing(f"{command[0]} is not installed (tools/install-dependencies --platforms)") from error
    except subprocess.CalledProcessError as error:
        raise Missing(f"{' '.join(map(str, command))}: {error.stderr.strip()[-500:]}") from error


def needed(file) -> list:
    return re.findall(r"NEEDED\s+(\S+)", out("objdump", "-p", file))


def newest_symbol(files, family: str) -> tuple:
    """(2, 34) when GLIBC_2.34 is the newest that any of the files asks for."""
    versions = {(0,)}
    for file in files:
        for version in re.findall(rf"\b{family}_(\d+(?:\.\d+)+)\b", out("objdump", "-T", file)):
            versions.add(tuple(map(int, version.split("."))))
    return max(versions)


def renamed(name: str, file: pathlib.Path) -> str:
    """libfmt.so.9 -> libfmt-1a2b3c4d.so.9"""
    digest = hashlib.sha256(file.read_bytes()).hexdigest()[:8]
    stem, rest = name.split(".so", 1)
    return f"{stem}-{digest}.so{rest}"


def renamed_flat(name: str, file: pathlib.Path) -> str:
    """libfmt.so.9 -> libfmt-9-1a2b3c4d.so, for those who know a library by the end of its name."""
    stem, rest = renamed(name, file).split(".so", 1)
    head, digest = stem.rsplit("-", 1)
    return f"{head}{rest.replace('.', '-')}-{digest}.so"


def gather(file, system: System) -> dict:
    """Name -> file of all libraries to bring along for `file`, those of those included."""
    found, known = {}, system.places(file)
    waiting = needed(file)
    while waiting:
        name = waiting.pop()
        if system.left.match(name) or name in found:
            continue
        if name not in known:
            raise Missing(f"{file} loads {name}, which {system.root} does not have")
        found[name] = pathlib.Path(known[name]).resolve()
        waiting += needed(found[name])
    return found


def self_contained(files: list, libraries: pathlib.Path, system: System = System(), name_of=renamed) -> list:
    """Brings what `files` load into the folder `libraries` and makes them find it. Gives what was brought: (name, its source)."""
    brought = {}
    for file in files:
        brought |= gather(file, system)
    names = {name: name_of(name, source) for name, source in brought.items()}
    libraries.mkdir(parents=True, exist_ok=True)
    copies = []
    for name, source in sorted(brought.items()):
        copy = libraries / names[name]
        shutil.copyfile(source, copy)
        copy.chmod(0o755)
        out("patchelf", "--set-soname", copy.name, "--set-rpath", "$ORIGIN", copy)
        copies.append(copy)
    for file in [*files, *copies]:
        ours = [name for name in needed(file) if name in names]
        for name in ours:
            out("patchelf", "--replace-needed", name, names[name], file)
        if file not in copies and ours:
            way = os.path.relpath(libraries, file.parent)
            out("patchelf", "--set-rpath", "$ORIGIN" if way == "." else f"$ORIGIN/{way}", file)
    return sorted(brought.items())
