"""Shared libraries that bring along what they load: copies under names of their own, found from where they lie, so that neither
the system's versions nor those of another program are met. What every Linux has is left to it."""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess

# Of glibc and the compiler: older than the newest symbol asked of them means "cannot be used", whatever is brought along.
OF_THE_SYSTEM = re.compile(r"^(linux-vdso|ld-linux-x86-64|lib(c|m|dl|rt|pthread|resolv|util|gcc_s|stdc\+\+))\.so")


def out(*command) -> str:
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def needed(file) -> list:
    return re.findall(r"NEEDED\s+(\S+)", out("objdump", "-p", file))


def places(file) -> dict:
    """Name -> file of everything that the loader takes for it."""
    return dict(re.findall(r"(?m)^\s*(\S+) => (/\S+)", out("ldd", file)))


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


def gather(file) -> dict:
    """Name -> file of all libraries to bring along for `file`, those of those included."""
    found, known = {}, places(file)
    waiting = needed(file)
    while waiting:
        name = waiting.pop()
        if OF_THE_SYSTEM.match(name) or name in found:
            continue
        found[name] = pathlib.Path(known[name]).resolve()
        waiting += needed(found[name])
    return found


def self_contained(files: list, libraries: pathlib.Path) -> list:
    """Brings what `files` load into the folder `libraries` and makes them find it. Gives what was brought: (name, its source)."""
    brought = {}
    for file in files:
        brought |= gather(file)
    names = {name: renamed(name, source) for name, source in brought.items()}
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
            out("patchelf", "--set-rpath", "$ORIGIN/" + os.path.relpath(libraries, file.parent), file)
    return sorted(brought.items())


def package_of(file: pathlib.Path) -> str:
    """Packages may name a file of /usr/lib by the /lib of old."""
    for name in (str(file), str(file).removeprefix("/usr")):
        found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    raise SystemExit(f"release: {file} is of no package")


def licences(brought: list, folder: pathlib.Path) -> None:
    """The copyright file of each library's package."""
    folder.mkdir(parents=True, exist_ok=True)
    for _, source in brought:
        package = package_of(source)
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", folder / f"{package}.copyright")
