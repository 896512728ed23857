// The trunk that the page begins with, as the bytes that its engine reads (palpate/scene/ready_body.h).
#include <cstddef>
#include <string>

#include "engine/exports.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/ready_body.h"

namespace palpate::web {

namespace {

std::string trunk;

}  // namespace

/// `triangles`: of skin and bones, 0 for the trunk's default.
PALPATE_EXPORT const char* palpate_make_trunk(std::size_t triangles) {
  return catchError([&] {
    scene::BodySettings settings;
    settings.kind = scene::BodyKind::trunk;
    settings.triangles = triangles;
    trunk = scene::encodedBody({triangles, scene::makeBody(settings, {})});
  });
}
PALPATE_EXPORT std::size_t palpate_trunk_length() { return trunk.size(); }
PALPATE_EXPORT const char* palpate_trunk_bytes() { return trunk.data(); }

}  // namespace palpate::web
