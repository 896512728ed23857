#include "dissertation/figures/dissertation_figures.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "palpate/base/text.h"

namespace palpate::study {

namespace {

// 3.9 comes before 3.10; a table of a chapter before its figures.
std::pair<double, double> placeInText(std::string_view number) {
  const auto parts = split(number, '.');
  const double chapter = parseNumber(parts[0]).value_or(parseNumber(parts[0].substr(1)).value_or(0.0));
  return {chapter, parseNumber(parts[1]).value_or(0.0)};
}

}  // namespace

std::vector<DissertationFigure> dissertationFigures() {
  std::vector<DissertationFigure> all;
  for (auto* chapter : {rateFigures, modelFigures, sketchFigures, treeFigures, splitFigures, searchFigures,
                        profileFigures, regionFigures, deformedFigures, ellipseFigures, mapFigures}) {
    std::vector<DissertationFigure> some = chapter();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  std::stable_sort(all.begin(), all.end(), [](const DissertationFigure& a, const DissertationFigure& b) {
    return placeInText(a.number) < placeInText(b.number);
  });
  return all;
}

}  // namespace palpate::study
