"""The command for Windows in a folder that may lie anywhere: its programs, the one library that they load, scenes, translations, the
page."""
import os
import pathlib
import re
import shutil
import tempfile

from release import archives, c_library, licences
from release.basics import ROOT, Missing, Release, run, wanted

FAMILIES = ("serve",)
TARGETS = ("palpate_command", *(f"palpate_{family}_family" for family in FAMILIES))
# Of Windows itself, and of every Windows 10.
OF_WINDOWS = re.compile(r"(?i)^(advapi32|api-ms-win-.*|bcrypt|comdlg32|crypt32|dwmapi|gdi32|imm32|iphlpapi|kernel32|msvcrt|mswsock|ntdll|ole32|"
                        r"oleaut32|opengl32|powrprof|secur32|setupapi|shell32|shlwapi|ucrtbase|user32|version|winmm|ws2_32)(\.dll)?$")
README = """Palpate {version}: the command for Windows 10 or later on x86-64

  bin\\palpate                     the window (OpenGL 3.3)
  bin\\palpate simulate            ten seconds without a window, into results\\
  bin\\palpate serve               the page, in a browser of this computer
  bin\\palpate --help              everything

The folder may lie anywhere and is not changed. Scenes are in share\\palpate\\scenes, licences in share\\licenses.

Left out are measure, study, train, class, reports and films. It was compiled by mingw-w64 and tried under Wine; Windows itself was not
tried, nor was a haptic device.
"""


def loads(program: pathlib.Path) -> set:
    """The libraries that a program or library names."""
    if shutil.which("x86_64-w64-mingw32-objdump") is None:
        raise Missing("x86_64-w64-mingw32-objdump is not installed (tools/install-dependencies --platforms)")
    return set(re.findall(r"DLL Name: (\S+)", run("x86_64-w64-mingw32-objdump", "-p", program)))


def bring(programs: list) -> None:
    """What they load and Windows has not, beside them."""
    for name in sorted({name for program in programs for name in loads(program) if not OF_WINDOWS.match(name)}):
        library = wanted(licences.LIBRARIES / "win64/bin" / name, "tools/platform-libraries win64")
        shutil.copyfile(library, programs[0].parent / name)
        strangers = {other for other in loads(library) if not OF_WINDOWS.match(other)}
        if strangers:
            raise Missing(f"{name} loads {sorted(strangers)}, which nobody brings")


def make_windows(release: Release) -> None:
    build = release.build.parent / "win64"
    how = f"{c_library.cross_build('win64').rsplit(' --target', 1)[0]} --target {' '.join(TARGETS)}"
    for program in ("palpate", *(f"palpate-{family}" for family in FAMILIES)):
        wanted(build / f"{program}.exe", how)
    name = f"palpate-{release.version}-windows-x86_64"
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / name
        for component in ("command", *FAMILIES):
            run("cmake", "--install", build, "--prefix", tree, "--component", component)
        for part in ("doc", "man", "bash-completion", "zsh", "fish", "applications", "icons", "metainfo"):
            shutil.rmtree(tree / "share" / part, ignore_errors=True)  # of other systems
        programs = sorted((tree / "bin").glob("*.exe"))
        for program in programs:
            # A program holds the time when it was linked; strip would write its own.
            run("x86_64-w64-mingw32-strip", "--strip-unneeded", program, env=os.environ | {"SOURCE_DATE_EPOCH": str(release.epoch)})
        bring(programs)
        if release.site.exists():
            shutil.copytree(release.site, tree / "share/palpate/web", dirs_exist_ok=True)
        (tree / "share/licenses").mkdir(parents=True, exist_ok=True)
        for target in TARGETS:
            licences.of_windows(tree / "share/licenses", build, target)
        shutil.copyfile(ROOT / "LICENSE", tree / "share/licenses/palpate")
        shutil.copytree(ROOT / "examples/scenes", tree / "share/palpate/scenes", dirs_exist_ok=True)
        (tree / "README.txt").write_text(README.format(version=release.version).replace("\n", "\r\n"), newline="")
        names = sorted(str(file.relative_to(tree.parent)) for file in tree.rglob("*") if file.is_file())
        archives.zip_of(release.out / f"{name}.zip", tree.parent, names, release.epoch)
