"""The C library for each system, with everything that it loads beside it: an archive that may be unpacked anywhere."""
import os
import pathlib
import re
import shutil
import tempfile
from dataclasses import dataclass

from release import archives, licences, shared_objects
from release.basics import HERE, ROOT, Missing, Release, run, wanted

CONFIG_LINUX = """# palpate::c, the C interface of Palpate, with everything that it loads beside it.
get_filename_component(palpate_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET palpate::c)
  add_library(palpate::c SHARED IMPORTED)
  set_target_properties(palpate::c PROPERTIES IMPORTED_LOCATION "${palpate_prefix}/lib/libpalpate.so.0"
                        IMPORTED_SONAME libpalpate.so.0 INTERFACE_INCLUDE_DIRECTORIES "${palpate_prefix}/include")
endif()
unset(palpate_prefix)
"""
# Visual C++ is given a library of its own kind, made from the list of functions.
CONFIG_WINDOWS = """# palpate::c, the C interface of Palpate. palpate.dll must lie beside the program: $<TARGET_RUNTIME_DLLS:...> names it.
get_filename_component(palpate_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(palpate_import "${palpate_prefix}/lib/libpalpate.dll.a")
if(MSVC)
  set(palpate_import "${palpate_prefix}/lib/palpate.lib")
  if(NOT EXISTS "${palpate_import}")
    set(palpate_c_FOUND FALSE)
    set(palpate_c_NOT_FOUND_MESSAGE "run once: lib /def:palpate.def /machine:x64 /out:palpate.lib, in ${palpate_prefix}/lib")
    return()
  endif()
endif()
if(NOT TARGET palpate::c)
  add_library(palpate::c SHARED IMPORTED)
  set_target_properties(palpate::c PROPERTIES IMPORTED_LOCATION "${palpate_prefix}/bin/palpate.dll" IMPORTED_IMPLIB "${palpate_import}"
                        INTERFACE_INCLUDE_DIRECTORIES "${palpate_prefix}/include")
endif()
unset(palpate_import)
unset(palpate_prefix)
"""
CONFIG_VERSION = """set(PACKAGE_VERSION "@VERSION@")
string(REGEX MATCH "^[0-9]+\\\\.[0-9]+" palpate_own "${PACKAGE_VERSION}")
string(REGEX MATCH "^[0-9]+\\\\.[0-9]+" palpate_asked "${PACKAGE_FIND_VERSION}")
if(palpate_own STREQUAL palpate_asked AND NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
"""
README_LINUX = """Palpate {version}: the C library for Linux on {processor}, glibc {glibc} or later (Debian 12, Ubuntu 22.04, ...)

  export PKG_CONFIG_PATH=$PWD/lib/pkgconfig
  cc -ffp-contract=off examples/touch.c $(pkg-config --cflags --libs palpate) -Wl,-rpath,$PWD/lib -o touch && ./touch

With CMake: find_package(palpate_c {version}), target palpate::c, CMAKE_PREFIX_PATH=$PWD. C# and Unity: share/palpate/csharp.
The folder may lie anywhere. lib/palpate holds what the library loads, under names of its own; licences are in share/licenses.
"""
README_WINDOWS = """Palpate {version}: the C library for Windows 10 or later on x86-64

With mingw-w64:   gcc -ffp-contract=off examples/touch.c -Iinclude -Llib -lpalpate -o touch.exe
With Visual C++:  cd lib && lib /def:palpate.def /machine:x64 /out:palpate.lib
                  cl /fp:precise examples\\touch.c /Iinclude lib\\palpate.lib
With CMake:       find_package(palpate_c {version}), target palpate::c, CMAKE_PREFIX_PATH this folder
C#:               share/palpate/csharp/Palpate.cs

bin/palpate.dll must lie beside the program or in PATH. It brings everything with it; licences are in share/licenses. It was compiled
by mingw-w64 and tried under Wine; neither Windows itself nor Visual C++ was tried.
"""


@dataclass(frozen=True)
class Target:
    processor: str
    preset: str
    how: str
    system: shared_objects.System

    def build(self, release: Release) -> pathlib.Path:
        return release.build.parent / self.preset


def cross_build(preset: str) -> str:
    return f"tools/platform-libraries {preset} && cmake --preset {preset} && cmake --build build/{preset} --target palpate_c"


LINUX = Target("x86_64", "release", "ninja -C build/release palpate_c", shared_objects.System())
ARM64 = Target("aarch64", "arm64", cross_build("arm64"),
               shared_objects.System(licences.LIBRARIES / "arm64", "aarch64-linux-gnu", "aarch64-linux-gnu-strip"))


def with_everything_else(tree: pathlib.Path, release: Release, config: str) -> None:
    """What is the same for every system: header, C#, pkg-config, CMake, example, licence."""
    for part in ("include", "lib/pkgconfig", "lib/cmake/palpate_c", "share/palpate/csharp", "share/licenses", "examples"):
        (tree / part).mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / "LICENSE", tree / "share/licenses/palpate")
    shutil.copyfile(ROOT / "engine/bindings/c/palpate.h", tree / "include/palpate.h")
    shutil.copyfile(ROOT / "engine/bindings/c/samples/Palpate.cs", tree / "share/palpate/csharp/Palpate.cs")
    pc = (ROOT / "engine/bindings/c/palpate.pc.in").read_text()
    for key, value in (("CMAKE_INSTALL_LIBDIR", "lib"), ("PALPATE_PC_UP", "../.."), ("CMAKE_INSTALL_INCLUDEDIR", "include"), ("PROJECT_VERSION", release.version),
                       ("PROJECT_DESCRIPTION", "Haptic palpation: feel, see and measure touch on a soft body")):
        pc = pc.replace(f"@{key}@", value)
    (tree / "lib/pkgconfig/palpate.pc").write_text(pc)
    (tree / "lib/cmake/palpate_c/palpate_c-config.cmake").write_text(config)
    (tree / "lib/cmake/palpate_c/palpate_c-config-version.cmake").write_text(CONFIG_VERSION.replace("@VERSION@", release.version))
    for example in ("touch.c", "CMakeLists.txt"):
        shutil.copyfile(HERE / "first" / example, tree / "examples" / example)


def built_library(release: Release, target: Target) -> pathlib.Path:
    return wanted(target.build(release) / "engine/bindings/c" / f"libpalpate.so.{release.version}", target.how)


def make_linux(release: Release, target: Target) -> None:
    name = f"palpate-c-{release.version}-linux-{target.processor}"
    built = built_library(release, target)
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / name
        with_everything_else(tree, release, CONFIG_LINUX)
        library = tree / "lib" / built.name
        shutil.copyfile(built, library)
        library.chmod(0o755)
        target.system.stripped(library)
        brought = shared_objects.self_contained([library], tree / "lib/palpate", target.system)
        if target is LINUX:
            licences.of_this_machine(tree / "share/licenses", brought, target.build(release), ["palpate_c"])
        else:
            licences.of_packages(tree / "share/licenses", brought, target.build(release), "palpate_c", target.system)
        (tree / "lib/libpalpate.so.0").symlink_to(library.name)
        (tree / "lib/libpalpate.so").symlink_to("libpalpate.so.0")
        glibc = shared_objects.newest_symbol([library, *(tree / "lib/palpate").glob("*.so*")], "GLIBC")
        (tree / "README").write_text(README_LINUX.format(version=release.version, processor=target.processor.replace("x86_64", "x86-64"),
                                                         glibc=".".join(map(str, glibc))))
        archives.tar_gz(release.out / f"{name}.tar.gz", tree, name, release.epoch)


def make_c(release: Release) -> None:
    make_linux(release, LINUX)


def make_c_arm64(release: Release) -> None:
    make_linux(release, ARM64)


def exported(library: pathlib.Path) -> list:
    """The functions of a DLL, sorted."""
    listing = run("x86_64-w64-mingw32-objdump", "-p", library).split("[Ordinal/Name Pointer] Table", 1)[-1]
    return sorted(re.findall(r"(?m)^\s*\[\s*\d+\](?: \+base\[\s*\d+\])?\s+(?:[0-9a-f]+\s+)?(palpate_\w+)$", listing))


def windows_dll(release: Release, to: pathlib.Path) -> pathlib.Path:
    """palpate.dll, stripped."""
    built = wanted(release.build.parent / "win64/engine/bindings/c/palpate.dll", cross_build("win64"))
    if shutil.which("x86_64-w64-mingw32-strip") is None:
        raise Missing("x86_64-w64-mingw32-strip is not installed (tools/install-dependencies --platforms)")
    # A DLL holds the time when it was linked; strip would write its own.
    run("x86_64-w64-mingw32-strip", "--strip-unneeded", "-o", to, built, env=os.environ | {"SOURCE_DATE_EPOCH": str(release.epoch)})
    to.chmod(0o755)
    return built


def make_c_windows(release: Release) -> None:
    name = f"palpate-c-{release.version}-windows-x86_64"
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder) / name
        (tree / "bin").mkdir(parents=True)
        built = windows_dll(release, tree / "bin/palpate.dll")
        with_everything_else(tree, release, CONFIG_WINDOWS)
        shutil.copyfile(built.parent / "libpalpate.dll.a", tree / "lib/libpalpate.dll.a")
        functions = exported(built)
        declared = set(re.findall(r"\b(palpate_\w+)\(", (ROOT / "engine/bindings/c/palpate.h").read_text()))
        if set(functions) != declared:
            raise Missing(f"{built} and palpate.h differ in {sorted(declared ^ set(functions))}")
        (tree / "lib/palpate.def").write_text("LIBRARY palpate.dll\r\nEXPORTS\r\n" + "".join(f"  {function}\r\n" for function in functions))
        licences.of_windows(tree / "share/licenses", release.build.parent / "win64", "palpate_c")
        (tree / "README.txt").write_text(README_WINDOWS.format(version=release.version).replace("\n", "\r\n"), newline="")
        names = sorted(str(file.relative_to(tree.parent)) for file in tree.rglob("*") if file.is_file())
        archives.zip_of(release.out / f"{name}.zip", tree.parent, names, release.epoch)
