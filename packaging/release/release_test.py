"""Tests of what makes and verifies a release, in seconds and without a build.

  packaging/release/release_test.py
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from release import archives, artefacts, notes, trials  # noqa: E402

KEY = artefacts.HERE / "test_key/test.key"
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
        release = artefacts.Release(out, self.folder, self.folder, "1.2.3", 1_000_000_000, key)
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
        self.assertIn("In short", (artefacts.ROOT / "CHANGELOG.md").read_text())
        notes.cut((artefacts.ROOT / "CHANGELOG.md").read_text(), "0.2.0")


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
        refused = subprocess.run([files / "verify", artefacts.HERE / "test_key/test.pub"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("not signed", refused.stderr)


if __name__ == "__main__":
    unittest.main()
