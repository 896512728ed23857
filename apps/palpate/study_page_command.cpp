// `palpate study NAME --out DIR` for every study that writes a page (study/studies.h).
#include <fmt/format.h>

#include <memory>
#include <string>

#include "apps/palpate/commands.h"
#include "apps/palpate/progress_line.h"
#include "palpate/base/error.h"
#include "study/folder.h"
#include "study/studies.h"

namespace palpate::app {

namespace {

struct Arguments {
  std::string folder;
  bool quick = false;
  bool json = false;
};

void run(const study::Study& study, const Arguments& arguments) {
  if (!arguments.folder.empty()) study::makeFolder(arguments.folder);  // a folder that cannot be is refused at once
  ProgressLine progress;
  const study::StudyPage page = study::runStudy(study, {.quick = arguments.quick, .progress = progress.callback()});
  if (!arguments.folder.empty()) study::writePage(page, arguments.folder, progress.callback());
  progress.clear();
  fmt::print("{}", arguments.json ? study::jsonOf(page) : study::textOf(page));
  if (!arguments.json && !arguments.folder.empty()) fmt::print("\n{}/{}.md\n", arguments.folder, page.name);
}

void addPage(CLI::App& parent, const study::Study& study) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *parent.add_subcommand(study.name, study.what);
  command.add_option("--out", arguments->folder,
                     "Write the page (" + study.name +
                         ".md) with its figures (PNG, SVG) and tables (CSV) into this folder; made when missing");
  command.add_flag("--quick", arguments->quick,
                   "Small models and few repetitions: a look at the page, not a measurement");
  command.add_flag("--json", arguments->json, "Print the findings and main numbers as one JSON object");
  command.callback([arguments, study] { run(study, *arguments); });
}

}  // namespace

void addStudyPages(CLI::App& parent) {
  for (const study::Study& study : study::studies()) addPage(parent, study);
}

}  // namespace palpate::app
