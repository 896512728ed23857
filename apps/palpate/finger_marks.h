// The fingers of a scene as they are drawn: their colours, sizes and names.
#pragma once

#include <string>
#include <vector>

#include "apps/palpate/surface_files.h"
#include "palpate/view/finger_pose.h"

namespace palpate::app {

/// One a finger of the scene, in its order: the first is the left hand's (blue), the second the right hand's (red).
std::vector<view::FingerMark> marksOf(const scene::World& world, const Frame& frame);

std::vector<std::string> fingerNames(const scene::World& world);

}  // namespace palpate::app
