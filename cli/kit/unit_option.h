// `--unit`: how long a unit of a mesh file is, the same option of every command that reads one.
#pragma once

#include <CLI/CLI.hpp>

#include "palpate/scene/scene.h"

namespace palpate::app {

/// Adds --unit, a word (auto, mm, cm, dm, m, in) or a number of millimetres; 0, which is auto, is as the format says.
/// `unit_mm` must outlive the command.
CLI::Option* addUnit(CLI::App& command, double& unit_mm);

/// The unit as a scene says it: one of its words, or millimetres and a factor.
void useUnit(double unit_mm, scene::BodySettings& body);

}  // namespace palpate::app
