// What fingers feel, in words for those of the onlookers that asked: the `touch` message of docs/reference/serve.md.
//
//   samples of one tick ─ TouchTexts ─► one text for all that asked for the same pad with the same rights
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

/// Of one tick. One thread.
class TouchTexts {
 public:
  /// `pressure` may be null: then nobody asked for a pad.
  TouchTexts(std::shared_ptr<const engine::FeltPressure> pressure, std::vector<trace::Sample> felt);

  /// Who instructs also gets what lumps add: to others that would say where one is hidden.
  Frame of(const Listen& asked, bool instructs);

 private:
  std::string made(const Listen& asked, bool instructs) const;

  std::shared_ptr<const engine::FeltPressure> pressure_;
  std::vector<trace::Sample> felt_;
  std::map<std::tuple<std::size_t, double, bool>, Frame> made_;
};

}  // namespace palpate::app::serving
