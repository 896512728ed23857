#include "view/viewer/state/ruler.h"

#include <fmt/format.h>

#include "palpate/base/language.h"
#include "palpate/view/orbit.h"

namespace palpate::viewer {

namespace {

constexpr int kPathPieces = 96;
/// Above the skin, so that the line does not seem to sink in, mm.
constexpr double kRulerLiftMm = 0.6;
constexpr double kEndCrossMm = 2.5;
constexpr view::Paint kRulerPaint{60, 200, 120, 255};

std::vector<SkinPlace> pathOver(const contact::Surface& surface, const SkinPlace& from, const SkinPlace& to) {
  const double length = (to.point - from.point).norm();
  std::vector<SkinPlace> path = {from};
  for (int i = 1; i < kPathPieces; ++i) {
    const double share = static_cast<double>(i) / kPathPieces;
    const Vec3 inside = from.point + share * (to.point - from.point);
    // The skin nearest to an inner point is never farther than the whole length, since the ends are on it.
    if (const auto place = view::skinNear(surface, inside, length + 1.0)) path.push_back(*place);
  }
  path.push_back(to);
  return path;
}

Vec3 lifted(const SkinPlace& place) { return place.point + kRulerLiftMm * place.normal; }

}  // namespace

void measureAt(const SkinPlace& place, const contact::Surface& surface, Ruler& ruler) {
  if (ruler.ends.size() >= 2) ruler.ends.clear();
  ruler.ends.push_back(place);
  ruler.path.clear();
  if (ruler.ends.size() == 2) ruler.path = pathOver(surface, ruler.ends[0], ruler.ends[1]);
}

double straightMm(const Ruler& ruler) {
  return ruler.ends.size() < 2 ? 0.0 : (ruler.ends[1].point - ruler.ends[0].point).norm();
}

double alongSkinMm(const Ruler& ruler) {
  double length = 0.0;
  for (std::size_t i = 1; i < ruler.path.size(); ++i) {
    length += (ruler.path[i].point - ruler.path[i - 1].point).norm();
  }
  return length;
}

std::string formatRuler(const Ruler& ruler) {
  if (ruler.ends.size() < 2) return {};
  const Vec3 by = ruler.ends[1].point - ruler.ends[0].point;
  return trf("{:.1f} mm straight, {:.1f} mm along the skin\nx {:+.1f}  y {:+.1f}  z {:+.1f} mm", straightMm(ruler),
             alongSkinMm(ruler), by.x(), by.y(), by.z());
}

std::vector<view::Lines> rulerLines(const Ruler& ruler) {
  view::Lines line{2.5, {}};
  for (std::size_t i = 1; i < ruler.path.size(); ++i) {
    line.add(lifted(ruler.path[i - 1]), lifted(ruler.path[i]), kRulerPaint);
  }
  for (const SkinPlace& end : ruler.ends) line.addCross(lifted(end), kEndCrossMm, kRulerPaint);
  return {line};
}

}  // namespace palpate::viewer
