// The fingers' outputs as text for subscribed watchers: the `touch` message of docs/reference/serve.md.
//
//   samples of one tick ─ TouchTexts ─► one text per pad size and rights
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "cli/serve/finger_control.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/trace/sample.h"

namespace palpate::app::serving {

using Frame = std::shared_ptr<const std::string>;

/// The texts of one tick. One thread.
class TouchTexts {
 public:
  /// `pressure` may be null: then no one requested a pad.
  TouchTexts(std::shared_ptr<const engine::FeltPressure> pressure, std::vector<trace::Sample> felt);

  /// Instructors also get the share of lumps: to others that would reveal where one is hidden.
  Frame of(const Listen& asked, bool instructs);

 private:
  std::string composeText(const Listen& asked, bool instructs) const;

  std::shared_ptr<const engine::FeltPressure> pressure_;
  std::vector<trace::Sample> felt_;
  std::map<std::tuple<std::size_t, double, bool>, Frame> made_;
};

}  // namespace palpate::app::serving
