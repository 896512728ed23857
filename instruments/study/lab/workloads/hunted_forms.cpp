// One function a form: unions of primitives with others cut out. Parts thinner than a cell get holes or are lost in
// meshing: that too is a body. Data flow: random numbers -> here -> hunted_shapes.cpp. The distances are those of
// body/signed_distance.h.
#include "lab/workloads/hunted_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "palpate/body/signed_distance.h"

namespace palpate::lab {
namespace {

using body::Capsule;
using body::Field;
using std::numbers::pi;

Vec3 someDirection(Random& random) {
  const Vec3 v = random.normal3();
  return v.norm() > 1e-6 ? Vec3(v.normalized()) : Vec3(Vec3::UnitX());
}

double ball(const Vec3& p, double radius) { return p.norm() - radius; }

/// Rounded by its own distance outside, sharp inside.
double block(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

double ring(const Vec3& p, double ring_radius, double tube) {
  return std::hypot(std::hypot(p.x(), p.y()) - ring_radius, p.z()) - tube;
}

using Capsules = std::vector<Capsule>;

/// Joined by blends of `k`, or sharply for 0.
double joined(double d, const Capsules& more, const Vec3& p, double k) {
  for (const Capsule& c : more) d = k > 0.0 ? body::smoothUnion(d, c.distance(p), k) : std::min(d, c.distance(p));
  return d;
}

double without(double d, const Capsules& cuts, const Vec3& p, double k) {
  for (const Capsule& c : cuts) d = k > 0.0 ? body::smoothDifference(d, c.distance(p), k) : std::max(d, -c.distance(p));
  return d;
}

/// Sharp or blended, half of the time each.
double someBlend(Random& random, double most) { return random.below(2) == 0 ? 0.0 : random.uniform(0.5, most); }

// ---- shapes -------------------------------------------------------------------------------------------------------

HuntedForm bumps(Random& random) {
  const double radius = random.uniform(35, 60), height = random.uniform(0.5, 3.5), waves = random.uniform(0.08, 0.3);
  return {[=](const Vec3& p) {
            const Vec3 q = waves * p;
            return ball(p, radius) + height * std::sin(q.x()) * std::sin(q.y() + 1) * std::sin(q.z() + 2);
          },
          radius + 6, 3.0};
}

HuntedForm potato(Random& random) {
  Capsules lumps;
  for (int i = 0; i < 5; ++i)
    lumps.push_back(
        {30.0 * someDirection(random), 20.0 * someDirection(random), random.uniform(10, 30), random.uniform(10, 30)});
  const double k = random.uniform(2, 20);
  return {[=](const Vec3& p) { return joined(1e9, lumps, p, k); }, 70, 3.5};
}

/// A ball with holes bored into it, narrower than they are deep.
HuntedForm pockets(Random& random, std::size_t count, double narrow, double wide) {
  Capsules bores;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = someDirection(random), aside = 8.0 * someDirection(random);
    const double mouth = random.uniform(narrow, wide);
    bores.push_back({60.0 * d + aside, random.uniform(-20, 25) * d, mouth, mouth * random.uniform(0.7, 1.3)});
  }
  const double k = someBlend(random, 3.0);
  return {[=](const Vec3& p) { return without(ball(p, 45), bores, p, k); }, 50, narrow < 4 ? 2.0 : 2.8};
}

/// A wide chamber behind a narrow neck.
HuntedForm bottle(Random& random) {
  const double chamber = random.uniform(15, 30), neck = random.uniform(3, 8), k = someBlend(random, 4.0);
  const Capsules cuts{{{0, 0, 0}, {0, 0, -6}, chamber, chamber}, {{0, 0, 0}, {3, 0, 70}, neck, neck}};
  return {[=](const Vec3& p) { return without(ball(p, 45), cuts, p, k); }, 50, 2.6};
}

/// Slots between flat walls, one or two that cross.
HuntedForm crevices(Random& random, int count) {
  std::array<double, 2> half{random.uniform(1.6, 4), random.uniform(1.6, 4)};
  const double depth = random.uniform(-30, 20), tilt = random.uniform(0.2, 1.4);
  return {[=](const Vec3& p) {
            double d = ball(p, 42);
            for (int i = 0; i < count; ++i) {
              const double across = i == 0 ? p.x() : p.x() * std::cos(tilt) + p.y() * std::sin(tilt);
              d = std::max(d, -std::max(std::abs(across) - half[static_cast<std::size_t>(i)], depth - p.z()));
            }
            return d;
          },
          47, 2.2};
}

HuntedForm limbs(Random& random) {
  Capsules parts;
  for (int i = 0; i < 6; ++i) {
    const Vec3 d = someDirection(random), bend = d + 0.6 * someDirection(random);
    const double thick = random.uniform(5, 12), mid = random.uniform(0.7, 1.0) * thick;
    parts.push_back({15.0 * d, 55.0 * d, thick, mid});
    parts.push_back({55.0 * d, 55.0 * d + 40.0 * bend.normalized(), mid, 0.6 * mid});
  }
  const double k = someBlend(random, 8.0);
  return {[=](const Vec3& p) { return joined(ball(p, 26), parts, p, k); }, 104, 3.6};
}

/// A palm with fingers that nearly touch.
HuntedForm fingers(Random& random) {
  Capsules parts;
  const double thick = random.uniform(6, 8), gap = random.uniform(1.5, 4);
  for (int i = 0; i < 5; ++i) {
    const double x = (i - 2) * (2 * thick + gap);
    parts.push_back({{x, 0, 0},
                     {x * random.uniform(0.85, 1.1), random.uniform(45, 70), random.uniform(-8, 8)},
                     thick,
                     thick * random.uniform(0.6, 1.0)});
  }
  const double k = someBlend(random, 3.0);
  return {[=](const Vec3& p) {
            return joined(block(p + Vec3(0, 25, 0), {2.4 * (2 * thick + gap), 22, 9}) - 3.0, parts, p, k);
          },
          84, 2.8};
}

/// A ball with cones that end in about a cell and a half.
HuntedForm horns(Random& random) {
  Capsules cones;
  for (std::size_t i = 0, n = 3 + random.below(12); i < n; ++i) {
    const Vec3 d = someDirection(random);
    cones.push_back({20.0 * d, random.uniform(45, 75) * d, random.uniform(5, 12), 3.2});
  }
  return {[=](const Vec3& p) { return joined(ball(p, 28), cones, p, 0.0); }, 82, 2.8};
}

/// Plates one over the other on a post, gaps and plates a few millimetres thick.
HuntedForm plates(Random& random) {
  const double thick = random.uniform(1.6, 3), pitch = 2 * thick + random.uniform(3, 12), size = random.uniform(22, 38);
  const int count = 1 + static_cast<int>(random.below(4));
  const double height = pitch * (count - 1);
  return {[=](const Vec3& p) {
            double d = Capsule{{0, 0, 0}, {0, 0, height + 1}, 5, 5}.distance(p);
            for (int i = 0; i < count; ++i)
              d = std::min(d, block(p - Vec3(0, 0, pitch * i), {size, size * 0.8, thick}));
            return d;
          },
          std::max(size, height + thick) + 8, 2.1};
}

HuntedForm torus(Random& random) {
  const double r = random.uniform(20, 45), tube = random.uniform(4, std::min(16.0, 0.6 * r));
  return {[=](const Vec3& p) { return ring(p, r, tube); }, r + tube + 5, 2.8};
}

/// Two rings, one through the other, that do not touch.
HuntedForm chain(Random& random) {
  const double tube = random.uniform(4, 8), shift = random.uniform(22, 34);
  return {[=](const Vec3& p) {
            const Vec3 q = p - Vec3(shift, 0, 0);
            return std::min(ring(p, 30, tube), ring(Vec3(q.x(), q.z(), q.y()), 30, tube));
          },
          78, 3.0};
}

HuntedForm bowl(Random& random) {
  const double wall = random.uniform(1.8, 6), rim = random.uniform(-20, 25);
  return {[=](const Vec3& p) { return std::max(std::abs(ball(p, 38)) - wall, p.z() - rim); }, 50, 2.4};
}

/// A hollow ball: the wall of the hollow is a part of its own that faces inwards.
HuntedForm hollow(Random& random) {
  const double wall = random.uniform(5.5, 14);
  const Vec3 off = random.uniform(0, 0.4) * wall * someDirection(random);
  return {[=](const Vec3& p) { return std::max(ball(p, 40), -ball(p - off, 40 - wall)); }, 45, 2.8};
}

HuntedForm tunnel(Random& random) {
  const double bore = random.uniform(3.5, 14), k = someBlend(random, 5.0);
  const Vec3 d = someDirection(random), off = random.uniform(0, 18) * someDirection(random);
  const Capsules cut{{off - 90.0 * d, off + 90.0 * d, bore, bore}};
  return {[=](const Vec3& p) { return without(ball(p, 40), cut, p, k); }, 45, 2.6};
}

HuntedForm gyroid(Random& random) {
  const double wave = 2 * pi / random.uniform(28, 50), wall = random.uniform(0.2, 0.7);
  return {[=](const Vec3& p) {
            const Vec3 q = wave * p;
            const double g = std::sin(q.x()) * std::cos(q.y()) + std::sin(q.y()) * std::cos(q.z()) +
                             std::sin(q.z()) * std::cos(q.x());
            return std::max(ball(p, 40), 0.6 * (std::abs(g) - wall) / wave);
          },
          45, 2.8};
}

/// A block with teeth.
HuntedForm comb(Random& random) {
  const double tooth = random.uniform(2, 4), gap = random.uniform(3, 8), length = random.uniform(15, 45);
  return {[=](const Vec3& p) {
            const double x = std::remainder(p.x(), 2 * tooth + gap);
            const double teeth = std::max({std::abs(x) - tooth, std::abs(p.y()) - 14, std::abs(p.z()) - length});
            return std::max(std::min(teeth, block(p + Vec3(0, 0, length), {40, 14, 8})), std::abs(p.x()) - 40);
          },
          length + 13 > 46 ? length + 13 : 46, 2.4};
}

/// Blocks joined and cut, edges as sharp as the lattice lets them be.
HuntedForm blocks(Random& random) {
  std::vector<std::pair<Vec3, Vec3>> parts;
  for (int i = 0; i < 8; ++i) parts.push_back({random.uniform3(-25, 25), random.uniform3(6, 24)});
  return {[=](const Vec3& p) {
            double d = block(p, {24, 24, 24});
            for (std::size_t i = 0; i < parts.size(); ++i) {
              const double b = block(p - parts[i].first, parts[i].second);
              d = i % 2 == 0 ? std::min(d, b) : std::max(d, -b);
            }
            return d;
          },
          54, 2.6};
}

/// A sheet rolled up: a wall next to a wall, turn after turn.
HuntedForm scroll(Random& random) {
  const double pitch = random.uniform(11, 18), wall = random.uniform(1.8, 3.2);
  return {[=](const Vec3& p) {
            const double r = std::hypot(p.x(), p.y()), turn = std::atan2(p.y(), p.x()) / (2 * pi);
            const double off = 0.8 * (std::abs(std::remainder(r - pitch * turn, pitch)) - wall);
            return std::max({off, r - 42.0, 8.0 - r, std::abs(p.z()) - 22.0});
          },
          47, 2.4};
}

HuntedForm washboard(Random& random) {
  const double wave = 2 * pi / random.uniform(9, 25), height = random.uniform(2, 8);
  return {[=](const Vec3& p) {
            const double top = 0.5 * (p.z() - height * std::sin(wave * p.x()) * std::cos(0.3 * wave * p.y()));
            return std::max({top, -p.z() - 18.0, std::abs(p.x()) - 42.0, std::abs(p.y()) - 30.0});
          },
          48, 2.6};
}

/// Balls in a row, joined by necks.
HuntedForm necklace(Random& random) {
  Capsules parts;
  const double neck = random.uniform(3, 6);
  for (int i = -2; i <= 2; ++i) {
    const Vec2 aside = random.uniform2(-6, 6);
    const Vec3 at(22.0 * i, aside.x(), aside.y());
    const double r = random.uniform(7, 13);
    parts.push_back({at, at, r, r});
    parts.back().to.x() += 1e-3;  // a capsule needs a length
  }
  return {[=](const Vec3& p) {
            return joined(Capsule{{-44, 0, 0}, {44, 0, 0}, neck, neck}.distance(p), parts, p, 0.0);
          },
          62, 2.6};
}

HuntedForm wedge(Random& random) {
  const double angle = random.uniform(0.15, 0.9), twist = random.uniform(-0.02, 0.02);
  return {[=](const Vec3& p) {
            const double c = std::cos(twist * p.y()), s = std::sin(twist * p.y());
            const double x = c * p.x() + s * p.z(), z = -s * p.x() + c * p.z();
            const double flank = std::abs(x) * std::cos(angle) + (z - 30) * std::sin(angle);
            return 0.7 * std::max({flank, std::abs(p.y()) - 35.0, -z - 30.0, std::abs(x) - 38.0});
          },
          62, 2.8};
}

/// Half a body's worth of all of it: limbs, bores and slots on one potato.
HuntedForm everything(Random& random) {
  const HuntedForm lumps = potato(random);
  Capsules arms, bores;
  for (int i = 0; i < 4; ++i) {
    const Vec3 d = someDirection(random), e = someDirection(random);
    arms.push_back({20.0 * d, 70.0 * d, random.uniform(5, 9), random.uniform(3.5, 6)});
    bores.push_back({70.0 * e, random.uniform(-10, 20) * e, random.uniform(3.5, 8), random.uniform(3.5, 8)});
  }
  const double slot = random.uniform(1.8, 3);
  const Field core = lumps.field;
  return {[=](const Vec3& p) {
            const double d = without(joined(core(p), arms, p, 0.0), bores, p, 0.0);
            return std::max(d, -std::max(std::abs(p.y()) - slot, 12.0 - p.z()));
          },
          84, 2.8};
}

constexpr std::array<NamedForm, kHuntedForms> kForms{{
    {"bumps", bumps},
    {"potato", potato},
    {"pocket", [](Random& r) { return pockets(r, 1, 4, 12); }},
    {"narrow_pocket", [](Random& r) { return pockets(r, 1, 2.6, 4); }},
    {"many_pockets", [](Random& r) { return pockets(r, 9, 4, 9); }},
    {"bottle", bottle},
    {"crevice", [](Random& r) { return crevices(r, 1); }},
    {"crossing_crevices", [](Random& r) { return crevices(r, 2); }},
    {"limbs", limbs},
    {"fingers", fingers},
    {"horns", horns},
    {"plates", plates},
    {"torus", torus},
    {"chain", chain},
    {"bowl", bowl},
    {"hollow", hollow},
    {"tunnel", tunnel},
    {"gyroid", gyroid},
    {"comb", comb},
    {"blocks", blocks},
    {"scroll", scroll},
    {"washboard", washboard},
    {"necklace", necklace},
    {"wedge", wedge},
    {"everything", everything},
    {"wide_pocket", [](Random& r) { return pockets(r, 2, 10, 20); }},
}};

}  // namespace

const std::array<NamedForm, kHuntedForms>& huntedForms() { return kForms; }

}  // namespace palpate::lab
