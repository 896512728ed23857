// The picture's side of a world: its deformed skin and the painter that draws it. Contacts in, picture out.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "palpate/engine/living_skin.h"
#include "palpate/servo/loop.h"
#include "palpate/view/painter.h"

namespace palpate::viewer {

/// Needs a current GL context; belongs to its thread.
class LiveModel {
 public:
  explicit LiveModel(std::shared_ptr<const scene::World> world);
  /// Shows another world, at rest. Throws Error for a texture that cannot be shown, and then nothing has changed.
  void setWorld(std::shared_ptr<const scene::World> world);

  struct Times {
    double deform_ms = 0.0;
    double upload_ms = 0.0;
  };
  /// Deforms the skin by the newest contacts and uploads the changes.
  Times follow(std::span<const trace::Sample> contacts);

  const scene::World& world() const { return *world_; }
  const deform::DeformedSurface& surface() const { return skin_->surface(); }
  double lift() const { return skin_->lift(); }
  view::Painter& painter() { return painter_; }

 private:
  std::shared_ptr<const scene::World> world_;
  std::optional<engine::LivingSkin> skin_;
  view::Painter painter_;
};

}  // namespace palpate::viewer
