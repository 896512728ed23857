// `palpate study figures`: the dissertation's figures as PNG, SVG and CSV in a folder, with an index of captions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dissertation/figures/dissertation_figures.h"
#include "palpate/base/progress.h"

namespace palpate::study {

/// Figures with these numbers; empty: all. Throws Error for an unknown number.
std::vector<DissertationFigure> chosenFigures(const std::vector<std::string>& numbers);

/// "figure_4_8"; "table_4_2" for T4.2.
std::string fileStem(const DissertationFigure& figure);

/// "Figure 4.8"; "Table 4.2" for T4.2.
std::string titleOf(const DissertationFigure& figure);

/// Draws them into the folder, which is made when missing, and writes index.md. `png_scale` is pixels of the PNG a CSS
/// pixel. Throws Error naming a file that cannot be written.
void writeFigures(const std::vector<DissertationFigure>& chosen, const std::filesystem::path& folder,
                  double png_scale = figures::kPngScale, const Progress& progress = {});

}  // namespace palpate::study
