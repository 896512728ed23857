"""The licences of what a binary holds of others: of the libraries that are brought along, and of the headers and archives that
were compiled in. The build itself is asked for these (ninja -t deps, -t inputs)."""
import pathlib
import re
import shutil
import subprocess

from release.basics import ROOT, Missing, run
from release.shared_objects import System

# The compiler and the C library: their exceptions leave what they compile free.
OF_THE_COMPILER = re.compile(r"^(lib(c6|stdc\+\+|gcc)\b.*-dev.*|lib(stdc\+\+|gcc)-\d+-dev|linux-libc-dev.*|(g\+\+|gcc|cpp)\b.*)$")
LIBRARIES = ROOT / "build/libraries"
# What lies below include/ and lib/ of the libraries of tools/platform-libraries: Debian's package, and for Windows the file
# of the sources that were compiled.
PACKAGES = {"boost": "libboost1.74-dev", "eigen3": "libeigen3-dev", "toml++": "libtomlplusplus-dev", "nlohmann": "nlohmann-json3-dev",
            "CLI": "libcli11-dev", "fmt": "libfmt-dev", "hwy": "libhwy-dev", "sqlite3.h": "libsqlite3-dev", "zlib.h": "zlib1g-dev", "zconf.h": "zlib1g-dev", "stb": "libstb-dev"}
SOURCES = {"fmt": "apt/source/fmtlib/LICENSE.rst", "libfmt.a": "apt/source/fmtlib/LICENSE.rst", "hwy": "apt/source/highway/LICENSE",
           "libhwy.a": "apt/source/highway/LICENSE", "sqlite3.h": "apt/source/sqlite3/LICENSE.md", "libsqlite3.a": "apt/source/sqlite3/LICENSE.md",
           **dict.fromkeys(("GLFW", "libglfw3.a"), "apt/source/glfw3/LICENSE.md"), **dict.fromkeys(("imgui", "libimgui.a"), "apt/source/imgui/LICENSE.txt"),
           **dict.fromkeys(("epoxy", "libepoxy.dll.a"), "apt/source/libepoxy/COPYING"),
           **dict.fromkeys(("minizip", "libminizip.a"), "apt/source/minizip/MiniZip64_info.txt"),
           **dict.fromkeys(("openssl", "libssl.a", "libcrypto.a"), "apt/source/openssl/LICENSE.txt"),
           **dict.fromkeys(("zlib.h", "zconf.h", "libz.a"), "zlib/usr/share/doc/libz-mingw-w64-dev/copyright")}


def compiled_in(build: pathlib.Path, target: str, below: pathlib.Path) -> list:
    """Headers and archives under the folder `below` that went into a target."""
    inputs = set(run("ninja", "-C", build, "-t", "inputs", target).splitlines())
    files = {file for file in inputs if file.endswith(".a")}
    take = False
    for line in run("ninja", "-C", build, "-t", "deps").splitlines():
        if not line.startswith(" "):
            take = line.split(":")[0] in inputs
        elif take:
            files.add(line.strip())
    whole = {pathlib.Path(*(build / file).parts) for file in files}
    normal = {pathlib.Path(re.sub(r"/[^/]+/\.\.(?=/)", "", str(file))) for file in whole}
    return sorted(file for file in normal if file.is_relative_to(below))


def kept(folder: pathlib.Path, name: str, file: pathlib.Path) -> None:
    if not file.exists():
        raise Missing(f"the licence of {name} is not in {file}")
    shutil.copyfile(file, folder / f"{name}.copyright")


def owners(files) -> set:
    """Packages of this machine. They may name a file of /usr/lib by the /lib of old."""
    names = sorted({spelled for file in files for spelled in (str(file), str(file).removeprefix("/usr"))})
    found = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True).stdout
    owned = {line.rsplit(": ", 1)[1]: line.split(":")[0] for line in found.splitlines()}
    lost = [file for file in files if str(file) not in owned and str(file).removeprefix("/usr") not in owned]
    if lost:
        raise Missing(f"{lost[0]} is of no package")
    return set(owned.values())


def package_named(library: str) -> str:
    """As Debian names the package of a library: libfmt.so.9 -> libfmt9, libsqlite3.so.0 -> libsqlite3-0."""
    stem, version = library.split(".so.")
    if stem == "libz":
        return "zlib1g"
    return f"{stem}{'-' if stem[-1].isdigit() else ''}{version}"


def of_this_machine(folder: pathlib.Path, brought: list, build: pathlib.Path, targets: list) -> None:
    headers = [file for target in targets for file in compiled_in(build, target, pathlib.Path("/usr"))]
    for package in owners([source for _, source in brought]) | {name for name in owners(headers) if not OF_THE_COMPILER.match(name)}:
        kept(folder, package, pathlib.Path("/usr/share/doc") / package / "copyright")


def of_headers(folder: pathlib.Path, headers: pathlib.Path) -> None:
    """Of what tools/other-python fetched."""
    for file in (headers / "licences").iterdir():
        shutil.copyfile(file, folder / file.name)


def of_packages(folder: pathlib.Path, brought: list, build: pathlib.Path, target: str, system: System) -> None:
    """Of Debian packages that are unpacked in system.root."""
    packages = {package_named(name) for name, _ in brought}
    include = system.root / "usr/include"
    for file in compiled_in(build, target, include):
        parts = file.relative_to(include).parts
        parts = parts[1:] if parts[0] == system.multiarch else parts
        if not pathlib.Path("/usr/aarch64-linux-gnu/include", *parts).exists():  # the C library's, which the cross compiler has, too
            packages.add(known(PACKAGES, parts[0]))
    for package in packages:
        kept(folder, package, system.root / "usr/share/doc" / package / "copyright")


def of_windows(folder: pathlib.Path, build: pathlib.Path, target: str) -> None:
    """Everything is linked in, the compiler's own libraries, too."""
    for file in compiled_in(build, target, LIBRARIES / "win64"):
        top = file.relative_to(LIBRARIES / "win64").parts[1]
        if top in SOURCES:
            licence = LIBRARIES / SOURCES[top]
            kept(folder, SOURCES[top].split("/")[-2], licence)
        else:
            package = known(PACKAGES, top)
            kept(folder, package, LIBRARIES / "headers/usr/share/doc" / package / "copyright")
    for package in ("gcc-mingw-w64-base", "mingw-w64-x86-64-dev"):
        kept(folder, package, pathlib.Path("/usr/share/doc") / package / "copyright")


def known(table: dict, top: str) -> str:
    if top not in table:
        raise Missing(f"whose is {top}? packaging/release/licences.py does not know its licence")
    return table[top]
