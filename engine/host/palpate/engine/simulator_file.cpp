// The one way into a simulator that reads a file: apart, so that code for worlds alone needs no scene files.
#include "palpate/engine/simulator.h"
#include "palpate/scene/scene_file.h"

namespace palpate::engine {

Simulator::Simulator(const std::filesystem::path& scene_file) : Simulator(scene::build(scene::load(scene_file))) {}

}  // namespace palpate::engine
