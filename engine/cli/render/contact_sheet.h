// A run on one sheet: the body at rest, pressed, dragged, its strain, the triangles that are felt, the cut through the
// contact.
#pragma once

#include <memory>

#include "palpate/base/progress.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/view/image.h"

namespace palpate::app {

/// The moments that the sheet shows; empty ones leave their pictures out.
struct SheetMoments {
  servo::TickSamples pressed;  ///< where the fingers were deepest
  servo::TickSamples dragged;  ///< where they pulled the skin farthest
};

/// Throws Error where nothing can be drawn.
view::Image contactSheet(const std::shared_ptr<const scene::World>& world, const SheetMoments& moments,
                         const Progress& progress);

}  // namespace palpate::app
