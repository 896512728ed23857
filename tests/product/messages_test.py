#!/usr/bin/env python3
"""tools/list-messages finds every kind of message, and where it is."""
import json
import pathlib
import subprocess
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "list-messages"
SOURCE = """// throw Error("not code");
void f(World& world) {
  throw Error::inFile(file, fmt::format("no triangles "
                                        "in {}{}", name, ": none"));
  world.notes.push_back(fmt::format("unit \\"{}\\" guessed", unit));
  addNumber(command, "--at", at, between(0, 1, "s"), "Moment of the run");
  throw UsageError("--at and --pose", tr("Choose one."));
}
"""
MESSAGES = [(3, "error", "no triangles in {}{} ... : none"), (5, "note", 'unit "{}" guessed'), (6, "help", "Moment of the run"),
            (7, "error", "Choose one."), (7, "translated", "Choose one.")]


class Messages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("core/a.cpp", "core/tests/a.cpp"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(SOURCE)
        subprocess.run(["git", "init", "-q"], cwd=self.root, check=True)
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)

    def run_tool(self, *more):
        return subprocess.run([TOOL, "--sources", self.root, *more], capture_output=True, text=True, check=True).stdout

    def test_finds_every_kind_outside_tests(self):
        found = json.loads(self.run_tool("--json"))
        self.assertEqual([(row["line"], row["kind"], row["text"]) for row in found], MESSAGES)
        self.assertEqual({row["file"] for row in found}, {"core/a.cpp"})

    def test_lists_the_long_ones(self):
        self.assertEqual(self.run_tool("--long", "5"), "core/a.cpp:3: error: no triangles in {}{} ... : none\n")


if __name__ == "__main__":
    unittest.main()
