// Where a user's programs keep what took long to make (body_store.cpp, lump_store.cpp).
#pragma once

#include "palpate/scene/ready_body.h"
#include "palpate/scene/solved_lumps.h"

namespace palpate::scene {

BodyStore userBodyStore();
LumpStore userLumpStore();

}  // namespace palpate::scene
