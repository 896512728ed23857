// `palpate study all`: every study, one page each, and report.html.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "apps/palpate/commands.h"
#include "apps/palpate/default_scene.h"
#include "apps/palpate/progress_line.h"
#include "palpate/scene/scene_file.h"
#include "study/report.h"
#include "study/report_chapters.h"

namespace palpate::app {

namespace {

struct Arguments {
  std::string folder;
  bool quick = false;
};

void run(const Arguments& arguments) {
  const scene::Scene scene = scene::parse(defaultScene(), "default.toml");
  ProgressLine progress;
  const auto tell = [&](const study::ChapterDone& chapter) {
    progress.clear();
    fmt::print("{:>2} of {}  {:<14} {:6.1f} s\n", chapter.number, chapter.of, chapter.name, chapter.seconds);
    std::fflush(stdout);
  };
  study::writeReport(study::reportChapters(scene), {.quick = arguments.quick, .progress = progress.callback()},
                     arguments.folder, tell);
  progress.clear();
  fmt::print("{}/report.html\n", arguments.folder);
}

}  // namespace

void addStudyAll(CLI::App& parent) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *parent.add_subcommand(
      "all", "Every study, a page each, and one readable report.html with all figures; some minutes on two cores");
  command.add_option("--out", arguments->folder, "Folder to write into; made when missing")->required();
  command.add_flag("--quick", arguments->quick,
                   "Small models and few repetitions: a look at the report, not a measurement");
  command.callback([arguments] { run(*arguments); });
}

}  // namespace palpate::app
