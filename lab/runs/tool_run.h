// Runs a tool of several pads along a trajectory and, on the same tips, a finger alone for each pad: what the tool
// costs beside what its pads would cost, and whether they feel the same.
//
// Every part follows the trajectory of one finger, a stretch of time after the part before it, so that parts lie apart
// and all are pressed as deep as that finger; each is turned so that its z points out of the skin under it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/counters/statistics.h"
#include "lab/counters/thread_counts.h"
#include "lab/runs/contact_run.h"
#include "palpate/contact/tool.h"

namespace palpate::bench {

struct ToolFigures {
  std::size_t triangles = 0, pads = 0, parts = 0, groups = 0;
  std::size_t ticks = 0;      ///< of the window
  std::size_t all_touch = 0;  ///< of these, with every pad in contact
  lab::Percentiles tick_us;   ///< over the ticks in which every pad touches; over all where there are none
  lab::Percentiles any_tick_us;
  lab::Percentiles air_tick_us;    ///< the same path, lifted clear of the skin
  lab::Percentiles apart_tick_us;  ///< a finger alone for each pad, one after the other; the same ticks as tick_us
  std::size_t different = 0;       ///< pads and ticks in which a pad did not feel what its finger did, to the bit
  contact::Wrench wrench;          ///< with the largest force, about the first part's origin
  double peak_moment_n_mm = 0.0;
  lab::ThreadCounts counts;  ///< of all ticks of the tool
};

/// The tools that can be measured.
std::vector<std::string> toolNames();

/// Throws Error for another name.
contact::ToolShape toolNamed(std::string_view name);

/// In a world of scale 1. Of `finger` the radius is not looked at.
ToolFigures measureTool(const ContactWorld& world, const device::Trajectory& trajectory,
                        const contact::ToolShape& shape, const contact::FingerSettings& finger,
                        const Window& window = {});

}  // namespace palpate::bench
