#include "dissertation/figures/figure_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "report/page/plot_parts.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

bool isTable(const DissertationFigure& figure) { return figure.number.starts_with('T'); }

std::string indexEntry(const DissertationFigure& figure, bool has_data) {
  const std::string stem = fileStem(figure);
  std::string entry =
      fmt::format("## {}\n\n{}.\n\n![{}]({}.png)\n\n", titleOf(figure), figure.caption, titleOf(figure), stem);
  entry += fmt::format("Basis: {}.\n\n", wordFor(figure.basis));
  if (!figure.difference.empty()) entry += fmt::format("What differs from the printed one: {}\n\n", figure.difference);
  entry += fmt::format("[SVG]({}.svg)", stem);
  if (has_data) entry += fmt::format(", [CSV]({}.csv)", stem);
  return entry + "\n\n";
}

}  // namespace

std::string fileStem(const DissertationFigure& figure) {
  std::string number = isTable(figure) ? figure.number.substr(1) : figure.number;
  std::replace(number.begin(), number.end(), '.', '_');
  return fmt::format("{}_{}", isTable(figure) ? "table" : "figure", number);
}

std::string titleOf(const DissertationFigure& figure) {
  return isTable(figure) ? fmt::format("Table {}", figure.number.substr(1)) : fmt::format("Figure {}", figure.number);
}

std::vector<DissertationFigure> chosenFigures(const std::vector<std::string>& numbers) {
  std::vector<DissertationFigure> all = dissertationFigures();
  if (numbers.empty()) return all;
  for (const std::string& number : numbers) {
    const bool known = std::any_of(all.begin(), all.end(), [&](const auto& figure) { return figure.number == number; });
    if (!known) throw Error(fmt::format("unknown figure {}; `palpate study figures --list` lists them", number));
  }
  std::vector<DissertationFigure> chosen;
  std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const DissertationFigure& figure) {
    return std::find(numbers.begin(), numbers.end(), figure.number) != numbers.end();
  });
  return chosen;
}

void writeFigures(const std::vector<DissertationFigure>& chosen, const std::filesystem::path& folder, double png_scale,
                  const Progress& progress) {
  makeFolder(folder);
  std::string index = "# Figures of the dissertation, drawn by palpate\n\nMade by `palpate study figures`.\n\n";
  double done = 0.0;
  for (const DissertationFigure& entry : chosen) {
    report(progress, titleOf(entry), done / static_cast<double>(chosen.size()));
    const figures::Figure figure = entry.draw();
    const std::string stem = fileStem(entry);
    figures::writePng(figure, folder / (stem + ".png"), png_scale);
    figures::writeSvg(figure, folder / (stem + ".svg"));
    const std::string csv = toCsv(figure);
    if (!csv.empty()) writeFile(folder / (stem + ".csv"), csv);
    index += indexEntry(entry, !csv.empty());
    done += 1.0;
  }
  writeFile(folder / "index.md", index);
}

}  // namespace palpate::study
