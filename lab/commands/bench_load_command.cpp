// `palpate study bench load`: how long a user waits, and how much memory it takes, from a mesh file to the first force.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/kit/progress_line.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/load_run.h"
#include "lab/commands/named_mesh.h"
#include "palpate/base/error.h"

namespace palpate::app {
namespace {

struct LoadArguments {
  std::string file;
  bool peers = false;
  bool json = false;
};

double perTriangle(double value, const LoadFigures& f) { return value / static_cast<double>(f.triangles); }

nlohmann::ordered_json jsonOf(const std::string& file, const LoadFigures& f) {
  nlohmann::ordered_json json;
  json["file"] = file;
  json["triangles"] = f.triangles;
  json["vertices"] = f.vertices;
  json["seconds"] = f.seconds;
  json["peak_memory_gb"] = f.peak_memory_gb;
  json["bytes_per_triangle"] = perTriangle(f.peak_memory_gb * 1e9, f);
  json["ns_per_triangle"] = perTriangle(f.seconds * 1e9, f);
  for (const LoadStep& step : f.steps) {
    json["steps"].push_back({{"name", step.name}, {"seconds", step.seconds}, {"peak_memory_gb", step.peak_memory_gb}});
  }
  json["tree_bytes_per_triangle"] = f.tree_bytes_per_triangle;
  json["tree_build_ns_per_triangle"] = f.tree_build_ns_per_triangle;
  json["change_ms"] = f.change_ms;
  json["first_force_n"] = f.first_force_n;
  json["hash"] = fmt::format("{:016x}", f.hash);
  return json;
}

std::string textOf(const LoadFigures& f) {
  std::string text = fmt::format("triangles            {}\n", f.triangles);
  text +=
      fmt::format("file to first force  {:.2f} s, {:.0f} ns a triangle\n", f.seconds, perTriangle(f.seconds * 1e9, f));
  text += fmt::format("peak memory          {:.2f} GB, {:.0f} bytes a triangle\n", f.peak_memory_gb,
                      perTriangle(f.peak_memory_gb * 1e9, f));
  for (const LoadStep& step : f.steps) {
    text += fmt::format("  {:<32} {:>7.3f} s, peak {:.2f} GB\n", step.name, step.seconds, step.peak_memory_gb);
  }
  text += fmt::format("tree and records     {:.1f} bytes, built in {:.0f} ns a triangle\n", f.tree_bytes_per_triangle,
                      f.tree_build_ns_per_triangle);
  text += fmt::format("another dysfunction  {:.2f} ms\n", f.change_ms);
  return text + fmt::format("hash                 {:016x}\n", f.hash);
}

double secondsOf(const LoadFigures& f, std::string_view step) {
  for (const LoadStep& s : f.steps) {
    if (s.name == step) return s.seconds;
  }
  return 0.0;
}

/// Reading alone is what assimp does too.
void addAssimp(const std::filesystem::path& file, const LoadFigures& f, nlohmann::ordered_json& json,
               std::string& text) {
  try {
    const double theirs = assimpSeconds(file);
    const double ratio = secondsOf(f, "reading") / theirs;
    json["peers"]["assimp"] = {{"seconds", theirs}};
    json["ratio_to"]["assimp"] = ratio;
    text += fmt::format("assimp               {:.2f} s to read, ours {:.2f} of that with welding\n", theirs, ratio);
  } catch (const Error& error) {
    json["peers"]["assimp"] = {{"skipped", error.what()}};
    text += fmt::format("assimp               skipped: {}\n", error.what());
  }
}

void runLoadBench(const LoadArguments& arguments) {
  ProgressLine progress;
  const WrittenMesh mesh(arguments.file);
  const LoadFigures figures = measureLoad(mesh.file(), progress.callback());
  nlohmann::ordered_json json = jsonOf(arguments.file, figures);
  std::string text = textOf(figures);
  if (arguments.peers) addAssimp(mesh.file(), figures, json, text);
  progress.clear();
  printReport(std::move(json), text, arguments.json);
}

}  // namespace

void addBenchLoadCommand(CLI::App& parent) {
  auto arguments = std::make_shared<LoadArguments>();
  CLI::App& command = *parent.add_subcommand("load", "Time everything from a mesh file to the first force felt");
  command.add_option("FILE", arguments->file, kMeshNamesHelp)->required();
  command.add_flag("--peers", arguments->peers, "Also how long assimp reads the same file");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runLoadBench(*arguments); });
}

}  // namespace palpate::app
