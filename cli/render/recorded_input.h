// A recorded session as what `palpate render` draws: its worlds, and its fingers at the moments that are asked for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/render/render_options.h"
#include "palpate/base/progress.h"
#include "palpate/engine/session_bundle.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/trace/session_reader.h"

namespace palpate::app {

class RecordedInput {
 public:
  /// Throws Error for options that say who touches the body, or how long.
  explicit RecordedInput(const RenderOptions& options);

  /// When the session begins, s.
  double beginS() const;
  std::vector<servo::TickSamples> framesAt(const std::vector<double>& times_s);
  /// The world that the frame was felt in, as the options want it seen; of no fingers, the one it began with. Built
  /// anew where it is another than that of the call before.
  std::shared_ptr<const scene::World> worldOf(const servo::TickSamples& frame, const Progress& progress);
  /// Where the last one is not the recorded one; empty: it is.
  const std::string& note() const { return note_; }

 private:
  const RenderOptions& options_;
  trace::SessionReader session_;
  engine::CarriedFiles carried_;
  std::uint32_t number_ = 0;
  std::shared_ptr<const scene::World> world_;
  std::string note_;
};

}  // namespace palpate::app
