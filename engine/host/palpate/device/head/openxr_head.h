// Where a head is, as an OpenXR runtime sees its headset. For a co-located display, in the place of head_stream.h.
//
//   headset ─► runtime (Monado, ...) ─ XR_MND_headless ─► newest(), once a picture ─► Viewer::headAt ─► head_tracker.h
//
// Nothing is drawn into the headset: a session without graphics reports the place between the eyes (the space VIEW) in
// the space LOCAL, now. LOCAL has x to the right, y up and z backward as the headset stood when its runtime began, or
// was last centred: so who faces the screen then has the axes of the screen, z away from it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "palpate/base/vec.h"

namespace palpate::device {

/// One thread. The loader is opened by dlopen and, like every vendor's library, stays open.
class OpenXrHead {
 public:
  /// `loader`: its file; empty: the one that PALPATE_OPENXR_LOADER names, else the system's. Throws Error that says
  /// which part is missing: loader, runtime, an extension of it, or headset.
  explicit OpenXrHead(const std::string& loader = {});
  ~OpenXrHead();
  OpenXrHead(const OpenXrHead&) = delete;
  OpenXrHead& operator=(const OpenXrHead&) = delete;

  /// mm from where the head was first seen, and after the user centres the headset from where it was seen then. Nothing
  /// while it is not seen, farther than kFarthestHeadMm, and for good once the runtime takes the session away. Does not
  /// wait.
  std::optional<Vec3> newest() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::device
