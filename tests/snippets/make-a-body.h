// What docs/howto/make-a-body.md takes for given.
#pragma once

#include "palpate/body/bones.h"
#include "palpate/body/skeleton/skeleton.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::snippet {
extern const mesh::TriangleMesh skin;
}  // namespace palpate::snippet
