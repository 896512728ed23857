// The figures of the dissertation that are drawn here, and what each of them is drawn from.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/words.h"
#include "report/charts/figure.h"

namespace palpate::study {

/// Source of a figure.
enum class FigureBasis : std::uint8_t {
  computed,     ///< by the engine, from the text's formulae and numbers, or its trees on our models
  printed,      ///< numbers that the text prints, plotted again: nothing is computed
  own_example,  ///< by the engine, but with places, axes, sizes or drags that are ours
};

struct DissertationFigure {
  std::string number;      ///< as in the text: "4.8"; "T4.2" for the curves of Table 4.2
  std::string caption;     ///< describes the picture
  std::string difference;  ///< difference from the printed picture
  figures::Figure (*draw)() = nullptr;
  FigureBasis basis = FigureBasis::computed;
};

/// In the order of the text.
std::vector<DissertationFigure> dissertationFigures();

// The figures of each chapter's files.
std::vector<DissertationFigure> rateFigures();      ///< 3.1, 3.10, 3.16 to 3.18: printed measurements
std::vector<DissertationFigure> treeFigures();      ///< 3.4, 3.6, 3.8, 3.9, 3.13, 3.15: partitions of meshes
std::vector<DissertationFigure> modelFigures();     ///< 3.2, 3.5, 3.12, 5.1, 5.2: model, trees, measured places
std::vector<DissertationFigure> sketchFigures();    ///< 4.1, 4.2, 4.5, 4.6, 4.10: sketches with the engine's curves
std::vector<DissertationFigure> splitFigures();     ///< 3.7, 3.14: where the triangles go that a split crosses
std::vector<DissertationFigure> searchFigures();    ///< 3.11: the worst search
std::vector<DissertationFigure> profileFigures();   ///< 4.3, 4.4, Table 4.2, 4.8, 4.9
std::vector<DissertationFigure> regionFigures();    ///< 4.13 to 4.15
std::vector<DissertationFigure> deformedFigures();  ///< 4.7, 4.11, 4.12, 4.16 to 4.18
std::vector<DissertationFigure> ellipseFigures();   ///< 5.3 to 5.7
std::vector<DissertationFigure> mapFigures();       ///< 5.8 to 5.12

}  // namespace palpate::study

namespace palpate {

template <>
struct WordsOf<study::FigureBasis> {
  using B = study::FigureBasis;
  static constexpr std::array kAll = {Word{"computed by the engine", B::computed},
                                      Word{"printed numbers plotted again", B::printed},
                                      Word{"computed for an example of our own", B::own_example}};
};

}  // namespace palpate
