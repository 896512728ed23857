#!/usr/bin/env python3
"""tools/docs puts what a command prints into the pages that ask for it: every insert of every page, by the real programs."""
import contextlib
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("docs", str(ROOT / "tools" / "docs"))
docs = importlib.util.module_from_spec(importlib.util.spec_from_loader("docs", loader))
loader.exec_module(docs)
docs.PROGRAMS = pathlib.Path(os.environ.get("PALPATE_PROGRAMS", docs.PROGRAMS))


def staged(text):
    """A page as the site has it."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder) / "page.md", pathlib.Path(folder) / "site" / "page.md"
        source.write_text(text)
        docs.Stage().page(source, target)
        return target.read_text()


class Inserts(unittest.TestCase):
    def test_every_insert_of_every_page_is_replaced_and_every_command_is_used(self):
        used = set()
        for page in (ROOT / "docs").rglob("*.md"):
            text = page.read_text()
            used |= set(re.findall(r"^<!-- insert: (.+) -->$", text, re.M))
            if "<!-- insert:" in text:
                self.assertNotIn("<!-- insert:", staged(text), page)
        self.assertEqual(used, set(docs.INSERTS))

    def test_the_page_of_scene_files_has_a_row_of_every_key(self):
        page = staged((ROOT / "docs/reference/scene-files.md").read_text())
        header = (ROOT / "engine/host/palpate/scene/detail/scene_keys.h").read_text()
        self.assertEqual(len(re.findall(r"^\| `", page, re.M)), int(re.search(r"kSceneKeys = (\d+)", header)[1]))
        self.assertIn("### `[body]`", page)

    def test_the_page_of_the_viewer_has_the_keys(self):
        page = staged((ROOT / "docs/reference/viewer.md").read_text())
        for group in ("Touch", "View", "Overlays", "Window", "File"):
            self.assertIn(f"### {group}\n\n| key | does |", page)
        self.assertRegex(page, r"\| F11 \| .*screen")

    def test_the_page_of_records_has_its_tables(self):
        page = staged((ROOT / "docs/reference/results-schema.md").read_text())
        self.assertIn("### site_visit", page)
        self.assertIn("| `peak_force_n` | number | N | 1 |", page)

    def test_the_page_of_the_dissertation_has_its_errata(self):
        page = staged((ROOT / "docs/reference/dissertation.md").read_text())
        self.assertEqual(len(re.findall(r"^\| E\d+ \| .* \| .* \| .* \| .* \|$", page, re.M)), 34)

    def test_what_is_no_markdown_is_shown_as_code(self):
        page = staged((ROOT / "docs/reference/tissue-tables.md").read_text())
        self.assertRegex(page, r"```\ntissue +kPa +how: source\nskin +150 \* ")

    def test_code_is_left_as_it_is(self):
        text = "```\n<!-- insert: palpate simulate --keys -->\n```"
        self.assertEqual(staged(text), text)

    def test_an_unknown_command_and_a_missing_program_are_errors(self):
        with self.assertRaisesRegex(SystemExit, "not among the commands"):
            staged("<!-- insert: palpate devices -->")
        with tempfile.TemporaryDirectory() as empty, programs(empty), self.assertRaisesRegex(SystemExit, "no such program"):
            staged("<!-- insert: palpate simulate --keys -->")

    def test_a_command_that_fails_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder, programs(folder):
            program = pathlib.Path(folder) / "palpate"
            program.write_text("#!/bin/sh\necho half a table\necho broken >&2\nexit 3\n")
            program.chmod(0o755)
            with self.assertRaisesRegex(SystemExit, "broken"):
                staged("<!-- insert: palpate simulate --keys -->")


@contextlib.contextmanager
def programs(folder):
    kept, docs.PROGRAMS = docs.PROGRAMS, pathlib.Path(folder)
    try:
        yield
    finally:
        docs.PROGRAMS = kept


if __name__ == "__main__":
    unittest.main()
