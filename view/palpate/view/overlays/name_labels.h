// The names of the body as they are drawn: a dot on the skin, a plate beside the body, a thin line between them.
#pragma once

#include <vector>

#include "palpate/view/overlays/labels.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

/// Draws those of `scene.names` that are seen from between the eyes, keeps out of what is taken and adds the plates to
/// it. Plates lie in the plane of the screen, the same for both eyes; dots lie on the skin, where `scene.eye` sees it.
void drawNames(Drawing& page, const LabelScene& scene, std::vector<LabelBox>& taken);

}  // namespace palpate::view
