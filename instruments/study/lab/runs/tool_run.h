// Runs a tool of several pads along a trajectory and, on the same tips, a finger alone for each pad: what the tool
// costs against its pads alone, and whether they feel the same.
//
// Every part follows the trajectory of one finger, a stretch of time after the part before it, so that parts lie apart
// and all are pressed as deep as that finger; each is turned so that its z points out of the skin under it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/runs/contact_run.h"
#include "palpate/base/json.h"
#include "palpate/contact/tool.h"

namespace palpate::bench {

/// The tools that can be measured.
std::vector<std::string> toolNames();

/// Throws Error for another name.
contact::ToolShape toolNamed(std::string_view name);

/// The same way, but on the skin instead of in it: each part is moved as far as its pads come out of the skin on
/// average. All parts of a tick, then those of the next. The radius of `finger` is ignored.
std::vector<contact::ToolPose> posesOnSkin(const ContactWorld& world, const device::Trajectory& trajectory,
                                           const contact::ToolShape& shape, const contact::FingerSettings& finger,
                                           const Window& window = {});

/// In a world of scale 1. The radius of `finger` is ignored. tick_us: over the ticks of the window in which every pad
/// touches (over all where there are none); any_tick_us: over all; air_tick_us: the same path, lifted clear of the
/// skin; apart_tick_us: a finger alone for each pad, one after the other, in the ticks of tick_us. different: pads and
/// ticks in which a pad did not feel what its finger did, to the bit. wrench: the one with the largest force, about the
/// first part's origin. Counts are over all ticks of the tool.
Json measureTool(const ContactWorld& world, const device::Trajectory& trajectory, const contact::ToolShape& shape,
                 const contact::FingerSettings& finger, const Window& window = {});

}  // namespace palpate::bench
