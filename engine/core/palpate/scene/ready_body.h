// A built-in body as bytes: what makeBody gives, to the last bit, without what makes it. A page begins with such a
// body; a program finds in its user's folder what an earlier run has made.
//
//   makeBody ─ encodedBody ─► file ─► decodeBody ─► scene::buildOn
//   makeBody ─ storeBody ─► BodyStore, installed by the host ─► keptBody ─► makeBody of a later run
//
// Depths to the bones and how narrow these are are in it, a fifth of the file: measuring them again takes a third of a
// second.
// Numbers that follow each other differ little: each is written as its difference from the one before, and of all of
// them first the lowest bytes, then the next ones; gzip then finds the high ones to be nearly all the same.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "palpate/scene/body_parts.h"

namespace palpate::scene {

struct ReadyBody {
  std::size_t triangles = 0;  ///< as they were asked for, for the scene file that a recording brings
  BodyParts parts;            ///< name, skin, anatomy
};

/// Name, skin and anatomy; no texture, stiffness or layers of its own.
std::string encodedBody(const ReadyBody& body);
/// Throws Error, which begins with `what`, unless the bytes are a whole body: sizes, numbers, triangles and bones are
/// checked before they are used.
ReadyBody decodeBody(std::string_view bytes, std::string_view what);

/// Every number that a built-in body depends on, as one line: equal recipes make equal bodies. Empty for a mesh.
std::string bodyRecipe(const BodySettings& settings);

/// Bodies that were made before, by their recipes. The core has no files: the host installs one that keeps them.
struct BodyStore {
  std::function<std::optional<std::string>(std::string_view recipe)> find;
  std::function<void(std::string_view recipe, std::string_view bytes)> save;
};
/// Installed once, while the program starts. An empty one keeps nothing.
void setBodyStore(BodyStore store);

/// Nothing where the store has none of these settings, or where its bytes are not a whole body.
std::optional<BodyParts> keptBody(const BodySettings& settings);
void storeBody(const BodySettings& settings, const BodyParts& parts);

}  // namespace palpate::scene
