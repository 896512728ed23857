#!/usr/bin/env python3
"""tools/words counts what is there, and lists where."""
import json
import pathlib
import subprocess
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "words"
HEADER = """// Of a dent.
#pragma once
int depthOf(int dent);  ///< What somebody felt, where there is no dent.
/// Returns the depth; a hole is no dent.
int depth(int dent);
void tellAll();
const char* depthWords();
"""
SOURCE = 'void f() {\n  throw Error("' + "word " * 13 + '{}"\n              "' + "word " * 13 + '");\n}\n'
# What the project's own sources may hold. x_of: where the field itself says so (indexOf), and public names.
BARS = {"x_of": 120, "tell_take_keep": 20, "words_functions": 10, "what_of_per_1000": 8, "somebody_nobody": 10, "is_no": 10,
        "long_errors": 0, "long_sentences_percent": 3}
PAGE = "# A title\n\nShort. " + "long " * 31 + "end.\n\n```\n" + "code " * 40 + "\n```\n"


class Words(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in {"core/a.h": HEADER, "core/a.cpp": SOURCE, "core/tests/a.cpp": HEADER, "docs/howto/a.md": PAGE}.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)
        subprocess.run(["git", "init", "-q"], cwd=self.root, check=True)
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)

    def run_tool(self, *more):
        run = subprocess.run([TOOL, "--sources", self.root, *more], capture_output=True, text=True)
        return run.returncode, run.stdout + run.stderr

    def test_counts_names_comments_and_sentences_outside_tests(self):
        figures = json.loads(self.run_tool("--json")[1])
        self.assertEqual((figures["x_of"], figures["tell_take_keep"], figures["words_functions"]), (1, 1, 1))
        self.assertEqual((figures["what_of_comments"], figures["somebody_nobody"], figures["is_no"]), (2, 1, 2))
        self.assertEqual(figures["what_of_per_1000"], 666.7)  # of three
        self.assertEqual((figures["long_errors"], figures["long_sentences"]), (1, 1))
        self.assertEqual(figures["long_sentences_percent"], 50.0)

    def test_this_project_stays_within_its_bars(self):
        figures = json.loads(subprocess.run([TOOL, "--json"], capture_output=True, text=True, check=True).stdout)
        self.assertEqual({name: figures[name] for name, bar in BARS.items() if figures[name] > bar}, {})

    def test_lists_the_places(self):
        self.assertIn("core/a.h:3: What somebody felt", self.run_tool("--list", "what_of_comments")[1])
        self.assertEqual(self.run_tool("--list", "long_errors")[1], "core/a.cpp:2\n")

    def test_names_the_counts_there_are(self):
        code, printed = self.run_tool("--list", "x")
        self.assertEqual(code, 2)
        self.assertIn("x_of", printed)


if __name__ == "__main__":
    unittest.main()
