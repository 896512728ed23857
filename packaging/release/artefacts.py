"""What a release is made of: one function an artefact, each writes into the folder it is given."""
import base64
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from dataclasses import dataclass

from release import archives, notes, shared_objects

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable  # the one that the module is built for


@dataclass
class Release:
    out: pathlib.Path
    build: pathlib.Path
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


def stripped(file: pathlib.Path) -> None:
    run("strip", "--strip-unneeded", file)


# ---- text


def make_notes(release: Release) -> None:
    text = notes.cut((ROOT / "CHANGELOG.md").read_text(), release.version)
    (release.out / f"palpate-{release.version}.md").write_text(text)


def make_bits(release: Release) -> None:
    """Hashes of bodies, forces and skins that tools/check-platforms finds on every platform."""
    shutil.copyfile(ROOT / "tests/platforms/kept.jsonl", release.out / f"palpate-{release.version}-bits.jsonl")


def make_sbom(release: Release) -> None:
    targets = ["palpate_c", "palpate_command", "palpate_python_core", "palpate_python_view"]
    run(ROOT / "tools/sbom", "--build", release.build, "--out", release.out / f"palpate-{release.version}.spdx.json", *targets,
        env=os.environ | {"SOURCE_DATE_EPOCH": str(release.epoch)})


# ---- sources


def make_source(release: Release) -> None:
    name = f"palpate-{release.version}"
    (release.out / f"{name}-source.tar.gz").write_bytes(archives.packed(archives.commit(ROOT, name)))


# What building the Python package does not read.
NOT_IN_SDIST = re.compile(r"^(docs|tests|dissertation|lab|teach|report|web|examples|results|\.ci|\.github|cli)/|/(tests|pictures)/")


def sdist_tree(release: Release, folder: pathlib.Path) -> pathlib.Path:
    """The source distribution unpacked: the sources with setup.py and pyproject.toml at the top."""
    name = f"palpate-{release.version}"
    raw = folder / "commit.tar"
    raw.write_bytes(archives.commit(ROOT, name))
    with tarfile.open(raw) as tar:
        members = [m for m in tar if m.isfile() and not NOT_IN_SDIST.search(m.name.split("/", 1)[1])]
        tar.extractall(folder, members)
    raw.unlink()
    tree = folder / name
    for file in ("setup.py", "pyproject.toml", "README.md"):
        shutil.move(tree / "bindings/python" / file, tree / file)
    run(PYTHON, "setup.py", "-q", "egg_info", "--egg-base", folder, cwd=tree, env=os.environ | {"PALPATE_STAGED": "/nonexistent"})
    shutil.move(folder / "palpate.egg-info/PKG-INFO", tree / "PKG-INFO")
    shutil.rmtree(folder / "palpate.egg-info")
    return tree


def make_sdist(release: Release) -> None:
    with tempfile.TemporaryDirectory() as folder:
        tree = sdist_tree(release, pathlib.Path(folder))
        archives.tar_gz(release.out / f"{tree.name}.tar.gz", tree, tree.name, release.epoch)


# ---- npm


def make_npm(release: Release) -> None:
    wanted(release.site / "palpate.wasm", "tools/build-web makes it")
    with tempfile.TemporaryDirectory() as folder:
        package = pathlib.Path(folder) / "package"
        shutil.copytree(ROOT / "packaging/npm", package)
        shutil.copytree(release.site, package / "site")
        shutil.copyfile(ROOT / "LICENSE", package / "LICENSE")
        about = json.loads((package / "package.json").read_text())
        about["version"] = release.version
        (package / "package.json").write_text(json.dumps(about, indent=2) + "\n")
        archives.tar_gz(release.out / f"palpate-{release.version}.tgz", package, "package", release.epoch)


# ---- Debian


def make_deb(release: Release) -> None:
    folder = release.out / "deb"
    run(ROOT / "tools/package", "--no-build", "--untried", "--out", folder, env=os.environ | {"SOURCE_DATE_EPOCH": str(release.epoch)})
    for package in folder.glob("*.deb"):
        package.rename(release.out / package.name)
    shutil.rmtree(folder)


# ---- the C library


CONFIG = """# palpate::c, the C interface of Palpate, with everything that it loads beside it.
get_filename_component(palpate_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET palpate::c)
  add_library(palpate::c SHARED IMPORTED)
  set_target_properties(palpate::c PROPERTIES IMPORTED_LOCATION "${palpate_prefix}/lib/libpalpate.so.0"
                        IMPORTED_SONAME libpalpate.so.0 INTERFACE_INCLUDE_DIRECTORIES "${palpate_prefix}/include")
endif()
unset(palpate_prefix)
"""
CONFIG_VERSION = """set(PACKAGE_VERSION "@VERSION@")
string(REGEX MATCH "^[0-9]+\\\\.[0-9]+" palpate_own "${PACKAGE_VERSION}")
string(REGEX MATCH "^[0-9]+\\\\.[0-9]+" palpate_asked "${PACKAGE_FIND_VERSION}")
if(palpate_own STREQUAL palpate_asked AND NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
"""
C_README = """Palpate {version}: the C library for Linux on x86-64, glibc {glibc} or later (Debian 12, Ubuntu 22.04, ...)

  export PKG_CONFIG_PATH=$PWD/lib/pkgconfig
  cc -ffp-contract=off examples/touch.c $(pkg-config --cflags --libs palpate) -Wl,-rpath,$PWD/lib -o touch && ./touch

With CMake: find_package(palpate_c {version}), target palpate::c, CMAKE_PREFIX_PATH=$PWD. C# and Unity: share/palpate/csharp.
The folder may lie anywhere. lib/palpate holds what the library loads, under names of its own; licences are in share/licenses.
"""


def make_c(release: Release) -> None:
    built = release.build / "bindings/c"
    name = f"palpate-c-{release.version}-linux-x86_64"
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / name
        for part in ("include", "lib/pkgconfig", "lib/cmake/palpate_c", "share/palpate/csharp", "share/licenses", "examples"):
            (tree / part).mkdir(parents=True)
        library = tree / "lib" / f"libpalpate.so.{release.version}"
        shutil.copyfile(wanted(built / library.name, "ninja -C build/release palpate_c"), library)
        library.chmod(0o755)
        stripped(library)
        brought = shared_objects.self_contained([library], tree / "lib/palpate")
        shared_objects.licences(brought, tree / "share/licenses")
        (tree / "lib/libpalpate.so.0").symlink_to(library.name)
        (tree / "lib/libpalpate.so").symlink_to("libpalpate.so.0")
        shutil.copyfile(ROOT / "LICENSE", tree / "share/licenses/palpate")
        shutil.copyfile(ROOT / "bindings/c/palpate.h", tree / "include/palpate.h")
        shutil.copyfile(ROOT / "bindings/c/samples/Palpate.cs", tree / "share/palpate/csharp/Palpate.cs")
        pc = (ROOT / "bindings/c/palpate.pc.in").read_text()
        for key, value in (("CMAKE_INSTALL_LIBDIR", "lib"), ("CMAKE_INSTALL_INCLUDEDIR", "include"), ("PROJECT_VERSION", release.version),
                           ("PROJECT_DESCRIPTION", "Haptic palpation: feel, see and measure touch on a soft body")):
            pc = pc.replace(f"@{key}@", value)
        (tree / "lib/pkgconfig/palpate.pc").write_text(pc)
        (tree / "lib/cmake/palpate_c/palpate_c-config.cmake").write_text(CONFIG)
        (tree / "lib/cmake/palpate_c/palpate_c-config-version.cmake").write_text(CONFIG_VERSION.replace("@VERSION@", release.version))
        for example in ("touch.c", "CMakeLists.txt"):
            shutil.copyfile(HERE / "first" / example, tree / "examples" / example)
        glibc = shared_objects.newest_symbol([library, *(tree / "lib/palpate").glob("*.so*")], "GLIBC")
        (tree / "README").write_text(C_README.format(version=release.version, glibc=".".join(map(str, glibc))))
        archives.tar_gz(release.out / f"{name}.tar.gz", tree, name, release.epoch)


# ---- the wheel


def record_row(file: pathlib.Path, name: str) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{file.stat().st_size}"


def make_wheel(release: Release) -> None:
    """The staged package, with what it loads beside it. palpate.measure is left out: OpenCV's codecs load 130 libraries."""
    staged = wanted(release.build / "python", "ninja -C build/release palpate_python")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        tree = sdist_tree(release, folder)
        run(PYTHON, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--no-index", "-w", folder / "plain", tree,
            env=os.environ | {"PALPATE_STAGED": str(staged), "SOURCE_DATE_EPOCH": str(release.epoch)})
        plain = next((folder / "plain").glob("*.whl"))
        unpacked = folder / "unpacked"
        run(PYTHON, "-m", "zipfile", "-e", plain, unpacked)
        package = unpacked / "palpate"
        for file in package.glob("_measure.*.so"):
            file.unlink()
        modules = sorted(package.glob("*.so"))
        brought = shared_objects.self_contained(modules, unpacked / "palpate.libs")
        info = next(unpacked.glob("*.dist-info"))
        shared_objects.licences(brought, info / "licenses")
        shutil.copyfile(ROOT / "LICENSE", info / "licenses/LICENSE")
        files = [*modules, *(unpacked / "palpate.libs").iterdir()]
        glibc = shared_objects.newest_symbol(files, "GLIBC")
        python, abi, _ = re.search(r"-(cp\d+)-(\w+)-(\w+)\.whl$", plain.name).groups()
        tag = f"{python}-{abi}-manylinux_{glibc[0]}_{glibc[1]}_x86_64"
        (info / "WHEEL").write_text(re.sub(r"(?m)^Tag: .*$", f"Tag: {tag}", (info / "WHEEL").read_text()))
        names = sorted(str(f.relative_to(unpacked)) for f in unpacked.rglob("*") if f.is_file() and f.name != "RECORD")
        record = f"{info.name}/RECORD"
        rows = [record_row(unpacked / name, name) for name in names] + [f"{record},,"]
        (unpacked / record).write_text("\n".join(rows) + "\n")
        archives.zip_of(release.out / f"palpate-{release.version}-{tag}.whl", unpacked, [*names, record], release.epoch)


# ---- what binds them


MAKERS = {"notes": make_notes, "source": make_source, "npm": make_npm, "deb": make_deb, "sdist": make_sdist, "wheel": make_wheel,
          "c": make_c, "sbom": make_sbom, "bits": make_bits}


def bind(release: Release) -> None:
    """verify, sums and signature."""
    shutil.copyfile(HERE / "verify", release.out / "verify")
    (release.out / "verify").chmod(0o755)
    files = sorted(file for file in release.out.iterdir() if not file.name.startswith("SHA256SUMS"))
    (release.out / "SHA256SUMS").write_text("".join(f"{archives.sha256(file)}  {file.name}\n" for file in files))
    if release.key:
        if shutil.which("minisign") is None:
            raise Missing("minisign is not installed (tools/install-dependencies --tests)")
        # The comment would hold the time; a fixed one makes the signature the same every time.
        run("minisign", "-S", "-s", release.key, "-m", release.out / "SHA256SUMS", "-c", f"Palpate {release.version}", "-t",
            f"Palpate {release.version}", stdin=subprocess.DEVNULL if is_open(release.key) else None)


def is_open(key: pathlib.Path) -> bool:
    """A key without a password: a test's. Bytes 2 and 3 name how a password becomes a key."""
    return base64.b64decode(key.read_text().splitlines()[1])[2:4] == b"\0\0"
