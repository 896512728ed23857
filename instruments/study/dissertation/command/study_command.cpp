// `palpate study`: the dissertation's numbers and figures, computed and drawn by the engine.
//
// Each study is a subcommand with a file of its own in instruments/study/dissertation/; those that write a page are
// listed in instruments/study/dissertation/studies.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/kit/interruption.h"
#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "dissertation/command/commands.h"
#include "dissertation/errata/errata_study.h"
#include "dissertation/figures/figure_study.h"
#include "dissertation/numbers/numbers_study.h"
#include "dissertation/report/report.h"
#include "dissertation/studies.h"
#include "lab/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/made_folder.h"
#include "palpate/elements/lump_solver.h"
#include "palpate/scene/presets.h"
#include "palpate/scene/scene_file.h"
#include "solve/commands/commands.h"

namespace palpate::app {

// `palpate study NAME --out DIR` for every study that writes a page (instruments/study/dissertation/studies.h).

namespace {

/// One folder may hold several studies; replacing one of them is reported.
void warnIfReplacing(const std::string& folder, const std::string& file) {
  const std::filesystem::path page = std::filesystem::path(folder) / file;
  if (folder.empty() || !std::filesystem::exists(page)) return;
  say(fmt::format("palpate: {} is from an earlier run; it is replaced, and other files of that run stay\n",
                  page.string()));
}

struct StudyArguments {
  std::string folder;
  bool quick = false;
  bool json = false;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> cases;
  bool map = false;
  std::string family;
};

/// Name of the page, without its extension.
std::string pageName(const study::Study& study, const StudyArguments& arguments) {
  if (arguments.map) return study.name + "_map";
  return arguments.family.empty() ? study.name : study.name + "_" + arguments.family;
}

void run(const study::Study& study, const StudyArguments& arguments) {
  const MadeFolder made(arguments.folder);
  warnIfReplacing(arguments.folder, pageName(study, arguments) + ".md");
  ProgressLine progress;
  const study::StudyPage page = study::runStudy(study, {.quick = arguments.quick,
                                                        .progress = progress.callback(),
                                                        .seed = arguments.seed,
                                                        .cases = arguments.cases,
                                                        .map = arguments.map,
                                                        .family = arguments.family});
  if (!arguments.folder.empty()) study::writePage(page, arguments.folder, progress.callback());
  progress.clear();
  fmt::print("{}", arguments.json ? study::toJson(page) : study::textOf(page));
  if (!arguments.json && !arguments.folder.empty()) fmt::print("\n{}/{}.md\n", arguments.folder, page.name);
}

void addPage(Command& parent, const study::Study& study) {
  const auto [command, arguments] =
      addCommand<StudyArguments>(parent, study.name, study.what, [study](const StudyArguments& a) { run(study, a); });
  namesFolderToWrite(
      command.add_option("-o,--out", arguments.folder,
                         "Write the page (" + study.name +
                             ".md) with its figures (PNG, SVG) and tables (CSV) to this folder, created if missing"));
  command.add_flag("--quick", arguments.quick,
                   "Use small models and few repetitions, to preview the page, not to measure");
  command.add_flag("--json", arguments.json, "Print the findings and main numbers as one JSON object");
  if (study.draws) {
    addNumber(command, "--seed", arguments.seed, between(0, 1e15), "Seed of the cases");
    addNumber(command, "--cases", arguments.cases, between(2, 100000), "Number of good cases to draw");
  }
  if (study.maps) {
    command.add_flag(
        "--map", arguments.map,
        "Compute only the map of what is allowed: random systems at every rate and delay (some minutes on two cores)");
    addNumber(command, "--seed", arguments.seed, between(0, 1e15), "Seed of the systems for the map")->needs("--map");
  }
  if (!study.families.empty()) {
    command
        .add_option(study.name == "training" ? "--observer" : "--family", arguments.family,
                    fmt::format("Use only cases of this {} ({} unless --cases sets it): {}",
                                study.name == "training" ? "simulated observer" : "family", study.family_cases,
                                fmt::join(study.families, ", ")))
        ->check(IsMember{study.families});
  }
}

void addStudyPages(Command& parent) {
  for (const study::Study& study : study::studies()) addPage(parent, study);
}

// `palpate study all`: every study, one page each, and report.html.

/// The default run on the dissertation's body and in its tissue.
scene::Scene studyScene() {
  scene::Scene scene = scene::standardScene();
  scene.body = {};
  scene.body.kind = scene::BodyKind::torso;
  scene.deformation.tissue = scene::TissueModel::gaussian;
  return scene;
}

struct AllArguments {
  std::string folder;
  bool quick = false;
};

void runAll(const AllArguments& arguments) {
  const scene::Scene scene = studyScene();
  warnIfReplacing(arguments.folder, "report.html");
  ProgressLine progress;
  const auto print_chapter = [&](const study::ChapterDone& chapter) {
    progress.clear();
    fmt::print("{:>2} of {}  {:<14} {:6.1f} s\n", chapter.number, chapter.of, chapter.name, chapter.seconds);
    std::fflush(stdout);
  };
  const FinishesInOrder in_order;
  study::writeReport(study::reportChapters(scene), {.quick = arguments.quick, .progress = progress.callback()},
                     arguments.folder, print_chapter, [] { return endingSignal() != 0; });
  progress.clear();
  fmt::print("{}/report.html\n", arguments.folder);
}

void addStudyAll(Command& parent) {
  const auto [command, arguments] = addCommand(
      parent, "all",
      "Run every study: a page each, and one readable report.html with all figures (some minutes on two cores)",
      runAll);
  namesFolderToWrite(command.add_option("-o,--out", arguments.folder, "Folder to write to, created if missing"))
      ->required();
  command.add_flag("--quick", arguments.quick,
                   "Use small models and few repetitions, to preview the report, not to measure");
}

// A number that differs without an erratum that explains it.
constexpr int kNotReproduced = 1;

struct NumbersArguments {
  std::string folder;
  bool json = false;
};

void runNumbers(const NumbersArguments& arguments) {
  warnIfReplacing(arguments.folder, "numbers.md");
  const auto rows = study::studyNumbers();
  fmt::print("{}", arguments.json ? study::toJson(rows) : study::textOf(rows));
  if (!arguments.folder.empty()) study::writeNumbers(rows, arguments.folder);
  if (!study::studyHolds(rows)) throw ExitWith(kNotReproduced);
}

void addNumbers(Command& study) {
  const auto [command, arguments] =
      addCommand(study, "numbers",
                 "Compare printed numbers of the dissertation with ours, by group: from the engine, arithmetic of "
                 "printed numbers, misprints, inconsistent, not computable. Exit code 0 if none differs without an "
                 "erratum that names ours, 1 otherwise",
                 runNumbers);
  namesFolderToWrite(command.add_option("-o,--out", arguments.folder,
                                        "Also write numbers.md, numbers.csv and numbers.json into this folder"));
  command.add_flag("--json", arguments.json, "Print one JSON object");
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
    for (const auto& figure : chosen) {
      fmt::print("{:<6} {} ({})\n", figure.number, figure.caption, wordFor(figure.basis));
    }
    return;
  }
  if (arguments.folder.empty()) throw Error("study figures: expected --out DIR, the folder to write to");
  warnIfReplacing(arguments.folder, "index.md");
  ProgressLine progress;
  study::writeFigures(chosen, arguments.folder, arguments.scale, progress.callback());
  progress.clear();
  fmt::print("{} figures in {}\n", chosen.size(), arguments.folder);
}

void addFigures(Command& study) {
  const auto [command, arguments] = addCommand(
      study, "figures",
      "Draw figures of the dissertation: PNG, SVG, the curves as CSV, and index.md with captions and sources",
      runFigures);
  namesFolderToWrite(command.add_option("-o,--out", arguments.folder, "Folder to write to, created if missing"));
  command.add_option("--only", arguments.only, "Draw only these, for example 4.8,5.11")->delimiter(',');
  addSetting(command, "--scale", arguments.scale, between(0.25, 8.0), "PNG: pixels per 1/96 inch");
  command.add_flag("--list", arguments.list, "List the figures and stop");
}

struct ErrataArguments {
  std::string scene;
  std::string folder;
  bool json = false;
  bool list = false;
};

void runErrata(const ErrataArguments& arguments) {
  if (arguments.list) {
    fmt::print("{}", study::errataList());
    return;
  }
  const scene::Scene scene = arguments.scene.empty() ? studyScene() : scene::load(arguments.scene);
  scene::requireFingers(scene);
  warnIfReplacing(arguments.folder, "errata.md");
  ProgressLine progress;
  const auto effects = study::studyErrata(scene, progress.callback());
  progress.clear();
  fmt::print("{}", arguments.json ? study::errataJson(effects) : study::errataText(effects));
  if (!arguments.folder.empty()) study::writeErrata(effects, arguments.folder);
}

void addErrata(Command& study) {
  const auto [command, arguments] = addCommand(study, "errata",
                                               "Show what each erratum of the dissertation changes on a scene: forces "
                                               "(N), proxies (mm), skin (mm), strain (%), against the corrected engine",
                                               runErrata);
  command.add_option("scene", arguments.scene, "Scene file (TOML) (default: the built-in scene)");
  namesFolderToWrite(command.add_option("-o,--out", arguments.folder,
                                        "Also write errata.md, errata.csv and errata.json into this folder"));
  command.add_flag("--json", arguments.json, "Print one JSON object");
  command.add_flag("--list", arguments.list, "Print what each erratum says (Markdown) and stop");
}

void addStudyCommand(Command& app) {
  Command& study = *app.add_subcommand("study", "Reproduce the dissertation's numbers and figures");
  study.require_subcommand(1);
  addNumbers(study);
  addFigures(study);
  addErrata(study);
  addStudyPages(study);
  addStudyAll(study);
  addCredibilityCommand(study);
  addPartitionCommand(study);
  addBenchCommand(study);
  addHuntCommand(study);
}

}  // namespace

void addStudyFamily(Command& app) {
  scene::setLumpSolver(elements::solveLump);
  addStudyCommand(app);
  addTissueCommand(app);
  addLumpCommand(app);
  addLumpLoopsCommand(*app.get_subcommand("lump"));
}

}  // namespace palpate::app
