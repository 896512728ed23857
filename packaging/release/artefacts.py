"""What a release is made of: one function an artefact, each writes into the folder it is given."""
import base64
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import tempfile

from release import archives, c_library, licences, notes, portable, shared_objects, unity, windows
from release.basics import HERE, PYTHON, ROOT, Missing, Release, run, wanted


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
NOT_IN_SDIST = re.compile(
    r"^(docs|tests|results|\.ci|\.github|examples(?!/scenes/)|packaging/debian|engine/(cli|web)|instruments/(report|teach|study/(dissertation|lab)))/"
    r"|/(tests|pictures)/")


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
        shutil.move(tree / "engine/bindings/python" / file, tree / file)
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


# ---- the wheel


def record_row(file: pathlib.Path, name: str) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{file.stat().st_size}"


def make_wheel(release: Release) -> None:
    """For the Python of this machine."""
    staged = wanted(release.build / "python", "ninja -C build/release palpate_python")
    pack_wheel(release, staged, ["palpate_python_core", "palpate_python_view"])


def make_wheel_of(python: str):
    """For another one, of which tools/other-python builds the modules; the files in Python are the same."""
    number = python.replace(".", "")

    def make(release: Release) -> None:
        modules = wanted(release.build / f"python-{python}/palpate", f"tools/other-python {python}")
        with tempfile.TemporaryDirectory() as folder:
            staged = pathlib.Path(folder) / "palpate"
            shutil.copytree(release.build / "python/palpate", staged, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
            for module in modules.glob("*.so"):
                shutil.copyfile(module, staged / module.name)
            pack_wheel(release, staged.parent, [f"palpate_python_core_{number}", f"palpate_python_view_{number}"], f"cp{number}")

    return make


def pack_wheel(release: Release, staged: pathlib.Path, targets: list, other: str = "") -> None:
    """The staged package, with the page and what it loads beside it. palpate.measure is left out: OpenCV's codecs load 130 libraries.
    `other`: another Python than the one that packs."""
    wanted(release.site / "palpate.wasm", "tools/build-web makes it")
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
        shutil.copytree(release.site, package / "web")
        modules = sorted(package.glob("*.so"))
        brought = shared_objects.self_contained(modules, unpacked / "palpate.libs")
        info = next(unpacked.glob("*.dist-info"))
        (info / "licenses").mkdir(exist_ok=True)
        licences.of_this_machine(info / "licenses", brought, release.build, targets)
        if other:
            licences.of_headers(info / "licenses", ROOT / f"build/pythons/{other[2]}.{other[3:]}")
        shutil.copyfile(ROOT / "LICENSE", info / "licenses/LICENSE")
        files = [*modules, *(unpacked / "palpate.libs").iterdir()]
        glibc = shared_objects.newest_symbol(files, "GLIBC")
        python = other or re.search(r"-(cp\d+)-\w+-\w+\.whl$", plain.name)[1]
        tag = f"{python}-{python}-manylinux_{glibc[0]}_{glibc[1]}_x86_64"
        (info / "WHEEL").write_text(re.sub(r"(?m)^Tag: .*$", f"Tag: {tag}", (info / "WHEEL").read_text()))
        names = sorted(str(f.relative_to(unpacked)) for f in unpacked.rglob("*") if f.is_file() and f.name != "RECORD")
        record = f"{info.name}/RECORD"
        rows = [record_row(unpacked / name, name) for name in names] + [f"{record},,"]
        (unpacked / record).write_text("\n".join(rows) + "\n")
        archives.zip_of(release.out / f"palpate-{release.version}-{tag}.whl", unpacked, [*names, record], release.epoch)


# ---- what binds them


MAKERS = {"notes": make_notes, "source": make_source, "npm": make_npm, "deb": make_deb, "sdist": make_sdist, "wheel": make_wheel, "wheel-3.13": make_wheel_of("3.13"),
          "c": c_library.make_c, "c-arm64": c_library.make_c_arm64, "c-windows": c_library.make_c_windows, "unity": unity.make_unity,
          "portable": portable.make_portable, "windows": windows.make_windows, "sbom": make_sbom, "bits": make_bits}


def bind(release: Release) -> None:
    """verify, sums and signature."""
    shutil.copyfile(HERE / "verify", release.out / "verify")
    (release.out / "verify").chmod(0o755)
    files = sorted(file for file in release.out.iterdir() if not file.name.startswith("SHA256SUMS"))
    (release.out / "SHA256SUMS").write_text("".join(f"{archives.sha256(file)}  {file.name}\n" for file in files))
    if release.key:
        if shutil.which("minisign") is None:
            raise Missing("minisign is not installed (tools/install-dependencies --all)")
        # The comment would hold the time; a fixed one makes the signature the same every time.
        run("minisign", "-S", "-s", release.key, "-m", release.out / "SHA256SUMS", "-c", f"Palpate {release.version}", "-t",
            f"Palpate {release.version}", stdin=subprocess.DEVNULL if is_open(release.key) else None)


def is_open(key: pathlib.Path) -> bool:
    """A key without a password: a test's. Bytes 2 and 3 name how a password becomes a key."""
    return base64.b64decode(key.read_text().splitlines()[1])[2:4] == b"\0\0"
