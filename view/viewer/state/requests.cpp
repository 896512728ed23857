#include "view/viewer/state/requests.h"

namespace palpate::viewer {

std::uint32_t consequenceOf(std::string_view table) {
  if (table == "body") return kBodyChange;
  if (table == "friction" || table == "device") return kFingerChange;
  if (table == "tissue") return kFingerChange | kMapChange;   // how it relaxes is the finger's
  if (table == "contact") return kFingerChange | kMapChange;  // the source of the contact is built with the maps
  if (table == "output" || table == "safety" || table == "view") return kNothing;
  if (table == "finger") return kFingerChange | kMapChange;  // their radii, and the paths that the world knows
  return kMapChange;
}

}  // namespace palpate::viewer
