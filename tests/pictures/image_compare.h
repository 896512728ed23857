// Compares pictures with a tolerance, and with the ones kept in tests/data/pictures.
//
// Another version of a renderer moves single pixels; a lost letter or a wrong colour moves many in one place. So: a
// pixel is bad when a channel is off by more than a few levels, and a picture fails when too many are bad altogether,
// too many in one block, or when it is off on average.
//
// A picture that fails leaves expected, actual, their difference (times 8) and all three side by side in
// <build>/pictures. To keep a new one: look at it, then  tools/draw-pictures tests NAME.
#pragma once

#include <string>

#include "palpate/view/image.h"

namespace palpate::support {

/// What a picture holds decides how its pixels are compared.
enum class Content {
  smooth,  ///< each with its own
  lines,   ///< with the best of its 3 x 3 neighbourhood: text and thin lines may move by a pixel
};

struct Tolerance {
  Content content = Content::lines;
  int levels = 3;              ///< a channel may be off by this
  double bad_pixels = 0.0005;  ///< share of all
  double bad_in_block = 0.30;  ///< share of any 16 x 16 block
  double mean_levels = 0.25;   ///< over all channels
  Tolerance times(double factor) const;
};

struct Comparison {
  bool same = false;
  double bad_pixels = 0.0;
  double worst_block = 0.0;
  double mean_levels = 0.0;
  std::string words() const;
};

/// Pictures of different sizes are not the same.
Comparison compare(const view::Image& expected, const view::Image& actual, const Tolerance& tolerance = {});

/// |expected - actual| times 8.
view::Image differenceOf(const view::Image& expected, const view::Image& actual);

/// Fails the test unless the picture is as the kept one of this name. `drawn_by` is view::rendererName(); for a
/// renderer without pictures of its own, those of the reference are taken with ten times the limits, and it says so.
void expectPicture(const std::string& name, const view::Image& actual, const std::string& drawn_by,
                   const Tolerance& tolerance = {});

}  // namespace palpate::support
