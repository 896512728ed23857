"""Trials of what is made for other systems, for Unity, and to be carried about."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import urllib.error
import urllib.request
import zipfile

from release import shared_objects, unity, windows
from release.basics import HERE, PYTHON, ROOT
from release.trial import CLEAN, Failed, Skipped, felt, only_the_system, run, the, unpacked

STRANGE = "ü "  # a folder may be called anything
WINE = "/usr/lib/wine/wine64"
GCC_ARM64, GCC_WINDOWS = "aarch64-linux-gnu-gcc", "x86_64-w64-mingw32-gcc-posix"
ARM64_ROOT = "/usr/aarch64-linux-gnu"  # glibc and the compiler's libraries, and nothing else


def needs(*programs) -> None:
    for program in programs:
        if shutil.which(program) is None:
            raise Skipped(f"{program} is not installed (tools/install-dependencies --platforms)")


def compiled_by_cmake(tree: pathlib.Path, build: pathlib.Path, system: str, compiler: str) -> None:
    run("cmake", "-S", tree / "examples", "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={tree}", f"-DCMAKE_SYSTEM_NAME={system}",
        f"-DCMAKE_C_COMPILER={compiler}")
    run("cmake", "--build", build)


def flags_of(tree: pathlib.Path) -> list:
    words = run("pkg-config", "--cflags", "--libs", "palpate", env=CLEAN | {"PKG_CONFIG_LIBDIR": str(tree / "lib/pkgconfig")})
    return words.split()


# ---- C, for another processor and another system


def try_c_arm64(files: pathlib.Path, work: pathlib.Path, _) -> str:
    archive = the(files, "palpate-c-*-linux-aarch64.tar.gz")
    needs(GCC_ARM64, "qemu-aarch64-static")
    tree = unpacked(archive, work)
    libraries = [file for file in tree.rglob("*.so*") if not file.is_symlink()]
    for file in libraries:
        for name in shared_objects.needed(file):
            if not shared_objects.OF_THE_SYSTEM.match(name) and not (tree / "lib/palpate" / name).exists():
                raise Failed(f"{file.name} loads {name}, which is not in the archive")
    words = ("-Wall", "-Werror", "-std=c99", "-ffp-contract=off", tree / "examples/touch.c")
    run(GCC_ARM64, *words, *flags_of(tree), f"-Wl,-rpath,{tree / 'lib'}", "-o", work / "touch")
    qemu = (shutil.which("qemu-aarch64-static"), "-L", ARM64_ROOT)
    said = felt(run(*qemu, work / "touch", cwd="/", env={}), "touch")
    compiled_by_cmake(tree, work / "build", "Linux", GCC_ARM64)
    felt(run(*qemu, work / "build/touch", cwd="/", env={}), "touch")
    return said + " by pkg-config and by CMake, under qemu"


def try_c_windows(files: pathlib.Path, work: pathlib.Path, _) -> str:
    archive = the(files, "palpate-c-*-windows-x86_64.zip")
    needs(GCC_WINDOWS, "x86_64-w64-mingw32-objdump", "x86_64-w64-mingw32-dlltool", WINE)
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(work)
    tree = work / archive.name.removesuffix(".zip")
    strangers = set(re.findall(r"DLL Name: (\S+)", run("x86_64-w64-mingw32-objdump", "-p", tree / "bin/palpate.dll")))
    brought = sorted(name for name in strangers if re.match(r"(?i)lib|.*(stdc|gcc|winpthread|sqlite|zlib)", name))
    if brought:
        raise Failed(f"palpate.dll loads {brought}")
    # The list of functions is as good as the library that came with it.
    run("x86_64-w64-mingw32-dlltool", "-d", tree / "lib/palpate.def", "-l", work / "libfrom_def.a")
    words = ("-Wall", "-Werror", "-std=c99", "-ffp-contract=off", tree / "examples/touch.c")
    wine = {"env": CLEAN | {"HOME": str(work), "WINEPREFIX": str(work / "wine"), "WINEDEBUG": "-all"}}
    for name, libraries in (("touch.exe", flags_of(tree)), ("by_def.exe", [f"-I{tree / 'include'}", work / "libfrom_def.a"])):
        program = work / "run" / name
        program.parent.mkdir(exist_ok=True)
        run(GCC_WINDOWS, *words, *libraries, "-o", program)
        shutil.copyfile(tree / "bin/palpate.dll", program.parent / "palpate.dll")
        said = felt(run(WINE, program, cwd="/", **wine), "touch")
    compiled_by_cmake(tree, work / "build", "Windows", GCC_WINDOWS)
    shutil.copyfile(tree / "bin/palpate.dll", work / "build/palpate.dll")
    felt(run(WINE, work / "build/touch.exe", cwd="/", **wine), "touch")
    return said + " by pkg-config, by CMake and by the list of functions, under Wine"


# ---- Unity


def check_metas(package: pathlib.Path) -> int:
    """Each asset has a .meta, each .meta an asset, no number is there twice, each plugin goes where its format belongs."""
    numbers = {}
    for file in sorted(package.rglob("*")):
        if file.name.endswith("~"):
            continue
        if file.suffix == ".meta":
            if not file.with_suffix("").exists():
                raise Failed(f"{file.name} is of nothing")
            number = re.search(r"(?m)^guid: ([0-9a-f]{32})$", file.read_text())
            if not number or number[1] in numbers:
                raise Failed(f"the guid of {file.name} is missing, or that of {numbers.get(number and number[1])}, too")
            numbers[number[1]] = file.name
        elif not file.with_name(file.name + ".meta").exists():
            raise Failed(f"{file.name} has no .meta")
        if file.suffix in (".so", ".dll"):
            check_plugin(file)
    scene = (package / "Samples~/FirstTouch/FirstTouch.unity").read_text()
    if numbers.get(re.search(r"m_Script: .*guid: ([0-9a-f]+)", scene)[1]) != "FirstTouch.cs.meta":
        raise Failed("the scene has another script")
    return len(numbers)


def check_plugin(file: pathlib.Path) -> None:
    head = file.read_bytes()[:20]
    kind = "dll" if head[:2] == b"MZ" else {62: "x86_64", 183: "arm64"}[int.from_bytes(head[18:20], "little")]
    on = re.findall(r"first:\n +(.+)\n +second:\n +enabled: 1\n +settings:\n +CPU: (\w+)", file.with_name(file.name + ".meta").read_text())
    wanted = {"dll": [(unity.EDITOR, "x86_64"), (unity.WINDOWS, "x86_64")], "x86_64": [(unity.EDITOR, "x86_64"), (unity.LINUX, "x86_64")],
              "arm64": [(unity.EMBEDDED, "ARM64")]}[kind]
    if on != wanted:
        raise Failed(f"{file.name} is taken along for {on}")
    if kind != "dll":
        for name in shared_objects.needed(file):
            if not shared_objects.OF_THE_SYSTEM.match(name) and not (file.parent / name).exists():
                raise Failed(f"{file.name} loads {name}, which is not beside it")


def try_unity(files: pathlib.Path, work: pathlib.Path, _) -> str:
    with tarfile.open(the(files, f"{unity.NAME}-*.tgz")) as tar:
        tar.extractall(work)
    package = work / "package"
    about = json.loads((package / "package.json").read_text())
    for sample in about["samples"]:
        if not (package / sample["path"]).is_dir():
            raise Failed(f"there is no {sample['path']}")
    json.loads((package / "Runtime/Palpate.asmdef").read_text())
    assets = check_metas(package)
    if shutil.which("mcs") is None or shutil.which("mono") is None:
        raise Skipped(f"{assets} assets are in order, but the sample needs mono-mcs and mono-runtime")
    run("mcs", "-unsafe", "-warnaserror", "-nowarn:649", f"-out:{work / 'touch.exe'}", package / "Runtime/Palpate.cs",
        package / "Samples~/FirstTouch/FirstTouch.cs", HERE / "first/UnityEngine.cs")
    said = felt(run("mono", work / "touch.exe", cwd="/", env=CLEAN | {"LD_LIBRARY_PATH": str(package / "Plugins/x86_64"), "HOME": str(work)}), "touch")
    return f"{said} from the sample by Mono, {assets} assets in order"


# ---- the command


def answered(address: str) -> str:
    try:
        with urllib.request.urlopen(address, timeout=30) as answer:
            return answer.read().decode(errors="replace")
    except (urllib.error.URLError, OSError) as error:
        return str(error)


def try_page(program: pathlib.Path, environment: dict) -> str:
    """`palpate serve` until it has answered."""
    served = subprocess.Popen([program, "serve", "--port", "0", "--json", "--seconds", "60"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, env=environment, cwd="/")
    try:
        line = served.stdout.readline()
        if not line.startswith("{"):
            raise Failed(f"serve does not start: {served.communicate(timeout=30)[1][-800:]}")
        address = json.loads(line)["address"]
        page, engine = answered(address + "/"), answered(address + "/served.js")
        if "<html" not in page or "import" not in engine:
            raise Failed(f"serve answers {page[:200]} {engine[:200]}")
    finally:
        served.terminate()  # a shell lets what it runs in the background ignore SIGINT
        served.communicate(timeout=30)
    return "its page answers"


def try_portable(files: pathlib.Path, work: pathlib.Path, _) -> str:
    place = work / STRANGE
    place.mkdir()
    tree = unpacked(the(files, "palpate-[0-9]*-linux-x86_64.tar.gz"), place)
    environment = CLEAN | {"HOME": str(work)}
    only_the_system([*(tree / "bin").iterdir(), *(tree / "lib/palpate").iterdir()], place, shared_objects.OF_A_DESKTOP)
    program = tree / "bin/palpate"
    version = run(program, "--version", cwd="/", env=environment).strip()
    said = felt(run(PYTHON, HERE / "first/simulate.py", program, cwd="/", env=environment), "simulate")
    run(program, "simulate", tree / "share/palpate/scenes/lumps.toml", "--seconds", "0.1", "--out", work / "run", cwd="/", env=environment)
    run(program, "recording", "plot", work / "run/forces.csv", "-o", work / "plot.png", cwd="/", env=environment)
    run(program, "train", "--help", cwd="/", env=environment)
    if not (tree / "share/palpate/web/index.html").exists():
        return f"{version}: {said}; without the page, which was not built (tools/build-web)"
    return f"{version}: {said}, draws, {try_page(program, environment)}"


def try_windows(files: pathlib.Path, work: pathlib.Path, _) -> str:
    archive = the(files, "palpate-[0-9]*-windows-x86_64.zip")
    needs(WINE, "x86_64-w64-mingw32-objdump")
    place = work / STRANGE
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(place)
    tree = place / archive.name.removesuffix(".zip")
    for program in sorted((tree / "bin").iterdir()):
        lost = sorted(name for name in windows.loads(program) if not windows.OF_WINDOWS.match(name) and not (tree / "bin" / name).exists())
        if lost:
            raise Failed(f"{program.name} loads {lost}, which is not in the folder")
    wine = {"cwd": "/", "env": CLEAN | {"HOME": str(work), "WINEPREFIX": str(work / "wine"), "WINEDEBUG": "-all"}}
    program = tree / "bin/palpate.exe"
    version = run(WINE, program, "--version", **wine).strip()
    said = felt(run(PYTHON, HERE / "first/simulate.py", WINE, program, **wine), "simulate")
    run(WINE, program, "simulate", tree / "share/palpate/scenes/lumps.toml", "--seconds", "0.1", "--no-pictures", "--no-plot", "--out", work / "run", **wine)
    run(WINE, program, "serve", "--help", **wine)
    return f"{version}: {said}, under Wine"
