// A trunk made ahead, as bytes: what scene::makeBody gives, to the last bit, without what makes it. The page
// begins with it, and would otherwise need the trunk's tables, its mesher and many seconds.
//
//   makeBody ─ encodedBody ─► file (gzip, tools/build-web) ─► decodeBody ─► scene::buildOn
//
// Depths to the bones are in it, a sixth of the file: measuring them again takes a fifth of a second.
// Numbers that follow each other differ little: each is written as its difference from the one before, and of all of
// them first the lowest bytes, then the next ones; gzip then finds the high ones to be nearly all the same.
#pragma once

#include <string>
#include <string_view>

#include "palpate/scene/body_parts.h"

namespace palpate::web {

struct ReadyBody {
  std::size_t triangles = 0;  ///< as they were asked for, for the scene file that a recording brings
  scene::BodyParts parts;     ///< name, skin, anatomy
};

/// Only what a standing trunk has: no support, texture or stiffness of its own.
std::string encodedBody(const ReadyBody& body);
/// Throws Error for bytes that are none: sizes, numbers, triangles and bones are checked before they are used.
ReadyBody decodeBody(std::string_view bytes);

}  // namespace palpate::web
