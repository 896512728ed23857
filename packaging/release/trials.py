"""What a stranger does with the files of a release: verify, install in an empty folder, run the first example. Forces are compared
with those of first/kept.json."""
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
import time

from release import trials_of_systems
from release.basics import HERE, PYTHON, ROOT
from release.trial import CLEAN, TEST_KEY, Failed, Skipped, felt, only_the_system, run, the, unpacked


# ---- verify


def key_of(folder: pathlib.Path):
    """Signed by the tests' key, or by one that is not at hand here."""
    done = subprocess.run([folder / "verify", TEST_KEY], capture_output=True, text=True)
    return TEST_KEY if done.returncode == 0 else "--sums"


def try_verify(files: pathlib.Path, work: pathlib.Path, _) -> str:
    """What `verify` says of the files as they are, and after every kind of change."""
    the(files, "verify")
    copy = work / "copy"
    shutil.copytree(files, copy)
    key = key_of(copy)
    said = run(copy / "verify", key, cwd="/").strip()

    def refused(what: str, change, undo) -> None:
        change()
        done = subprocess.run([copy / "verify", key], capture_output=True, text=True, env=CLEAN)
        undo()
        if done.returncode != 1:
            raise Failed(f"verify takes {what}: {done.stdout}{done.stderr}")

    for file in sorted(copy.iterdir()):
        kept = file.read_bytes()
        at = len(kept) // 2
        if file.name in ("verify", "SHA256SUMS.minisig"):
            continue  # the script runs, and the signature holds, or they do not
        refused(f"{file.name} with one byte changed", lambda f=file, k=kept, i=at: f.write_bytes(k[:i] + bytes([k[i] ^ 1]) + k[i + 1:]),
                lambda f=file, k=kept: f.write_bytes(k))
    extra = copy / "extra.deb"
    refused("a file too many", lambda: extra.write_bytes(b"x"), extra.unlink)
    if key != "--sums":
        notes = the(copy, "palpate-*.md")
        kept, sums = notes.read_bytes(), (copy / "SHA256SUMS").read_text()

        def forge() -> None:
            notes.write_bytes(kept + b"!")
            old, new = (hashlib.sha256(text).hexdigest() for text in (kept, kept + b"!"))
            (copy / "SHA256SUMS").write_text(sums.replace(old, new))

        def restore() -> None:
            notes.write_bytes(kept)
            (copy / "SHA256SUMS").write_text(sums)

        refused("a changed file whose sum was changed, too", forge, restore)
        other = "RWQf6LRCGA9i53mlYecO4IzT51TGPpvWucNSCh1CBM0QTaLn73Y7GFO3"  # minisign's own
        if subprocess.run([copy / "verify", other], capture_output=True, env=CLEAN).returncode != 1:
            raise Failed("verify takes another key")
    return said.removeprefix("verify: ")


# ---- one artefact each


def try_npm(files: pathlib.Path, work: pathlib.Path, _) -> str:
    package = the(files, "palpate-*.tgz")
    if shutil.which("npm") is None:
        raise Skipped("npm is not installed")
    environment = CLEAN | {"HOME": str(work), "PATH": os.environ["PATH"]}
    run("npm", "install", "--offline", "--no-audit", "--no-fund", package, cwd=work, env=environment)
    said = felt(run("node", "node_modules/palpate/examples/press.mjs", cwd=work, env=environment), "press")
    page = run("node", "--input-type=module", "-e", "import { pageFolder } from 'palpate/page'; console.log(pageFolder)", cwd=work, env=environment)
    if not (pathlib.Path(page.strip()) / "index.html").exists():
        raise Failed(f"palpate/page gives {page}")
    if shutil.which("tsc"):
        example = work / "typed.mts"
        example.write_text((work / "node_modules/palpate/examples/press.mjs").read_text())
        run("tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "node16", "--moduleResolution", "node16", "--lib", "es2022,dom", example,
            cwd=work, env=environment)
        said += ", typed"
    browser = subprocess.run(["node", HERE / "press_in_browser.mjs", work], capture_output=True, text=True)
    if browser.returncode == 77:
        return said + " in node (no chromium here)"
    if browser.returncode != 0:
        raise Failed(f"chromium: {browser.stderr.strip()[-800:]}")
    felt(browser.stdout, "press")
    return said + " in node and Chromium"


# A cell's page, asked as a browser asks: where it lies, and how the engine begins.
WIDGET = """
import urllib.request, palpate.view
from palpate.notebook import page_folder
with palpate.view.widget() as page:
    address = page.url.split("/#")[0]
    assert b"<html" in urllib.request.urlopen(address + "/").read()
    print(page_folder(), urllib.request.urlopen(address + "/palpate.wasm").read(4).hex(), sep="\\n")
"""


def try_wheel(files: pathlib.Path, work: pathlib.Path, full) -> str:
    wheel = the(files, f"*-cp{sys.version_info.major}{sys.version_info.minor}-*.whl")
    start = time.monotonic()
    run(PYTHON, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-compile", "--target", work / "site", wheel)
    took = time.monotonic() - start
    environment = CLEAN | {"PYTHONPATH": str(work / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
    said = felt(run(PYTHON, HERE / "first/touch.py", cwd=work, env=environment), "touch")
    page = run(PYTHON, "-c", WIDGET, cwd=work, env=environment).splitlines()
    if pathlib.Path(page[0]) != work.resolve() / "site/palpate/web" or page[1] != "0061736d":
        raise Failed(f"palpate.view.widget() serves {page}")
    only_the_system((work / "site").rglob("*.so*"), work)
    return f"{said}, a widget with its page, installed in {took:.1f} s"


def try_sdist(files: pathlib.Path, work: pathlib.Path, full) -> str:
    sdist = [file for file in files.iterdir() if re.fullmatch(r"palpate-[\d.]+\.tar\.gz", file.name)]
    if not sdist:
        raise Skipped("there is no palpate-VERSION.tar.gz")
    tree = unpacked(sdist[0], work)
    for file in ("PKG-INFO", "setup.py", "pyproject.toml", "LICENSE"):
        if not (tree / file).exists():
            raise Failed(f"it has no {file}")
    options = ["APPS", "TESTS", "EXAMPLES", "BENCHMARKS", "C"]
    run("cmake", "-S", tree, "-B", work / "build", "-G", "Ninja", "-DPALPATE_BUILD_PYTHON=ON", "-DPALPATE_PEERS=OFF", f"-DPython3_EXECUTABLE={PYTHON}",
        *[f"-DPALPATE_BUILD_{option}=OFF" for option in options])
    # A source that is missing had been refused; a module whose needs are missing is left out in silence.
    if "python/palpate/_core." not in run("ninja", "-C", work / "build", "-t", "commands", "palpate_python"):
        raise Failed("it would not build the module")
    if not full:
        return "configures, every source is there (--full compiles it)"
    run(PYTHON, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build-isolation", "--target", work / "site", tree)
    environment = CLEAN | {"PYTHONPATH": str(work / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
    return felt(run(PYTHON, HERE / "first/touch.py", cwd=work, env=environment), "touch") + ", compiled"


def try_c(files: pathlib.Path, work: pathlib.Path, _) -> str:
    tree = unpacked(the(files, "palpate-c-*-linux-x86_64.tar.gz"), work)
    only_the_system(tree.rglob("*.so*"), work)
    flags = run("pkg-config", "--cflags", "--libs", "palpate", env=CLEAN | {"PKG_CONFIG_PATH": str(tree / "lib/pkgconfig")}).split()
    run("cc", "-Wall", "-Werror", "-std=c99", "-ffp-contract=off", tree / "examples/touch.c", *flags, f"-Wl,-rpath,{tree / 'lib'}", "-o", work / "touch")
    said = felt(run(work / "touch", cwd="/"), "touch")
    run("cmake", "-S", tree / "examples", "-B", work / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={tree}")
    run("cmake", "--build", work / "build")
    felt(run(work / "build/touch", cwd="/"), "touch")
    return said + " by pkg-config and by CMake"


def try_deb(files: pathlib.Path, work: pathlib.Path, _) -> str:
    packages = work / "packages"
    packages.mkdir()
    the(files, "*.deb")
    for package in files.glob("*.deb"):
        shutil.copyfile(package, packages / package.name)
    run(ROOT / "tools/package", "--made", "--out", packages, "--keep", work / "root", env=os.environ | {})
    root = work / "root/usr"
    flags = run("pkg-config", "--cflags", "--libs", "palpate", env=CLEAN | {"PKG_CONFIG_PATH": str(root / "lib/pkgconfig")}).split()
    run("cc", "-ffp-contract=off", HERE / "first/touch.c", *flags, f"-Wl,-rpath,{root / 'lib'}", "-o", work / "touch")
    felt(run(work / "touch", cwd="/"), "touch")
    environment = CLEAN | {"PYTHONPATH": str(root / "lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE": "1"}
    felt(run(PYTHON, HERE / "first/touch.py", cwd="/", env=environment), "touch")
    for file in ("applications/org.palpate.palpate.desktop", "metainfo/org.palpate.palpate.metainfo.xml", "icons/hicolor/scalable/apps/palpate.svg",
                 "man/man1/palpate.1", "bash-completion/completions/palpate"):
        if not list((root / "share").glob(file + "*")):
            raise Failed(f"no package has share/{file}")
    return "the kept forces from C and Python; the command runs"


def try_source(files: pathlib.Path, work: pathlib.Path, _) -> str:
    with tarfile.open(the(files, "*-source.tar.gz")) as tar:
        tar.extractall(work)
    tree = the(work, "palpate-*")
    run(sys.executable, tree / "packaging/check_papers.py", env=os.environ | {})
    options = ["APPS", "TESTS", "EXAMPLES", "PYTHON"]
    run("cmake", "-S", tree, "-B", work / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *[f"-DPALPATE_BUILD_{o}=OFF" for o in options])
    if "libpalpate.so" not in run("ninja", "-C", work / "build", "-t", "commands", "palpate_c"):
        raise Failed("it would not build the C library")
    return "configures, every source of the C library is there (./test compiles everything)"


def try_text(files: pathlib.Path, work: pathlib.Path, _) -> str:
    run(ROOT / "tools/sbom", "--check", the(files, "*.spdx.json"))
    rows = [json.loads(line) for line in the(files, "*-bits.jsonl").read_text().splitlines()]
    if len(rows) < 5 or not all(row.get("forces") for row in rows):
        raise Failed("the list of hashes is empty")
    return f"bill of materials, hashes of {len(rows)} scenes, {len(the(files, 'palpate-*.md').read_text().splitlines())} lines of notes"


# ---- the lines of the README, in a Debian root that holds nothing else


def install_lines() -> list:
    """The commands of README.md that install, without their comments and as they are asked for."""
    section = (ROOT / "README.md").read_text().split("## Install", 1)[1].split("```")[1]
    return [line.split("#")[0].strip() for line in section.strip().splitlines() if line.strip()]


def in_root(root: pathlib.Path, words: str, **environment) -> str:
    """By a shell in the root, in /files, with /proc and without anything else of this machine."""
    inside = f"mount -t proc proc {root}/proc && exec chroot {root} /bin/sh -ec 'cd /files; {words}'"
    return run("unshare", "-m", "--propagation", "private", "sh", "-ec", inside, env=CLEAN | environment | {
        "HOME": "/root", "DEBIAN_FRONTEND": "noninteractive", "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"})


def fresh_root(files: pathlib.Path, work: pathlib.Path, suite: str = "bookworm", python: str = "cp311") -> pathlib.Path:
    """With the wheel of its own Python alone, as somebody downloads it."""
    if shutil.which("debootstrap") is None or os.geteuid() != 0:
        raise Skipped("it needs debootstrap and root")
    root = work / "root"
    run("debootstrap", "--variant=minbase", "--include=python3-venv,python3-numpy", suite, root, env=os.environ | {})
    shutil.copyfile("/etc/resolv.conf", root / "etc/resolv.conf")
    shutil.copytree(files, root / "files")
    for wheel in (root / "files").glob("*.whl"):
        if f"-{python}-" not in wheel.name:
            wheel.unlink()
    for example in ("touch.py", "simulate.py"):
        shutil.copyfile(HERE / "first" / example, root / "files" / example)
    in_root(root, "apt-get -qq update")
    return root


def quiet_apt(line: str) -> str:
    return line.replace("apt install", "apt-get install -qq -y --no-install-recommends")


def portable_in_root(root: pathlib.Path, line: str) -> None:
    in_root(root, f"{quiet_apt('apt install libx11-6')}; {line}")
    felt(in_root(root, "python3 simulate.py palpate-[0-9]*-linux-x86_64/bin/palpate"), "simulate")


def page_in_root(root: pathlib.Path, line: str) -> None:
    """The page is served by Python, and the engine comes along."""
    asked = "import urllib.request as r; a = \"http://127.0.0.1:8000/\"; print(r.urlopen(a).read()[:15], r.urlopen(a + \"palpate.wasm\").read(4))"
    said = in_root(root, f"{line} & trap \"kill $!\" EXIT; sleep 3; python3 -c \"$ASKED\"", ASKED=asked)
    if "b'<!doctype html>'" not in said.lower() or "asm" not in said:
        raise Failed(f"{line} serves {said}")


def wheel_in_root(root: pathlib.Path, line: str) -> None:
    in_root(root, f"python3 -m venv --system-site-packages /venv; /venv/bin/{line} --no-index --quiet")
    felt(in_root(root, "/venv/bin/python touch.py"), "touch")


def deb_in_root(root: pathlib.Path, line: str) -> None:
    in_root(root, quiet_apt(line))
    felt(in_root(root, "palpate --version; python3 simulate.py palpate"), "simulate")


def npm_in_folder(root: pathlib.Path, line: str) -> None:
    """Node is this machine's: Debian's npm would bring 400 packages."""
    folder = root.parent / "npm"
    folder.mkdir()
    for package in (root / "files").glob("palpate-*.tgz"):
        shutil.copyfile(package, folder / package.name)
    environment = CLEAN | {"HOME": str(root.parent), "PATH": os.environ["PATH"]}
    run("sh", "-ec", f"{line} --offline --no-audit --no-fund", cwd=folder, env=environment)
    felt(run("node", "node_modules/palpate/examples/press.mjs", cwd=folder, env=environment), "press")


def c_in_root(root: pathlib.Path, line: str) -> None:
    in_root(root, f"{line}; {quiet_apt('apt install gcc libc6-dev')}; cd palpate-c-*-linux-x86_64; "
            "cc -ffp-contract=off examples/touch.c -Iinclude -Llib -lpalpate -Wl,-rpath,$PWD/lib -o touch")
    felt(in_root(root, "palpate-c-*-linux-x86_64/touch"), "touch")


def source_in_root(root: pathlib.Path, line: str) -> None:
    """Unpacked, with what it asks for installed, configured; compiling is ./test's affair."""
    in_root(root, f"{line}; mv palpate-[0-9]*.[0-9]*.[0-9] /source; /source/tools/install-dependencies --bare")
    in_root(root, "cd /source; cmake --preset release -DPALPATE_MEASURE=OFF -DPALPATE_TEACH=OFF -DPALPATE_STUDIES=OFF -DPALPATE_BUILD_TESTS=OFF; "
            "ninja -C build/release -n palpate_command")


# Each line of the README by the file that it takes, and what shows that it did.
README_LINES = {"tar xf palpate-[0-9]*-linux-x86_64.tar.gz": portable_in_root,
                "python3 -m http.server -d palpate-[0-9]*-linux-x86_64/share/palpate/web": page_in_root,
                "pip install ./palpate-*.whl": wheel_in_root, "apt install ./palpate_*.deb": deb_in_root,
                "npm install ./palpate-*.tgz": npm_in_folder, "tar xf palpate-c-*-linux-x86_64.tar.gz": c_in_root,
                "tar xf palpate-*-source.tar.gz": source_in_root}


def try_readme(files: pathlib.Path, work: pathlib.Path, full) -> str:
    """Every line of the README that installs, as it stands there, then the first example."""
    lines = install_lines()
    if set(lines) != set(README_LINES):
        raise Failed(f"the README has {sorted(set(lines) ^ set(README_LINES))}; each of its lines needs its trial, and each trial its line")
    if not full:
        raise Skipped("a fresh Debian root takes a network and minutes; --full")
    root = fresh_root(files, work)
    said = []
    for line in lines:
        start = time.monotonic()
        README_LINES[line](root, line)
        said.append(f"{line.split()[0]} {time.monotonic() - start:.0f} s")
    return f"installed and felt in a fresh Debian 12 root: {', '.join(said)}"


def try_debian_13(files: pathlib.Path, work: pathlib.Path, full) -> str:
    the(files, "*-cp313-*.whl")
    if not full:
        raise Skipped("a fresh Debian root takes a network and minutes; --full")
    root = fresh_root(files, work, "trixie", "cp313")
    wheel_in_root(root, "pip install ./palpate-*.whl")
    return "installed and felt in a fresh Debian 13 root"


def try_piuparts(files: pathlib.Path, work: pathlib.Path, full) -> str:
    """All packages come into an empty Debian 12 and go again; nothing may be left, nothing of others changed."""
    packages = sorted(files.glob("*.deb"))
    the(files, "*.deb")
    if not full:
        raise Skipped("a fresh Debian root takes a network and minutes; --full")
    if shutil.which("piuparts") is None or os.geteuid() != 0:
        raise Skipped("it needs piuparts and root")
    said = run("piuparts", "--distribution", "bookworm", "--no-eatmydata", "--tmpdir", work, *packages, env=os.environ | {})
    if "PASS: All tests." not in said:
        raise Failed(said[-1200:])
    return f"{len(packages)} packages installed and purged in a fresh Debian 12 root; nothing was left"


TRIALS = {"verify": try_verify, "notes, bill, hashes": try_text, "C library": try_c, "C library for ARM64": trials_of_systems.try_c_arm64,
          "C library for Windows": trials_of_systems.try_c_windows, "Unity": trials_of_systems.try_unity,
          "portable command": trials_of_systems.try_portable, "command for Windows": trials_of_systems.try_windows, "npm": try_npm, "wheel": try_wheel, "Debian": try_deb, "source": try_source,
          "sdist": try_sdist, "README": try_readme, "piuparts": try_piuparts,
          "wheel in Debian 13": try_debian_13}


def check(files: pathlib.Path, version: str, full: bool) -> int:
    failed = 0
    for name, trial in TRIALS.items():
        with tempfile.TemporaryDirectory() as work:
            try:
                print(f"{name}: {trial(files, pathlib.Path(work), full)}", flush=True)
            except Skipped as reason:
                print(f"{name}: left out: {reason}", flush=True)
            except Failed as reason:
                failed += 1
                print(f"{name}: FAILED: {reason}", flush=True)
    return 1 if failed else 0
