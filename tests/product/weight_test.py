#!/usr/bin/env python3
"""tools/weight on a small build and small sources of its own: figures from logs that are written here, and the gate of
weights.toml."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("weight", str(ROOT / "tools" / "weight"))
weight = importlib.util.module_from_spec(importlib.util.spec_from_loader("weight", loader))
loader.exec_module(weight)

GRAPH = """\
rule CXX_COMPILER__any
  depfile = $out.d
  deps = gcc
  command = c++ -std=c++20 -MD -MF $out.d -c $in -o $out
rule CXX_EXECUTABLE_LINKER__test_base
  command = c++ $in -o $out
build engine/core/CMakeFiles/palpate_base.dir/text.cpp.o: CXX_COMPILER__any text.cpp
build engine/core/CMakeFiles/test_base.dir/tests/base/text_test.cpp.o: CXX_COMPILER__any test.cpp
build instruments/study/lab/CMakeFiles/palpate_peers.dir/peer.cpp.o: CXX_COMPILER__any peer.cpp
build palpate_command: phony engine/core/CMakeFiles/palpate_base.dir/text.cpp.o
build tests/test_base: CXX_EXECUTABLE_LINKER__test_base engine/core/CMakeFiles/test_base.dir/tests/base/text_test.cpp.o | $
  engine/core/CMakeFiles/palpate_base.dir/text.cpp.o
build first_circle: phony tests/test_base palpate_command
build all: phony first_circle instruments/study/lab/CMakeFiles/palpate_peers.dir/peer.cpp.o
"""
TESTS = """\
add_test([=[base.Text]=] "{build}/tests/test_base")
add_test([=[base.Slow]=] "{build}/tests/test_base")
set_tests_properties([=[base.Slow]=] PROPERTIES LABELS "second")
"""
LAST_RUN = """\
1/1 Testing: base.Text
1/1 Test: base.Text
Output:
Test time =  30.00 sec
"""
FILES = {
    "build.ninja": GRAPH,
    "Testing/Temporary/CTestCostData.txt": "base.Text 3 20.5\nbase.Slow 1 300\n---\n",
    "Testing/Temporary/LastTest.log": LAST_RUN,
    "text.cpp": "int text() { return 1; }\n",
    "test.cpp": "int main() { return 0; }\n",
    "peer.cpp": "int peer() { return 1; }\n",
    "reference.cpp": "#include <cstddef>\nint main() { return 0; }\n",
}
SOURCES = {
    "engine/core/palpate/text.h": "// Text.\n#pragma once\n\nint text();\n",
    "engine/core/palpate/text.cpp": "// Text.\n#include \"palpate/text.h\"\n\nint text() { return 1; }\n",
    "engine/core/tests/text_test.cpp": "int main() { return 0; }\n",
    "engine/cli/say.cpp": 'auto option = "--loud";\n',
    "README.md": "# Two words\n",
}


class Weight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Builds once; every test has a copy."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.built = pathlib.Path(folder.name).resolve() / "built"
        for name, text in FILES.items():
            (cls.built / name).parent.mkdir(parents=True, exist_ok=True)
            (cls.built / name).write_text(text)
        subprocess.run(["ninja", "-C", cls.built, "all"], check=True, capture_output=True)
        # The clock of the reference unit stands still: what is tried here are figures, not this machine.
        weight.REFERENCE = cls.built / "reference.cpp"
        weigh_reference, reference = weight.weigh_reference, weight.weigh_reference("c++", timed=True)
        cls.timed_reference = reference
        cls.wall_s = 2.0
        weight.weigh_reference = lambda compiler, timed: reference._replace(cpu_s=2.0 if timed else None, wall_s=cls.wall_s)
        cls.addClassCleanup(setattr, weight, "weigh_reference", weigh_reference)

    def setUp(self):
        self.build = self.built.with_name(self.id())
        shutil.copytree(self.built, self.build)
        self.weights = self.build / "weights.toml"
        self.write("CTestTestfile.cmake", TESTS.format(build=self.build))
        self.sources = self.build / "sources"
        for name, text in SOURCES.items():
            self.write(f"sources/{name}", text)
        subprocess.run(["git", "init", "-q", self.sources], check=True)

    def write(self, name, text):
        (self.build / name).parent.mkdir(parents=True, exist_ok=True)
        (self.build / name).write_text(text)

    def ninja(self, *targets):
        subprocess.run(["ninja", "-C", self.build, *targets], check=True, capture_output=True)

    def run_tool(self, *arguments):
        """Exit code and all that is printed."""
        subprocess.run(["git", "-C", self.sources, "add", "-A"], check=True)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            code = weight.main(["--build", str(self.build), "--weights", str(self.weights), "--sources", str(self.sources), *arguments])
        return code, printed.getvalue()

    def figures(self):
        code, printed = self.run_tool("--json")
        self.assertEqual(code, 0, printed)
        return json.loads(printed)

    def scale(self, product, figure, factor):
        """Multiplies a figure of weights.toml, as if it had been that when it was written."""
        head, mark, table = self.weights.read_text().partition(f"[{product}]")
        was = float(re.search(rf"^{figure} = (.+)$", table, re.M)[1])
        table = re.sub(rf"^{figure} = .+$", f"{figure} = {was * factor:.6f}", table, count=1, flags=re.M)
        self.weights.write_text(head + mark + table)
        return was

    def give_reason(self, product, line):
        text = self.weights.read_text()
        self.weights.write_text(text.replace(f"[{product}]\n", f"[{product}]\nreasons = [{line}]\n"))

    # Mass.

    def test_mass_is_counted_from_the_sources(self):
        found = self.figures()
        core = found["products"]["core"]
        self.assertEqual(core["lines"], 4)  # an include is code, a comment is not
        self.assertEqual(core["test_lines"], 1)
        self.assertEqual(core["names"], 2)  # int, text
        self.assertEqual(found["products"]["cli"]["options"], 1)
        self.assertEqual(found["products"]["docs"]["words"], 3)
        self.assertEqual(found["total"]["lines"], 5)

    def test_folding_two_files_into_one_changes_no_mass_but_shows_a_second_head(self):
        self.write("sources/engine/core/palpate/other.h", "// Another\n// purpose.\n#pragma once\n\nint other();\n")
        apart = self.figures()["products"]["core"]
        (self.sources / "engine/core/palpate/other.h").unlink()
        self.write("sources/engine/core/palpate/text.h", SOURCES["engine/core/palpate/text.h"] + "\n// Another\n// purpose.\n\nint other();\n")
        folded = self.figures()["products"]["core"]
        self.assertEqual(folded["names"], apart["names"])
        self.assertEqual(folded["lines"], apart["lines"] - 1)  # one #pragma once
        self.assertEqual((apart["second_heads"], folded["second_heads"]), (0, 1))

    def test_numbers_in_code_are_data(self):
        self.assertEqual(self.figures()["products"]["core"]["data_bytes"], 0)
        rows = "  {0x1.8p-1, -2.5e-3f},\n" * 100
        self.write("sources/engine/core/palpate/table.cpp", f"const double kTable[][2] = {{\n{rows}}};\n")
        self.write("sources/engine/core/palpate/row.inc", "1, 2\n")
        self.write("sources/engine/core/palpate/small.cpp", "const int kSmall[] = {\n  1, 2,\n  3, 4,\n  5, 6,\n  7, 8,\n};\n")
        self.write("sources/engine/core/palpate/row_numbers.txt", "double[] kRow\n" + "1, 2\n" * 1000)
        self.assertEqual(self.figures()["products"]["core"]["data_bytes"], len(rows) + len("1, 2\n"))

    def test_one_line_more_needs_a_reason(self):
        self.run_tool("--update")
        self.assertEqual(self.run_tool("--check")[0], 0)
        self.write("sources/engine/core/palpate/text.cpp", SOURCES["engine/core/palpate/text.cpp"] + "int more() { return 2; }\n")
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 1)
        self.assertIn("core: lines was 4, is 5 (25.0 % more)", printed)
        self.give_reason("core", '"lines 5: more is said", "characters 1000: likewise"')
        self.assertEqual(self.run_tool("--check")[0], 0, printed)

    def test_what_only_the_build_left_behind_weighs_nothing(self):
        before = self.figures()["total"]
        self.write("sources/.gitignore", "made.h\n")
        self.write("sources/engine/core/palpate/made.h", "int made();\n")
        self.assertEqual(self.figures()["total"], before)

    # Figures.

    def test_totals_come_from_the_logs(self):
        self.write(".ninja_log", "# ninja log v5\n"
                   "0\t1000\t5000000000\tengine/core/CMakeFiles/palpate_base.dir/text.cpp.o\t1\n"
                   "0\t9000\t5000000000\tengine/core/CMakeFiles/palpate_base.dir/text.cpp.o\t2\n"  # built again: the latest counts
                   "0\t7000\t5000000000\tno/longer/built.o\t3\n"
                   "9000\t10500\t6500000000\tinstruments/study/lab/CMakeFiles/palpate_peers.dir/peer.cpp.o\t4\n")
        found = self.figures()
        self.assertEqual(found["step_seconds"], 10.5)
        self.assertEqual(found["run_step_seconds"], 9.0)
        self.assertEqual(found["run_ratio"], 4.5)
        self.assertEqual(found["test_seconds_first"], 30.0)  # the last run, not the mean
        self.assertEqual(found["test_seconds_all"], 330.0)
        self.assertEqual(found["reference_unit_s"], 2.0)
        self.assertEqual(found["test_ratio"], 15.0)
        self.assertEqual(found["products"]["core"]["tests_all"], 165.0)
        self.assertEqual(self.figures(), found)  # looking changes nothing

    def test_steps_share_the_cores_of_their_run(self):
        steps = {"a": weight.Step(0, 4000, 0), "b": weight.Step(0, 2000, 10), "c": weight.Step(0, 2000, 1e9)}  # c: another run
        self.assertEqual(weight.core_seconds(steps, 1), {"a": 3.0, "b": 1.0, "c": 2.0})
        self.assertEqual(weight.core_seconds(steps, 2), {"a": 4.0, "b": 2.0, "c": 2.0})

    def test_units_belong_to_their_product_and_its_tests(self):
        edges = weight.read_graph(GRAPH)
        self.assertEqual(weight.product_of("engine/core/CMakeFiles/palpate_base.dir/text.cpp.o", edges), ("core", False))
        self.assertEqual(weight.product_of("tests/test_base", edges), ("core", True))  # a program is its objects'
        self.assertEqual(weight.product_of("CMakeFiles/palpate_test_support.dir/a.cpp.o", edges), ("tests", True))
        self.assertEqual(weight.product_of("CMakeFiles/palpate_programs.dir/cmake_pch.hxx.gch", edges), ("common", False))
        products = self.figures()["products"]
        self.assertGreater(products["core"]["build"], 0)
        self.assertGreater(products["core"]["tests_build"], 0)
        self.assertEqual(products["core"]["rest_build"], 0)
        self.assertGreater(products["lab"]["rest_build"], 0)  # not in the first circle
        self.assertEqual(products["lab"]["build"], 0)

    def test_a_test_belongs_to_its_program_or_to_the_list_that_adds_it(self):
        edges = weight.read_graph(GRAPH + "build palpate: CXX_EXECUTABLE_LINKER__palpate engine/cli/CMakeFiles/palpate_command.dir/main.cpp.o\n")
        shown = {"backtraceGraph": {"files": ["CMakeLists.txt", "engine/bindings/c/tests/tests.cmake", "engine/bindings/c/CMakeLists.txt"],
                                    "nodes": [{"file": 0}, {"file": 2, "parent": 0}, {"file": 1, "parent": 1}]},
                 "tests": [{"name": "base.Text", "command": [f"{self.build}/tests/test_base"]},
                           {"name": "c.simulate", "command": [f"{self.build}/palpate"], "backtrace": 2},
                           {"name": "packaging.Papers", "command": ["/usr/bin/python3"], "backtrace": 0},
                           {"name": "not.Built", "properties": [{"name": "LABELS", "value": ["slow", "second"]}]}]}
        self.assertEqual(weight.read_tests(shown, self.build, edges),
                         [("base.Text", "core", False), ("c.simulate", "bindings", False), ("packaging.Papers", "tests", False),
                          ("not.Built", "tests", True)])

    def test_debug_information_weighs_nothing(self):
        for flag in ("-g0", "-g"):
            subprocess.run(["c++", flag, "-c", self.build / "text.cpp", "-o", self.build / f"{flag}.o"], check=True)
        plain, debugged = (weight.object_bytes(self.build / f"{flag}.o") for flag in ("-g0", "-g"))
        self.assertGreater((self.build / "-g.o").stat().st_size, (self.build / "-g0.o").stat().st_size + 500)
        self.assertLess(debugged, plain + 1000)  # names of the sections, and where they are

    def test_the_reference_unit_is_timed_with_all_cores_busy(self):
        reference = self.timed_reference
        self.assertGreater(reference.wall_s, 0)
        self.assertGreater(reference.cpu_s, 0)
        self.assertGreater(reference.counted, weight.REFERENCE_SHARE * weight.SECONDS_PER_UNIT)
        self.assertRegex(reference.compiler, r"\d+\.\d+")

    def test_what_has_not_run_is_null(self):
        (self.build / "Testing/Temporary/CTestCostData.txt").unlink()
        found = self.figures()
        self.assertEqual(found["test_seconds_first"], 30.0)
        self.assertIsNone(found["test_seconds_all"])
        (self.build / "Testing/Temporary/LastTest.log").unlink()
        self.assertIsNone(self.figures()["test_ratio"])

    # The gate.

    def test_the_same_sources_weigh_the_same(self):
        self.run_tool("--renew")
        before = self.weights.read_text()
        (self.build / "engine/core/CMakeFiles/palpate_base.dir/text.cpp.o").unlink()
        self.ninja("all")
        self.assertEqual(self.run_tool("--check")[0], 0)
        self.run_tool("--update")
        self.assertEqual(self.weights.read_text(), before)

    def test_a_heavier_header_is_seen(self):
        self.run_tool("--renew")
        self.write("text.cpp", "#include <string>\nint text() { return std::string(\"1\").size(); }\n")
        self.ninja("all")
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 1)
        self.assertIn("core: build was", printed)
        self.assertEqual(self.run_tool()[0], 0)  # prints, judges nothing

    def test_a_rise_of_more_than_3_percent_needs_a_reason(self):
        self.run_tool("--renew")
        self.scale("core", "build", 1 / 1.02)
        self.assertEqual(self.run_tool("--check")[0], 0)
        now = self.scale("core", "build", 1.02 / 1.04) * 1.02
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 1)
        line = re.search(r"core: build was [.\d]+, is ([.\d]+) reference units .*under \[core\]: reasons = \[(\".*\")\]", printed)
        self.assertIsNotNone(line, printed)
        self.assertAlmostEqual(float(line[1]), now, delta=0.02)
        without = self.weights.read_text()
        self.give_reason("lab", line[2])
        self.assertEqual(self.run_tool("--check")[0], 1)  # another product's reason does not count
        self.weights.write_text(without)
        self.give_reason("core", line[2].replace("build", "tests_build"))
        self.assertEqual(self.run_tool("--check")[0], 1)  # nor does another figure's
        self.weights.write_text(without)
        self.give_reason("core", line[2])
        self.assertEqual(self.run_tool("--check")[0], 0)

    def test_measured_figures_have_room_for_noise(self):
        self.run_tool("--renew")
        was = self.scale("core", "tests_all", 1 / 1.4)
        self.assertEqual(self.run_tool("--check", "--clock")[0], 0)
        self.scale("core", "tests_all", 1.4 / 1.6)
        code, printed = self.run_tool("--check", "--clock")
        self.assertEqual(code, 1, printed + self.weights.read_text())
        self.assertIn(f"core: tests_all was {was / 1.6:.2f}", printed)
        self.assertEqual(self.run_tool("--check")[0], 0)  # named, and no more: other work doubles them
        self.assertIn(f"core: tests_all was {was / 1.6:.2f}", self.run_tool("--check")[1])
        self.assertEqual(self.run_tool("--check", "--clock", "--quick")[0], 0)  # without a clock they are not judged
        self.scale("core", "tests_all", 1.6)
        self.scale("core", "tests_first", 1 / 1.45)  # 15.0: less than 5 units more
        self.assertEqual(self.run_tool("--check", "--clock")[0], 0)
        self.scale("core", "tests_first", 1.45 / 1.6)
        self.assertEqual(self.run_tool("--check", "--clock")[0], 1)

    def test_measured_figures_are_not_judged_beside_other_work(self):
        self.run_tool("--renew")
        self.scale("core", "tests_all", 1 / 1.6)
        self.assertEqual(self.run_tool("--check", "--clock")[0], 1)
        type(self).wall_s = 3.5
        self.addCleanup(setattr, type(self), "wall_s", 2.0)
        code, printed = self.run_tool("--check", "--clock")
        self.assertEqual(code, 0)
        before = self.weights.read_text()
        self.assertIn("measured figures stay", self.run_tool("--renew")[1])
        self.assertEqual(re.findall("tests_all = (.*)", self.weights.read_text())[0], "103.12")
        self.weights.write_text(before)
        self.assertIn("measured figures: other work takes the cores", printed)
        self.scale("core", "build", 1 / 1.04)  # counted ones are
        self.assertEqual(self.run_tool("--check")[0], 1)

    def test_update_lowers_and_raises_only_with_a_reason(self):
        self.run_tool("--renew")
        now = self.scale("core", "build", 1.5)
        self.assertIn("may be lowered", self.run_tool("--check")[1])
        self.run_tool("--update")
        self.assertIn(f"build = {now:.2f}\n", self.weights.read_text())
        self.scale("core", "build", 0.5)
        self.run_tool("--update")
        self.assertIn(f"build = {now / 2:.2f}\n", self.weights.read_text())
        self.give_reason("core", f'"build {now:.2f}: \\"quoted\\" reasons stay"')
        self.run_tool("--update")
        text = self.weights.read_text()
        self.assertIn(f"build = {now:.2f}\n", text)
        self.assertIn('\\"quoted\\" reasons stay"', text)

    def test_what_is_not_built_or_another_compiler_is_not_judged(self):
        self.run_tool("--renew")
        self.scale("core", "build", 0.5)
        self.assertEqual(self.run_tool("--check")[0], 1)
        text = self.weights.read_text()
        self.weights.write_text(re.sub("^compiler = .*$", 'compiler = "another"', text, flags=re.M))
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 0)
        self.assertIn("was written with another", printed)
        self.weights.write_text(text)
        (self.build / "engine/core/CMakeFiles/palpate_base.dir/text.cpp.o").unlink()
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 0)
        self.assertIn("core: build is not there", printed)

    def test_a_new_product_needs_a_line(self):
        self.run_tool("--renew")
        text = self.weights.read_text()
        self.weights.write_text(text[:text.index("[lab]")])
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 1)
        self.assertRegex(printed, r"lab: rest_build was 0.00, is .*\(new\)")

    # Broken files.

    def assert_refused(self, name, line, about):
        code, printed = self.run_tool("--check")
        self.assertEqual(code, 2, printed)
        self.assertIn(f"{name}:{line}: ", printed)
        self.assertIn(about, printed)

    def test_broken_files_are_refused_with_their_line(self):
        for text, line, about in (("compiler = \"x\"\n[core\n", 2, "Expected"),
                                  ("[core]\nbuild = 1.0\n", 1, "expected compiler"),
                                  ("compiler = \"x\"\n\n[kernel]\nbuild = 1.0\n", 3, "kernel is not a product"),
                                  ("compiler = \"x\"\n[host]\nbuild = 1.0\n[core]\ngravity = 1.0\n", 5, "gravity is not a figure"),
                                  ("compiler = \"x\"\n[host]\nbuild = 1.0\n[core]\nbuild = -1.0\n", 5, "at least 0, got -1.0"),
                                  ("compiler = \"x\"\n[core]\nbuild = \"heavy\"\n", 3, "must be a number"),
                                  ("compiler = \"x\"\n[core]\nbuild = 1.0\nreasons = [\"because\"]\n", 4, "FIGURE VALUE: why"),
                                  ("compiler = \"x\"\n[core]\nreasons = [\n\"build 2.0:  \"]\n", 4, "FIGURE VALUE: why")):
            with self.subTest(about):
                self.weights.write_text(text)
                self.assert_refused("weights.toml", line, about)
        self.weights.unlink()
        self.write(".ninja_log", "# ninja log v5\n0\t1000\n")
        self.assert_refused(".ninja_log", 2, "expected start, end")
        (self.build / ".ninja_log").unlink()
        self.write("Testing/Temporary/CTestCostData.txt", "base.Text 3 20.5\nbase.Slow many\n---\n")
        self.assert_refused("CTestCostData.txt", 2, "expected test, runs and seconds")
        (self.build / "build.ninja").unlink()
        code, printed = self.run_tool("--check")
        self.assertEqual((code, "build.ninja" in printed), (2, True))


if __name__ == "__main__":
    unittest.main()
