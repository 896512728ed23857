#include "apps/viewer/session.h"

#include <algorithm>

namespace palpate::viewer {

bool operator==(const DysfunctionList& a, const DysfunctionList& b) {
  const auto same = [](const maps::Dysfunction& x, const maps::Dysfunction& y) {
    return x.x_mm == y.x_mm && x.y_mm == y.y_mm && x.radius_mm == y.radius_mm && x.change_percent == y.change_percent &&
           x.edge_softness == y.edge_softness;
  };
  return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
}

std::uint32_t consequenceOf(std::string_view table) {
  if (table == "body") return kBodyChange;
  if (table == "friction") return kFingerChange;
  if (table == "contact") return kFingerChange | kMapChange;  // the source of the contact is built with the maps
  if (table == "output" || table == "safety") return kNothing;
  return kMapChange;
}

DysfunctionList dysfunctionsOf(const Session& session) { return {session.scene.dysfunctions}; }

void setDysfunctions(Session& session, DysfunctionList list) {
  session.scene.dysfunctions = std::move(list.items);
  session.editor.selected = std::min(session.editor.selected, static_cast<int>(session.scene.dysfunctions.size()) - 1);
  session.changed |= kMapChange;
}

}  // namespace palpate::viewer
