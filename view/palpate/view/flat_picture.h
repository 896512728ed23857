// A picture on the graphics card as it is, for panels to show: no light falls on it.
#pragma once

#include <memory>

#include "palpate/view/image.h"
#include "palpate/view/offscreen.h"

namespace palpate::view {

/// Needs a current context, of whose thread it is.
class FlatPicture {
 public:
  explicit FlatPicture(const Image& image);
  ~FlatPicture();
  FlatPicture(FlatPicture&&) noexcept;
  FlatPicture& operator=(FlatPicture&&) noexcept;

  GlId texture() const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace palpate::view
