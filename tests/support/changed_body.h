// A world's body with a change that no settings make: what a test wants to be otherwise.
#pragma once

#include <memory>

#include "palpate/scene/world.h"

namespace palpate::support {

/// `change` gets the body, as a copy; whoever else has it keeps the old one.
template <class Change>
void changeBody(scene::World& world, const Change& change) {
  const auto body = std::make_shared<scene::Body>(*world.body);
  change(*body);
  world.body = body;
}

}  // namespace palpate::support
