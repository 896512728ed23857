// What docs/howto/deform-a-mesh.md takes for given.
#pragma once

#include "palpate/deform/deformer.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/maps/ellipse_map.h"

namespace palpate::snippet {
extern const mesh::TriangleMesh mesh;
extern const contact::FingerOutput finger_output;
extern const maps::EllipseMap ellipse_map;
extern const deform::TissueSettings tissue;
extern deform::Deformer deformer;
extern deform::DeformedSurface surface;
template <class... Parts>
void upload(const Parts&... parts);
}  // namespace palpate::snippet
