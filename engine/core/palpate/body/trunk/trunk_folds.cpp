// Each stroke is a chain of short pieces laid onto the skin once; a vertex looks up its nearest place on the chain.
#include "palpate/body/trunk/trunk_folds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {

namespace {

/// The influence that lessens a fold.
enum class Follows : unsigned char { nothing, hips, belly };

/// A row of the table below. Places are near the fitted skin of the right side, mm.
struct FoldRow {
  std::array<Vec3, 5> line;
  std::size_t points;  // points of the line that count
  double reach_mm;
  double out_mm;
  Vec3 shift_mm;
  double gathered;
  double fade_mm;  // at both ends; 0: it ends in the middle of the body or is a point
  Follows follows;
};

const Vec3 kStill = Vec3::Zero();

const std::array<FoldRow, 17> kStrokes = {{
    // The buttock hangs over the fold, and the fold is a crease under it.
    {{Vec3(34, -440, 112), Vec3(65, -444, 117), Vec3(95, -444, 112)},
     3,
     34,
     1.0,
     Vec3(0, -5.5, 1.0),
     0,
     30,
     Follows::hips},
    {{Vec3(24, -461, 78), Vec3(42, -467, 84), Vec3(70, -470, 95), Vec3(98, -467, 102), Vec3(122, -459, 96)},
     5,
     13,
     -4.3,
     kStill,
     0.3,
     34,
     Follows::hips},
    // Armpit: the hollow, the folds of pectoralis and latissimus before and behind it, the creases above these.
    {{Vec3(178, 16, 8)}, 1, 34, -5.0, kStill, 0, 0, Follows::nothing},
    {{Vec3(150, 6, -74), Vec3(166, 22, -56), Vec3(186, 36, -48)}, 3, 20, 3.0, kStill, 0, 22, Follows::nothing},
    {{Vec3(186, 26, -38), Vec3(180, 50, -49), Vec3(170, 78, -56)}, 3, 12, -4.0, kStill, 0.3, 26, Follows::nothing},
    {{Vec3(160, -6, 56), Vec3(176, 12, 58), Vec3(192, 24, 62)}, 3, 20, 3.0, kStill, 0, 22, Follows::nothing},
    {{Vec3(190, 18, 56), Vec3(186, 34, 66), Vec3(180, 52, 72)}, 3, 12, -3.5, kStill, 0.3, 24, Follows::nothing},
    // Belly: rounder below the navel, the white line above it, the groin's creases.
    {{Vec3(0, -270, -103), Vec3(0, -290, -103)}, 2, 105, 6.0, kStill, 0, 0, Follows::belly},
    {{Vec3(0, -60, -107), Vec3(0, -120, -107), Vec3(0, -190, -101)}, 3, 16, -1.6, kStill, 0, 40, Follows::nothing},
    {{Vec3(0, -220, -100)}, 1, 27, 0, kStill, 0.5, 0, Follows::nothing},
    {{Vec3(0, -217, -100), Vec3(0, -222, -100)}, 2, 18, -8.5, kStill, 0, 0, Follows::nothing},
    {{Vec3(104, -352, -78), Vec3(72, -385, -88), Vec3(44, -412, -84)}, 3, 14, -2.5, kStill, 0.2, 40, Follows::nothing},
    // Neck and shoulder: collar bone, the hollow above it, the notch, the sternomastoid.
    {{Vec3(30, 156, -42), Vec3(62, 157, -25), Vec3(95, 160, -5), Vec3(125, 158, 8), Vec3(152, 158, 22)},
     5,
     15,
     3.6,
     kStill,
     0.15,
     30,
     Follows::nothing},
    {{Vec3(58, 180, -18), Vec3(84, 178, -4)}, 2, 26, -4.5, kStill, 0, 0, Follows::nothing},
    {{Vec3(0, 147, -43)}, 1, 22, -3.5, kStill, 0, 0, Follows::nothing},
    {{Vec3(16, 158, -46), Vec3(30, 190, -45), Vec3(48, 220, -25)}, 3, 15, 3.0, kStill, 0, 26, Follows::nothing},
    {{Vec3(70, 130, -40), Vec3(105, 132, -27), Vec3(132, 130, -18)}, 3, 18, -2.2, kStill, 0, 26, Follows::nothing},
}};

constexpr double kPieceMm = 5.0;  // piece of a chain: shorter than any fold is wide

/// 1 at the line, 0 with two derivatives at its reach.
double shareWithin(double square, double reach) {
  const double rest = std::max(1 - square / (reach * reach), 0.0);
  return rest * rest * rest;
}

/// Points kPieceMm apart on straight lines between the given ones.
std::vector<Vec3> resampled(std::span<const Vec3> corners) {
  std::vector<Vec3> points{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const int pieces = std::max(1, static_cast<int>((corners[i] - corners[i - 1]).norm() / kPieceMm));
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      points.push_back((1 - t) * corners[i - 1] + t * corners[i]);
    }
  }
  return points;
}

/// One per point: rises from each end over `fade_mm`.
std::vector<double> fadedEnds(std::span<const Vec3> line, double fade_mm) {
  std::vector<double> along(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) along[i] = along[i - 1] + (line[i] - line[i - 1]).norm();
  std::vector<double> strength;
  for (const double at : along) {
    const double t = fade_mm > 0 ? std::clamp(std::min(at, along.back() - at) / fade_mm, 0.0, 1.0) : 1.0;
    strength.push_back(t * t * (3 - 2 * t));
  }
  return strength;
}

double foldAmount(Follows follows, const FoldAmounts& amounts) {
  if (follows == Follows::nothing) return 1;
  return follows == Follows::hips ? amounts.gluteal : amounts.belly;
}

}  // namespace

TrunkFolds::TrunkFolds(const TrunkField& field, const FoldAmounts& amounts) {
  for (const FoldRow& row : kStrokes) {
    const double amount = foldAmount(row.follows, amounts);
    if (amount == 0) continue;
    Stroke stroke{.line = resampled(std::span(row.line).first(row.points)),
                  .strength = {},
                  .box = {},
                  .reach_mm = row.reach_mm,
                  .out_mm = amount * row.out_mm,
                  .shift_mm = amount * row.shift_mm,
                  .gathered = amount * row.gathered};
    for (Vec3& p : stroke.line) {
      p = field.project(p).position;
      stroke.box.extend(p);
    }
    stroke.strength = fadedEnds(stroke.line, row.fade_mm);
    stroke.box.min() -= Vec3::Constant(row.reach_mm);
    stroke.box.max() += Vec3::Constant(row.reach_mm);
    strokes_.push_back(std::move(stroke));
  }
}

void TrunkFolds::move(const Stroke& stroke, const SkinPoint& right, Vec3& moved) {
  if (!stroke.box.contains(right.position)) return;
  double least = stroke.reach_mm * stroke.reach_mm;
  Vec3 nearest = right.position;
  double strength = 0;
  const std::size_t pieces = std::max<std::size_t>(1, stroke.line.size() - 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vec3& a = stroke.line[i];
    const std::size_t next = std::min(i + 1, stroke.line.size() - 1);
    const Vec3 along = stroke.line[next] - a;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp((right.position - a).dot(along) / square, 0.0, 1.0) : 0.0;
    const Vec3 on = a + t * along;
    const double away = (right.position - on).squaredNorm();
    if (away >= least) continue;
    least = away;
    nearest = on;
    strength = (1 - t) * stroke.strength[i] + t * stroke.strength[next];
  }
  if (strength == 0) return;
  const double amount = strength * shareWithin(least, stroke.reach_mm);
  Vec3 to_line = nearest - right.position;
  to_line -= right.normal.dot(to_line) * right.normal;
  moved += amount * (stroke.out_mm * right.normal + stroke.shift_mm + stroke.gathered * to_line);
}

Vec3 TrunkFolds::at(const SkinPoint& fitted) const {
  // A stroke on the plane of symmetry is its own mirror image; others reach a little beyond it with both.
  const bool left = fitted.position.x() < 0;
  const SkinPoint right{left ? mirrored(fitted.position) : fitted.position,
                        left ? mirrored(fitted.normal) : fitted.normal};
  Vec3 moved = Vec3::Zero();
  for (const Stroke& stroke : strokes_) move(stroke, right, moved);
  return left ? mirrored(moved) : moved;
}

}  // namespace palpate::body
