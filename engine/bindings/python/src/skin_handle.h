// The Skin of Python: the deformed skin of a world, and the flag of those who read it without the interpreter's lock.
#pragma once

#include <memory>
#include <utility>

#include "busy.h"
#include "palpate/engine/living_skin.h"
#include "world_handle.h"

namespace palpate::python {

class SkinHandle {
 public:
  SkinHandle(WorldPointer world, bool strain, std::size_t fingers)
      : world_(std::move(world)), fingers_(fingers), skin_(*world_->world, {.strain = strain, .fingers = fingers}) {}

  const WorldPointer& world() const { return world_; }
  /// The number of fingers for `follow`.
  std::size_t fingers() const { return fingers_; }
  engine::LivingSkin& skin() { return skin_; }
  const engine::LivingSkin& skin() const { return skin_; }
  /// Held by its writer, and by a reader with the lock released.
  Busy& busy() { return busy_; }

  deform::Report report = {};  ///< report of the last change

 private:
  WorldPointer world_;
  std::size_t fingers_;
  engine::LivingSkin skin_;
  Busy busy_;
};

}  // namespace palpate::python
