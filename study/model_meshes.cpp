#include "study/model_meshes.h"

#include "palpate/body/back.h"
#include "palpate/body/hand.h"

namespace palpate::study {

mesh::TriangleMesh backModel(std::size_t triangles) {
  return body::makeBack(
      {.triangles = triangles, .shape = {.stature_mm = 1750, .relief = body::noRelief(), .asymmetry = 0}});
}

mesh::TriangleMesh handModel() { return body::makeHand({.triangles = kHandTriangles}); }

}  // namespace palpate::study
