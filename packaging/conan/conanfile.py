"""Recipe for Conan 2: conan create packaging/conan

It builds the source tree that it lies in. Not tried: see docs/reference/c-api.md.
"""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Palpate(ConanFile):
    name = "palpate"
    version = "0.3.0"
    license = "Apache-2.0"
    description = "Haptic palpation: feel, see and measure touch on a soft body"
    settings = "os", "arch", "compiler", "build_type"
    options = {"assimp": [True, False]}
    default_options = {"assimp": False}
    package_type = "library"

    def export_sources(self):
        root = os.path.normpath(os.path.join(self.recipe_folder, "..", ".."))
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "engine/core/*", "engine/host/*", "engine/bindings/c/*", "examples/scenes/*", "instruments/study/solve/*",
                        "packaging/*"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def requirements(self):
        headers = {"transitive_headers": True}
        self.requires("eigen/3.4.0", **headers)
        self.requires("fmt/9.1.0")
        self.requires("highway/1.0.3")
        self.requires("tomlplusplus/3.3.0")
        self.requires("nlohmann_json/3.11.2")
        self.requires("sqlite3/3.40.1")
        self.requires("zlib/1.2.13")
        if self.options.assimp:
            self.requires("assimp/5.2.2")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part in ("APPS", "TESTS", "EXAMPLES", "VIEW", "MEASURE", "PYTHON"):
            toolchain.variables[f"PALPATE_BUILD_{part}"] = False
        toolchain.variables["PALPATE_PEERS"] = False
        toolchain.variables["PALPATE_BUILD_C"] = True
        toolchain.variables["PALPATE_ASSIMP"] = bool(self.options.assimp)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # libpalpate.a and libpalpate.so lie side by side: the project's own CMake files and palpate.pc tell them apart.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "palpate")]
