// `palpate bench --baseline FILE`: which kernel got slower since the file was written, and by how much.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/palpate/baseline_file.h"
#include "apps/palpate/bench_commands.h"
#include "apps/palpate/bench_report.h"
#include "apps/palpate/progress_line.h"

namespace palpate::app {
namespace {

constexpr int kSlower = 1;  // exit code: the answer is "no"

struct Arguments {
  std::string baseline, write;
  std::size_t triangles = 41582;
  double tolerance = 0.3;
  double seconds = 4.0;
  bool json = false;
};

nlohmann::ordered_json ratioJson(const std::optional<double>& ratio) {
  return ratio ? nlohmann::ordered_json(*ratio) : nlohmann::ordered_json(nullptr);
}

std::string ratioText(const std::optional<double>& ratio) { return ratio ? fmt::format("{:.3f}", *ratio) : "-"; }

std::string verdict(const bench::Comparison& c) {
  if (!c.before) return "not in the file";
  if (!c.now) return "no such kernel any more";
  return fmt::format("{:.2f} x{}", c.change(), c.slower ? "  SLOWER" : "");
}

nlohmann::ordered_json jsonOf(const std::vector<bench::Comparison>& all, double tolerance) {
  nlohmann::ordered_json json;
  json["tolerance"] = tolerance;
  json["slower"] = nlohmann::ordered_json::array();
  for (const bench::Comparison& c : all) {
    if (c.slower) json["slower"].push_back(c.name);
    json["kernels"].push_back({{"name", c.name},
                               {"before", ratioJson(c.before)},
                               {"now", ratioJson(c.now)},
                               {"change", c.before && c.now ? ratioJson(c.change()) : nullptr},
                               {"slower", c.slower}});
  }
  return json;
}

std::string textOf(const std::vector<bench::Comparison>& all, double tolerance) {
  std::string text =
      fmt::format("{:<22} {:>9} {:>9}   now / before, both as ratios to a fixed loop\n", "kernel", "before", "now");
  for (const bench::Comparison& c : all) {
    text += fmt::format("{:<22} {:>9} {:>9}   {}\n", c.name, ratioText(c.before), ratioText(c.now), verdict(c));
  }
  const auto slower = std::count_if(all.begin(), all.end(), [](const bench::Comparison& c) { return c.slower; });
  return text + fmt::format("{} of {} kernels slower by more than {:.0f} %\n", slower, all.size(), 100.0 * tolerance);
}

Baseline measure(std::size_t triangles, double seconds) {
  ProgressLine progress;
  progress.show("preparing the kernels", 0.0);
  const std::vector<bench::Kernel> kernels = bench::makeKernels(triangles);
  progress.show("measuring the kernels", 0.5);
  return {triangles, bench::timeKernels(kernels, seconds)};
}

void compareWith(const Arguments& arguments) {
  const Baseline before = readBaseline(arguments.baseline);
  const Baseline now = measure(before.triangles, arguments.seconds);
  const auto all = bench::compared(before.kernels, now.kernels, arguments.tolerance);
  printReport(jsonOf(all, arguments.tolerance), textOf(all, arguments.tolerance), arguments.json);
  if (std::any_of(all.begin(), all.end(), [](const bench::Comparison& c) { return c.slower; })) {
    throw CLI::RuntimeError(kSlower);
  }
}

void run(const CLI::App& bench, const Arguments& arguments) {
  if (!bench.get_subcommands().empty()) return;
  if (!arguments.write.empty()) writeBaseline(arguments.write, measure(arguments.triangles, arguments.seconds));
  if (!arguments.baseline.empty()) compareWith(arguments);
  if (arguments.baseline.empty() && arguments.write.empty()) throw CLI::RequiredError::Subcommand(1);
}

}  // namespace

void addBenchBaseline(CLI::App& bench) {
  auto arguments = std::make_shared<Arguments>();
  const auto option = [&](const char* name, auto& value, const char* help) {
    return bench.add_option(name, value, help)->group("Regression guard (without a subcommand)");
  };
  option("--baseline", arguments->baseline, "Compare with the ratios in this file; exit 1 if a kernel got slower");
  option("--write-baseline", arguments->write, "Measure and write such a file");
  option("--tolerance", arguments->tolerance, "How much a ratio may grow: 0.3 is 30 %")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  option("--guard-seconds", arguments->seconds, "How long to measure all kernels together, s")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 600.0));
  option("--guard-triangles", arguments->triangles, "Triangles of the back, for --write-baseline")
      ->capture_default_str()
      ->check(CLI::Range(1000, 4000000));
  bench.add_flag("--json", arguments->json, "Print the comparison as one JSON object")
      ->group("Regression guard (without a subcommand)");
  bench.callback([&bench, arguments] { run(bench, *arguments); });
}

}  // namespace palpate::app
