"""Tests of what makes and verifies a release, in seconds and without a build.

  packaging/release/release_test.py
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from release import archives, artefacts, basics, c_library, licences, notes, shared_objects, trial, trials, trials_of_systems, unity  # noqa: E402

KEY = basics.HERE / "test_key/test.key"
CHANGELOG = """# Changelog

## [Unreleased]

### In short
- A new thing.

### Added
- Entry one.
- Entry two.

## [0.1.0] - 2026-01-01

### In short
- The first thing.

### Added
- Entry zero.
"""


class InAFolder(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def made(self, name: str, key=KEY) -> pathlib.Path:
        out = self.folder / name
        out.mkdir(parents=True)
        release = basics.Release(out, self.folder, self.folder, "1.2.3", 1_000_000_000, key)
        artefacts.make_bits(release)
        (out / "palpate-1.2.3.md").write_text(notes.cut(CHANGELOG, "1.2.3"))
        artefacts.bind(release)
        return out


class Notes(unittest.TestCase):
    def test_begin_with_a_page_and_end_with_every_entry(self):
        text = notes.cut(CHANGELOG, "0.1.0")
        self.assertIn("A new thing.", text)
        self.assertIn("# All 2 changes", text)
        self.assertLess(text.index("A new thing."), text.index("Entry one."))
        self.assertNotIn("Entry zero.", text)

    def test_are_of_the_version_when_nothing_is_unreleased(self):
        released = CHANGELOG[:CHANGELOG.index("### In short")] + CHANGELOG[CHANGELOG.index("## [0.1.0]"):]
        self.assertIn("The first thing.", notes.cut(released, "0.1.0"))

    def test_are_refused_without_a_page_or_with_more_than_one(self):
        with self.assertRaises(notes.NoNotes):
            notes.cut(CHANGELOG.replace("### In short", "### Brief"), "0.1.0")
        with self.assertRaises(notes.NoNotes):
            notes.cut(CHANGELOG.replace("- A new thing.", "- A new thing.\n" * 40), "0.1.0")

    def test_of_this_tree_can_be_cut(self):
        version = re.search(r"project\(palpate VERSION (\S+)", (basics.ROOT / "CMakeLists.txt").read_text())[1]
        self.assertTrue(notes.cut((basics.ROOT / "CHANGELOG.md").read_text(), version).startswith(f"# Palpate {version}"))


class OtherPythons(InAFolder):
    def test_are_missing_with_the_command_that_builds_them(self):
        release = basics.Release(self.folder, self.folder, self.folder, "1.2.3", 1_000_000_000, KEY)
        with self.assertRaisesRegex(basics.Missing, "tools/other-python 3.13"):
            artefacts.MAKERS["wheel-3.13"](release)

    def test_bring_the_licences_of_their_headers(self):
        (self.folder / "headers/licences").mkdir(parents=True)
        (self.folder / "headers/licences/pybind11-dev.copyright").write_text("BSD")
        licences.of_headers(self.folder, self.folder / "headers")
        self.assertEqual((self.folder / "pybind11-dev.copyright").read_text(), "BSD")


class Archives(InAFolder):
    def tree(self, name: str, mode: int) -> pathlib.Path:
        tree = self.folder / name
        (tree / "b").mkdir(parents=True)
        for file in ("b/two", "one"):
            (tree / file).write_text(file)
            (tree / file).chmod(mode)
        (tree / "link").symlink_to("one")
        return tree

    def test_are_the_same_whenever_and_by_whomever_they_are_made(self):
        listed = pathlib.Path.rglob
        for name, mode in (("first", 0o600), ("second", 0o664)):
            order = sorted if name == "first" else lambda files: sorted(files, reverse=True)  # as another file system lists them
            with unittest.mock.patch.object(pathlib.Path, "rglob", lambda *words: iter(order(listed(*words)))):
                archives.tar_gz(self.folder / f"{name}.tar.gz", self.tree(name, mode), "palpate", 7)
            archives.zip_of(self.folder / f"{name}.zip", self.folder / name, ["b/two", "one"], 7)
        for kind in ("tar.gz", "zip"):
            self.assertEqual((self.folder / f"first.{kind}").read_bytes(), (self.folder / f"second.{kind}").read_bytes())

    def test_differ_when_a_byte_does(self):
        trees = [self.tree("first", 0o644), self.tree("second", 0o644)]
        (trees[1] / "one").write_text("One")
        for tree in trees:
            archives.tar_gz(self.folder / f"{tree.name}.tar.gz", tree, "palpate", 7)
        self.assertNotEqual((self.folder / "first.tar.gz").read_bytes(), (self.folder / "second.tar.gz").read_bytes())


class LibrariesThatComeAlong(InAFolder):
    def test_have_names_that_no_other_version_has(self):
        file = self.folder / "libfmt.so.9.1.0"
        file.write_bytes(b"one")
        one = shared_objects.renamed("libfmt.so.9", file)
        self.assertRegex(one, r"^libfmt-[0-9a-f]{8}\.so\.9$")
        self.assertRegex(shared_objects.renamed_flat("libfmt.so.9", file), r"^libfmt-9-[0-9a-f]{8}\.so$")
        file.write_bytes(b"two")
        self.assertNotEqual(one, shared_objects.renamed("libfmt.so.9", file))

    def test_leave_the_driver_its_own(self):
        for name in ("libX11.so.6", "libxcb-shm.so.0", "libGL.so.1", "libc.so.6"):
            self.assertTrue(shared_objects.OF_A_DESKTOP.match(name), name)
        for name in ("libglfw.so.3", "libepoxy.so.0", "libgmp.so.10", "libstb.so.0"):
            self.assertFalse(shared_objects.OF_A_DESKTOP.match(name), name)
        self.assertFalse(shared_objects.OF_THE_SYSTEM.match("libX11.so.6"))

    def test_are_found_by_the_names_of_debians_packages(self):
        names = ("libfmt.so.9", "libsqlite3.so.0", "libz.so.1", "libtomlplusplus.so.3")
        self.assertEqual([licences.package_named(name) for name in names], ["libfmt9", "libsqlite3-0", "zlib1g", "libtomlplusplus3"])

    def test_are_refused_when_nobody_knows_their_licence(self):
        with self.assertRaisesRegex(basics.Missing, "does not know its licence"):
            licences.known(licences.PACKAGES, "unheard_of")

    def test_of_what_is_not_built_are_missing_with_the_command_that_builds_it(self):
        release = basics.Release(self.folder, self.folder / "build/release", self.folder, "1.2.3", 0, None)
        for make, command in ((c_library.make_c_arm64, "cmake --preset arm64"), (c_library.make_c_windows, "tools/platform-libraries win64")):
            with self.assertRaisesRegex(basics.Missing, command):
                make(release)


class UnityPackage(InAFolder):
    HEADS = {"x86_64/palpate.dll": b"MZ", "x86_64/libpalpate.so": 62, "arm64/libpalpate.so": 183}

    def setUp(self):
        super().setUp()
        heads_alone = unittest.mock.patch.object(shared_objects, "needed", lambda file: [])
        heads_alone.start()
        self.addCleanup(heads_alone.stop)
        self.package = self.made_package("package")

    def made_package(self, name: str) -> pathlib.Path:
        package = self.folder / name
        shutil.copytree(unity.SOURCE, package)
        for path, head in self.HEADS.items():
            file = package / "Plugins" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(head if isinstance(head, bytes) else b"\x7fELF" + bytes(14) + head.to_bytes(2, "little"))
        unity.fill_scene(package)
        unity.write_metas(package)
        return package

    def refused(self, why: str) -> None:
        with self.assertRaisesRegex(trial.Failed, why):
            trials_of_systems.check_metas(self.package)

    def test_has_the_same_numbers_wherever_it_is_made(self):
        other = self.made_package("elsewhere/deeper")
        self.assertGreater(trials_of_systems.check_metas(self.package), 10)
        for file in self.package.rglob("*.meta"):
            self.assertEqual(file.read_bytes(), (other / file.relative_to(self.package)).read_bytes(), file.name)

    def test_lacks_no_meta_and_has_none_too_many(self):
        (self.package / "Runtime/Palpate.asmdef.meta").unlink()
        self.refused("Palpate.asmdef has no .meta")
        (self.package / "Runtime/Palpate.asmdef.meta").write_text("guid: 0")
        self.refused("guid of Palpate.asmdef.meta is missing")
        (self.package / "Runtime/Palpate.asmdef").unlink()
        self.refused("is of nothing")

    def test_has_each_number_once(self):
        twice = (self.package / "README.md.meta").read_text()
        (self.package / "package.json.meta").write_text(twice)
        self.refused("README.md.meta, too|package.json.meta, too")

    def test_takes_each_plugin_along_where_it_belongs(self):
        arm, intel = (self.package / f"Plugins/{processor}/libpalpate.so" for processor in ("arm64", "x86_64"))
        arm.write_bytes(intel.read_bytes())
        self.refused("libpalpate.so is taken along for .*ARM64")

    def test_has_a_scene_with_the_script_of_the_sample(self):
        scene = self.package / "Samples~/FirstTouch/FirstTouch.unity"
        scene.write_text(scene.read_text().replace(unity.guid(unity.SCRIPT), unity.guid("README.md")))
        self.refused("another script")


@unittest.skipIf(shutil.which("minisign") is None, "minisign is not installed")
class Verify(InAFolder):
    def test_takes_a_release_and_refuses_every_change_of_it(self):
        said = trials.try_verify(self.made("files"), self.folder, False)
        self.assertIn("signed by that key", said)

    def test_signs_the_same_twice(self):
        one, two = self.made("one"), self.made("two/deeper")
        for file in sorted(one.iterdir()):
            self.assertEqual(file.read_bytes(), (two / file.name).read_bytes(), file.name)
        self.assertEqual(len(list(one.iterdir())), len(list(two.iterdir())))
        self.assertIn("\ntrusted comment: Palpate 1.2.3\n", (one / "SHA256SUMS.minisig").read_text())  # minisign's own has the time

    def test_says_what_it_did_not_check(self):
        files = self.made("files", key=None)
        done = subprocess.run([files / "verify", "--sums"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("signature was not checked", done.stdout)
        refused = subprocess.run([files / "verify", basics.HERE / "test_key/test.pub"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("not signed", refused.stderr)


if __name__ == "__main__":
    unittest.main()
