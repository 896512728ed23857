// The words of Python's `render` as view settings: a table of keys, each with what it sets.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "palpate/scene/world.h"
#include "palpate/view/picture.h"

namespace palpate::python {

/// What a dict of options asks for beside the view settings.
struct PictureOptions {
  scene::ViewSettings view;
  std::string title;
  bool labels = true;
  std::optional<double> radius_mm;  ///< of the fingers; none: as the scene has them
};

/// Keys with None are as the world's scene has them. Throws ValueError or TypeError naming the key.
PictureOptions pictureOptions(const scene::World& world, const pybind11::dict& options);

}  // namespace palpate::python
