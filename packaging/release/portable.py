"""The command in a folder that may lie anywhere: its programs, what they load, scenes, translations, man pages, the page. What draws
(GL, X11) is the system's."""
import pathlib
import shutil
import tempfile

from release import archives, licences, shared_objects
from release.basics import ROOT, Release, run, wanted

# Not measure and study: OpenCV's codecs load 130 libraries.
FAMILIES = ("serve", "report", "teach", "class")
README = """Palpate {version}: the command for Linux on x86-64, glibc {glibc} or later (Debian 12, Ubuntu 22.04, ...)

  bin/palpate                     the window
  bin/palpate simulate            ten seconds without a window, into results/
  bin/palpate serve               the page, in a browser of this computer
  bin/palpate train               training
  bin/palpate --help              everything

The folder may lie anywhere and is not changed. A desktop has what it needs of the system; elsewhere:

  apt install libx11-6            the command
  apt install libxext6 libxrender1 libxcb-render0 libxcb-shm0 libexpat1    plots, reports, training
  apt install libegl1 libgl1-mesa-dri                                      pictures, films and the window (OpenGL 3.3)

Everything else lies in lib/palpate under names of its own, where updates of the system do not reach it; licences are in
share/licenses. Scenes are in share/palpate/scenes, man pages in share/man, completions for bash, zsh and fish in share.

Left out are `palpate measure`, `study`, `tissue` and `lump`: OpenCV would bring 130 libraries. The Debian packages have them.
"""


def make_portable(release: Release) -> None:
    system = shared_objects.System(left=shared_objects.OF_A_DESKTOP)
    name = f"palpate-{release.version}-linux-x86_64"
    targets = ["palpate_command", *(f"palpate_{family}_family" for family in FAMILIES)]
    for program in ("palpate", *(f"palpate-{family}" for family in FAMILIES)):
        wanted(release.build / program, f"ninja -C build/release {' '.join(targets)}")
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / name
        for component in ("command", *FAMILIES):
            run("cmake", "--install", release.build, "--prefix", tree, "--component", component)
        shutil.rmtree(tree / "share/doc", ignore_errors=True)  # Debian's
        programs = sorted((tree / "bin").iterdir())
        for program in programs:
            system.stripped(program)
        brought = shared_objects.self_contained(programs, tree / "lib/palpate", system)
        (tree / "share/licenses").mkdir(parents=True)
        licences.of_this_machine(tree / "share/licenses", brought, release.build, targets)
        shutil.copyfile(ROOT / "LICENSE", tree / "share/licenses/palpate")
        shutil.copytree(ROOT / "examples/scenes", tree / "share/palpate/scenes")
        glibc = shared_objects.newest_symbol([*programs, *(tree / "lib/palpate").iterdir()], "GLIBC")
        (tree / "README").write_text(README.format(version=release.version, glibc=".".join(map(str, glibc))))
        archives.tar_gz(release.out / f"{name}.tar.gz", tree, name, release.epoch)
