// Boxes around the vertices of each block and around their normals: what lets a whole block be taken or left at once.
#pragma once

#include "palpate/deform/float_streams.h"
#include "palpate/deform/kernels.h"

namespace palpate::deform {

struct Skin;

/// Per block the centre and half size (x, y, z) of the box of its positions, then of its normals: 12 streams, padded to
/// whole tiles. A block with a number that is not finite has boxes of NaN: nothing can be said of it as a whole.
FloatStreams boundsOfBlocks(const Skin& skin);

}  // namespace palpate::deform
