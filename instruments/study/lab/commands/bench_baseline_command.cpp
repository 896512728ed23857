// `palpate study bench --baseline FILE`: which kernel got slower since the file was written, and by how much.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "cli/kit/json.h"
#include "cli/kit/number_option.h"
#include "cli/kit/options.h"
#include "cli/kit/progress_line.h"
#include "lab/commands/bench_report.h"
#include "lab/counters/machine.h"
#include "lab/kernels/kernel_times.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

/// Contents of the file: ratios of kernels to fixed reference loops, measured on some machine.
struct Baseline {
  std::string file;
  std::string simd;           ///< vectors of the machine it was measured on; empty where the file does not name them
  std::size_t triangles = 0;  ///< on the back that the kernels ran on
  std::vector<bench::KernelTime> kernels;
};

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMinTriangles = 1000, kMaxTriangles = 4000000;

bench::KernelTime kernelFrom(const Json& json) {
  bench::KernelTime time;
  time.name = json.at("name").get<std::string>();
  time.item = json.value("item", "");
  time.ns = json.value("ns", 0.0);
  time.ratio = json.at("ratio").get<double>();
  if (!(time.ratio > 0.0) || !std::isfinite(time.ratio)) throw Error("ratio of " + time.name + " must be above 0");
  return time;
}

/// Throws Error (file: cause) for a file that cannot be read as a baseline or holds a ratio not above 0.
Baseline readBaseline(const std::filesystem::path& file) {
  const std::string text = readFile(file, kMaxBytes);
  try {
    const Json json = Json::parse(text);
    Baseline baseline;
    baseline.file = file.string();
    baseline.simd = json.value("machine", Json::object()).value("simd", "");
    baseline.triangles = json.at("triangles").get<std::size_t>();
    if (baseline.triangles < kMinTriangles || baseline.triangles > kMaxTriangles) {
      throw Error("triangles is out of range for a benchmark's back");
    }
    for (const Json& kernel : json.at("kernels")) baseline.kernels.push_back(kernelFrom(kernel));
    if (baseline.kernels.empty()) throw Error("kernels must not be empty");
    return baseline;
  } catch (const JsonError& error) {
    throw Error::inFile(file.string(), std::string("not a baseline of `palpate study bench`: ") + error.what());
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

/// With the machine it was measured on, for people. Throws Error if it cannot.
void writeBaseline(const std::filesystem::path& file, const Baseline& baseline) {
  Json json;
  json["triangles"] = baseline.triangles;
  for (const bench::KernelTime& time : baseline.kernels) {
    json["kernels"].push_back({{"name", time.name}, {"ratio", time.ratio}, {"ns", time.ns}, {"item", time.item}});
  }
  json["machine"] = machineJson();
  writeFile(file, jsonDump(json, 2) + "\n");
}

constexpr int kSlower = 1;  // exit code: the answer is "no"

struct BaselineArguments {
  std::vector<std::string> baselines;  ///< one for each width of vectors
  std::string write;
  std::size_t triangles = 41582;
  double tolerance = 0.3;
  double seconds = 4.0;
  bool json = false;
};

std::string ratioText(const std::optional<double>& ratio) { return ratio ? fmt::format("{:.3f}", *ratio) : "-"; }

std::string verdict(const bench::Comparison& c) {
  if (!c.before) return "not in the file";
  if (!c.now) return "no such kernel any more";
  return fmt::format("{:.2f} x{}", c.change(), c.slower ? "  SLOWER" : "");
}

Json toJson(const std::vector<bench::Comparison>& all, double tolerance) {
  Json json;
  json["tolerance"] = tolerance;
  json["slower"] = Json::array();
  for (const bench::Comparison& c : all) {
    if (c.slower) json["slower"].push_back(c.name);
    json["kernels"].push_back({{"name", c.name},
                               {"before", orNull(c.before)},
                               {"now", orNull(c.now)},
                               {"change", c.before && c.now ? Json(c.change()) : Json(nullptr)},
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
  return {.file = {}, .simd = {}, .triangles = triangles, .kernels = bench::timeKernels(kernels, seconds)};
}

/// The file that was measured with vectors as wide as here: their width alone makes some kernels several times slower.
/// Files that do not name a width fit everywhere. Throws Error where none fits.
Baseline fittingBaseline(const std::vector<std::string>& files) {
  const std::string here = lab::thisMachine().simd;
  std::string others;
  for (const std::string& file : files) {
    Baseline baseline = readBaseline(file);
    if (baseline.simd.empty() || baseline.simd == here) return baseline;
    others += fmt::format(" {} ({})", file, baseline.simd);
  }
  throw Error(fmt::format("no baseline for {} vectors:{}; expected one made with --write-baseline on such a processor",
                          here, others));
}

void compareWith(const BaselineArguments& arguments) {
  const Baseline before = fittingBaseline(arguments.baselines);
  const Baseline now = measure(before.triangles, arguments.seconds);
  const auto all = bench::compared(before.kernels, now.kernels, arguments.tolerance);
  Json json = toJson(all, arguments.tolerance);
  json["baseline"] = before.file;
  printReport(json, textOf(all, arguments.tolerance), arguments.json);
  if (std::any_of(all.begin(), all.end(), [](const bench::Comparison& c) { return c.slower; })) {
    throw ExitWith(kSlower);
  }
}

void run(const Command& bench, const BaselineArguments& arguments) {
  if (!bench.get_subcommands().empty()) return;
  if (!arguments.write.empty()) writeBaseline(arguments.write, measure(arguments.triangles, arguments.seconds));
  if (!arguments.baselines.empty()) compareWith(arguments);
  if (arguments.baselines.empty() && arguments.write.empty())
    throw UsageError::aboutArguments("A subcommand is required");
}

}  // namespace

void addBenchBaseline(Command& bench) {
  auto arguments = std::make_shared<BaselineArguments>();
  const auto option = [&](const char* name, auto& value, const char* help) {
    return bench.add_option(name, value, help)->group("Regression guard (without a subcommand)");
  };
  option("--baseline", arguments->baselines,
         "Compare with the ratios in this file; of several, with the first for vectors as wide as here; exit 1 if a "
         "kernel got slower");
  option("--write-baseline", arguments->write, "Measure and write such a file");
  const auto number = [&](const char* name, auto& value, const Limits& limits, const char* help) {
    addSetting(bench, name, value, limits, help)->group("Regression guard (without a subcommand)");
  };
  number("--tolerance", arguments->tolerance, between(0.0, 100.0), "How much a ratio may grow: 0.3 is 30 %");
  number("--guard-seconds", arguments->seconds, between(0.0, 600.0, "s"), "How long to measure all kernels together");
  number("--guard-triangles", arguments->triangles, between(1000, 4e6), "Triangles of the back, for --write-baseline");
  bench.add_flag("--json", arguments->json, "Print the comparison as one JSON object")
      ->group("Regression guard (without a subcommand)");
  bench.callback([&bench, arguments] { run(bench, *arguments); });
}

}  // namespace palpate::app
