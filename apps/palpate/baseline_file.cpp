#include "apps/palpate/baseline_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/palpate/bench_report.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::app {

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::size_t kLeastTriangles = 1000, kMostTriangles = 4000000;

bench::KernelTime kernelFrom(const nlohmann::json& json) {
  bench::KernelTime time;
  time.name = json.at("name").get<std::string>();
  time.item = json.value("item", "");
  time.ns = json.value("ns", 0.0);
  time.ratio = json.at("ratio").get<double>();
  if (!(time.ratio > 0.0) || !std::isfinite(time.ratio)) throw Error("the ratio of " + time.name + " is not above 0");
  return time;
}

}  // namespace

Baseline readBaseline(const std::filesystem::path& file) {
  const std::string text = readFile(file, kMostBytes);
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    Baseline baseline;
    baseline.triangles = json.at("triangles").get<std::size_t>();
    if (baseline.triangles < kLeastTriangles || baseline.triangles > kMostTriangles) {
      throw Error("the number of triangles is not one of a benchmark's back");
    }
    for (const nlohmann::json& kernel : json.at("kernels")) baseline.kernels.push_back(kernelFrom(kernel));
    if (baseline.kernels.empty()) throw Error("there are no kernels in it");
    return baseline;
  } catch (const nlohmann::json::exception& error) {
    throw Error::inFile(file.string(), std::string("not a baseline of `palpate bench`: ") + error.what());
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

void writeBaseline(const std::filesystem::path& file, const Baseline& baseline) {
  nlohmann::ordered_json json;
  json["triangles"] = baseline.triangles;
  for (const bench::KernelTime& time : baseline.kernels) {
    json["kernels"].push_back({{"name", time.name}, {"ratio", time.ratio}, {"ns", time.ns}, {"item", time.item}});
  }
  json["machine"] = machineJson();
  writeFile(file, json.dump(2) + "\n");
}

}  // namespace palpate::app
