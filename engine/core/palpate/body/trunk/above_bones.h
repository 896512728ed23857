// Finds the skin above a bone's landmark, on a body that is bent and padded.
//
// Used by trunk.h for a body and by fitting/template_body.h for a build of the template, which shape skin differently.
#pragma once

#include <functional>
#include <vector>

#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk_field.h"

namespace palpate::body {

/// Maps points of the fitted skin to the body, one for one.
using ShapeOfSkin = std::function<std::vector<Vec3>(const std::vector<SkinPoint>&)>;

/// Fills in position and normal of landmarks whose bone_position is known: from `places` of the fitted skin near them,
/// and where that skin faces back or front, moved until it is straight above the bone.
void setAboveBones(const TrunkField& field, std::vector<SkinPoint> places, std::vector<SkinLandmark>& landmarks,
                   const ShapeOfSkin& shaped);

}  // namespace palpate::body
