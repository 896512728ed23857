// What docs/howto/partition.md takes for given.
#pragma once

#include "palpate/hdb/partition.h"

namespace palpate::snippet {
extern const mesh::TriangleMesh mesh;
extern const Vec3 proxy;
void collide(Index triangle);
}  // namespace palpate::snippet
