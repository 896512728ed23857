"""Builds the package with CMake: `pip install engine/bindings/python` (docs/reference/python.md).

PALPATE_STAGED: folder of a build that is there already (build/release/python); nothing is compiled then.
PALPATE_CMAKE_ARGUMENTS: more arguments for CMake.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
# In the repository this file lies in engine/bindings/python, in a source distribution at the top.
SOURCE = HERE if (HERE / "engine").is_dir() else HERE.parents[2]
BUILD = SOURCE / "build" / f"python-{sys.version_info.major}.{sys.version_info.minor}"


def staged() -> pathlib.Path:
    """The folder that holds the whole package, built where it is not."""
    if "PALPATE_STAGED" in os.environ:
        return pathlib.Path(os.environ["PALPATE_STAGED"])
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    options = ["APPS", "TESTS", "EXAMPLES", "BENCHMARKS", "C"]
    subprocess.run(["cmake", "-S", str(SOURCE), "-B", str(BUILD), *generator, "-DCMAKE_BUILD_TYPE=Release",
                    "-DPALPATE_BUILD_PYTHON=ON", "-DPALPATE_PEERS=OFF", f"-DPython3_EXECUTABLE={sys.executable}",
                    *[f"-DPALPATE_BUILD_{option}=OFF" for option in options],
                    *shlex.split(os.environ.get("PALPATE_CMAKE_ARGUMENTS", ""))], check=True)
    subprocess.run(["cmake", "--build", str(BUILD), "--target", "palpate_python", "--parallel"], check=True)
    return BUILD / "python"


class Build(build_py):
    """Copies what CMake has staged: Python files, stubs and modules."""

    def run(self) -> None:
        package = staged() / "palpate"
        files = [file for folder in (package, package / "gym") for file in folder.iterdir()
                 if file.suffix in (".py", ".pyi", ".so", ".typed")]
        if not any(file.name.startswith("_core.") and file.suffix == ".so" for file in files):
            raise SystemExit("no module was built: pybind11 or Python's headers are missing (python3-dev, pybind11-dev)")
        for file in files:
            to = pathlib.Path(self.build_lib) / "palpate" / file.relative_to(package)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, to)
            if file.suffix == ".so" and shutil.which("strip"):
                subprocess.run(["strip", "--strip-unneeded", str(to)], check=True)


class Compiled(Distribution):
    """The wheel is of one Python and one machine."""

    def has_ext_modules(self) -> bool:
        return True


VERSION = re.search(r"project\(palpate VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
setup(version=VERSION, packages=["palpate", "palpate.gym"], package_dir={"palpate": os.path.relpath(SOURCE / "engine/bindings/python/palpate", HERE)}, cmdclass={"build_py": Build}, distclass=Compiled)
