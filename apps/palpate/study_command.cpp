// `palpate study`: the dissertation's numbers and figures, computed and drawn by the engine.
//
// Each study is a subcommand with a file of its own in study/; those that write a page are added by
// study_page_command.cpp.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "apps/palpate/commands.h"
#include "apps/palpate/default_scene.h"
#include "apps/palpate/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "study/errata_report.h"
#include "study/figure_study.h"
#include "study/numbers_report.h"
#include "study/numbers_study.h"

namespace palpate::app {

namespace {

// A number that differs without an erratum that says why.
constexpr int kNotReproduced = 1;

struct NumbersArguments {
  std::string folder;
  bool json = false;
};

void runNumbers(const NumbersArguments& arguments) {
  const auto rows = study::studyNumbers();
  fmt::print("{}", arguments.json ? study::jsonOf(rows) : study::textOf(rows));
  if (!arguments.folder.empty()) study::writeNumbers(rows, arguments.folder);
  if (!study::studyHolds(rows)) throw CLI::RuntimeError(kNotReproduced);
}

void addNumbers(CLI::App& study) {
  auto arguments = std::make_shared<NumbersArguments>();
  CLI::App& command = *study.add_subcommand(
      "numbers",
      "Every number of the dissertation that can be computed, beside ours. Exit code 0 when each is reproduced or is a "
      "misprint named by its erratum, 1 otherwise");
  command.add_option("--out", arguments->folder,
                     "Also write numbers.md, numbers.csv and numbers.json into this folder");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runNumbers(*arguments); });
}

struct FiguresArguments {
  std::string folder;
  std::vector<std::string> only;
  double scale = figures::kPngScale;
  bool list = false;
};

void runFigures(const FiguresArguments& arguments) {
  const auto chosen = study::chosenFigures(arguments.only);
  if (arguments.list) {
    for (const auto& figure : chosen) fmt::print("{:<6} {}\n", figure.number, figure.caption);
    return;
  }
  if (arguments.folder.empty()) throw Error("study figures: --out DIR is needed");
  ProgressLine progress;
  study::writeFigures(chosen, arguments.folder, arguments.scale, progress.callback());
  progress.clear();
  fmt::print("{} figures in {}\n", chosen.size(), arguments.folder);
}

void addFigures(CLI::App& study) {
  auto arguments = std::make_shared<FiguresArguments>();
  CLI::App& command = *study.add_subcommand(
      "figures", "Draw the figures of the dissertation: PNG, SVG, the curves as CSV, and index.md with the captions");
  command.add_option("--out", arguments->folder, "Folder to write into; made when missing");
  command.add_option("--only", arguments->only, "Only these, for example 4.8,5.11")->delimiter(',');
  command.add_option("--scale", arguments->scale, "Pixels of the PNG for 1/96 inch")
      ->capture_default_str()
      ->check(CLI::Range(0.25, 8.0));
  command.add_flag("--list", arguments->list, "Only list what can be drawn");
  command.callback([arguments] { runFigures(*arguments); });
}

struct ErrataArguments {
  std::string scene;
  std::string folder;
  bool json = false;
};

void runErrata(const ErrataArguments& arguments) {
  const scene::Scene scene =
      arguments.scene.empty() ? scene::parse(defaultScene(), "default.toml") : scene::load(arguments.scene);
  ProgressLine progress;
  const auto effects = study::studyErrata(scene, progress.callback());
  progress.clear();
  fmt::print("{}", arguments.json ? study::errataJson(effects) : study::errataText(effects));
  if (!arguments.folder.empty()) study::writeErrata(effects, arguments.folder);
}

void addErrata(CLI::App& study) {
  auto arguments = std::make_shared<ErrataArguments>();
  CLI::App& command = *study.add_subcommand("errata",
                                            "What each erratum of the dissertation changes on a scene: forces (N), "
                                            "proxies (mm), skin (mm), strain (%), against "
                                            "the corrected engine");
  command.add_option("scene", arguments->scene, "Scene file (TOML); the built-in scene when left out");
  command.add_option("--out", arguments->folder, "Also write errata.md, errata.csv and errata.json into this folder");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] { runErrata(*arguments); });
}

}  // namespace

void addStudyCommand(CLI::App& app) {
  CLI::App& study = *app.add_subcommand("study", "The dissertation's numbers and figures, reproduced");
  study.require_subcommand(1);
  addNumbers(study);
  addFigures(study);
  addErrata(study);
  addStudyPages(study);
  addStudyAll(study);
}

}  // namespace palpate::app
