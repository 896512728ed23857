// Rows -> groups -> means of logarithms and their scatter -> a mean a drag -> a mean a point, and from drags that
// differ the stretch along them, by least squares.
//
// Based on: Ji, dissertation 2008, section 5.1 and Appendix C (plain means); E29, E30, E34.
#include "palpate/measure/average.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/random.h"

namespace palpate::measure {

namespace {

using maps::Averaging;
using maps::LogTensor;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kSectorDeg = 45.0;
/// Two drags closer than this do not separate the tissue from the drag (axes, so 90 is the most).
constexpr double kMinBetweenDragsDeg = 60.0;
constexpr double kHardlyDeg = 10.0;
constexpr double kHardlyResultant = 0.6;
/// Presses that the scatter of all points counts as.
constexpr double kPooledPresses = 2.0;
/// The error below which a stated one is not believed: half a percent of size.
constexpr double kMinLogSd = 0.005;
constexpr std::size_t kDraws = 4000;

maps::Ellipse ellipseOf(const PressRow& press) {
  return maps::canonicalEllipse(press.half_major_mm, press.half_major_mm / press.major_over_minor,
                                press.direction_deg * kRadPerDeg);
}

/// Twice the angle, which is the same for both senses of an axis.
Vec2 doubled(double direction_rad) { return {std::cos(2.0 * direction_rad), std::sin(2.0 * direction_rad)}; }

/// In (-90, 90].
double axisDeg(double degrees) {
  const double turned = std::remainder(degrees, 180.0);
  return turned <= -90.0 ? turned + 180.0 : turned;
}

int dragSector(const std::optional<double>& drag_deg) {
  if (!drag_deg) return -1;
  const int sector = static_cast<int>(std::lround(*drag_deg / kSectorDeg)) % 8;
  return sector < 0 ? sector + 8 : sector;
}

// --- one press

/// Covariance of the logarithm, from the stated errors of size, ratio and direction; nothing unless all are stated.
std::optional<Mat3> statedCovariance(const PressRow& press) {
  if (!press.sd_half_major_mm || !press.sd_ratio || !press.sd_direction_deg) return std::nullopt;
  const double size = *press.sd_half_major_mm / press.half_major_mm;
  const double half_ratio = 0.5 * *press.sd_ratio / press.major_over_minor;
  const maps::Ellipse ellipse = ellipseOf(press);
  const double half_difference = -0.5 * std::log(ellipse.aspect);
  const Vec2 along = doubled(ellipse.direction_rad);
  const Vec2 across(-along.y(), along.x());
  const double turn = 2.0 * half_difference * *press.sd_direction_deg * kRadPerDeg;
  Mat3 covariance = kMinLogSd * kMinLogSd * Mat3::Identity();
  covariance(0, 0) += size * size + half_ratio * half_ratio;
  covariance.bottomRightCorner<2, 2>() +=
      half_ratio * half_ratio * along * along.transpose() + turn * turn * across * across.transpose();
  return covariance;
}

/// Weight of a press among those of its person.
double pressWeight(const PressRow& press, bool all_stated) {
  return all_stated ? 1.0 / statedCovariance(press)->trace() : 1.0;
}

// --- presses of one person, people of one drag

struct Unit {
  LogTensor tensor = LogTensor::Zero();
  maps::PlainMean plain{0.0, 0.0, 0.0, 0.0};
};

Unit averageUnit(const std::vector<const PressRow*>& presses) {
  const bool all_stated =
      std::ranges::all_of(presses, [](const PressRow* p) { return statedCovariance(*p).has_value(); });
  Unit unit;
  double weights = 0.0;
  const auto n = static_cast<double>(presses.size());
  for (const PressRow* press : presses) {
    const double weight = pressWeight(*press, all_stated);
    unit.tensor += weight * maps::logTensor(ellipseOf(*press));
    weights += weight;
    const double major_cm = press->half_major_mm / 5.0;
    unit.plain.major_cm += major_cm / n;
    unit.plain.minor_cm += major_cm / press->major_over_minor / n;
    unit.plain.major_over_minor += press->major_over_minor / n;
    unit.plain.direction_deg += press->direction_deg / n;
  }
  unit.tensor /= weights;
  return unit;
}

/// Presses at one point that pull one way.
struct Group {
  std::optional<double> drag_deg = {};
  std::vector<const PressRow*> presses = {};
  std::vector<Unit> units = {};  ///< people; of one person presses
  bool of_people = false;
  LogTensor mean = LogTensor::Zero();
  Mat3 scatter = Mat3::Zero();      ///< sum of the units' squares about the mean
  std::optional<Mat3> stated = {};  ///< mean over the presses
};

std::optional<double> meanDrag(const std::vector<const PressRow*>& presses) {
  Vec2 sum = Vec2::Zero();
  for (const PressRow* press : presses) {
    if (!press->drag_deg) return std::nullopt;
    sum += Vec2(std::cos(*press->drag_deg * kRadPerDeg), std::sin(*press->drag_deg * kRadPerDeg));
  }
  return std::atan2(sum.y(), sum.x()) * kDegPerRad;
}

std::vector<std::vector<const PressRow*>> bySubject(const std::vector<const PressRow*>& presses) {
  std::vector<std::vector<const PressRow*>> people;
  for (const PressRow* press : presses) {
    const auto same = [&](const auto& person) { return person.front()->subject == press->subject; };
    const auto found = std::ranges::find_if(people, same);
    if (found == people.end()) {
      people.push_back({press});
    } else {
      found->push_back(press);
    }
  }
  return people;
}

Group makeGroup(std::vector<const PressRow*> presses) {
  Group group{.drag_deg = meanDrag(presses), .presses = std::move(presses)};
  const auto people = bySubject(group.presses);
  group.of_people = people.size() > 1;
  for (const auto& person : people) group.units.push_back(averageUnit(person));
  for (const Unit& unit : group.units) group.mean += unit.tensor / static_cast<double>(group.units.size());
  if (!group.of_people) {
    group.units.clear();  // the mean stays: it is weighted
    for (const PressRow* press : group.presses) group.units.push_back(averageUnit({press}));
  }
  for (const Unit& unit : group.units) {
    group.scatter += (unit.tensor - group.mean) * (unit.tensor - group.mean).transpose();
  }
  Mat3 stated = Mat3::Zero();
  for (const PressRow* press : group.presses) {
    const auto one = statedCovariance(*press);
    if (!one) return group;
    stated += *one / static_cast<double>(group.presses.size());
  }
  group.stated = stated;
  return group;
}

// --- how sure

/// Scatter of people, and of presses of one person, over all points: the error of a point with few of them.
struct PooledScatter {
  Mat3 sum = Mat3::Zero();
  double freedom = 0.0;
  void add(const Group& group) {
    sum += group.scatter;
    freedom += static_cast<double>(group.units.size()) - 1.0;
  }
  bool known() const { return freedom > 0.0; }
  Mat3 covariance() const { return sum / freedom; }
};

struct Error3 {
  Mat3 covariance = Mat3::Zero();
  double freedom = 0.0;
};

/// Error of a group's mean.
Error3 meanError(const Group& group, const PooledScatter& pooled) {
  const auto n = static_cast<double>(group.units.size());
  if (pooled.known()) {
    const double freedom = n - 1.0 + kPooledPresses;
    return {(group.scatter + kPooledPresses * pooled.covariance()) / (freedom * n), freedom};
  }
  if (group.stated) return {*group.stated / n, 30.0};  // a fit to many dots stated it
  return {};
}

/// Student's quantile: 95 % are within this many standard errors.
double quantile95(double freedom) {
  constexpr std::array kTable = {12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  if (freedom < 1.0) return kTable.front();
  if (freedom >= 10.0) return 1.96 + 2.68 / freedom;
  return kTable.at(static_cast<std::size_t>(freedom) - 1);
}

/// Errors of size, ratio and direction by draws: near a circle nothing is linear.
void estimateErrors(MeanEllipse& mean) {
  const LogTensor centre = maps::logTensor(mean.ellipse);
  const Mat3 root = (mean.covariance + 1e-14 * Mat3::Identity()).llt().matrixL();
  Random random(17);
  Vec3 squares = Vec3::Zero();
  for (std::size_t i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    const double y = random.normal();
    const double z = random.normal();
    const maps::Ellipse drawn = maps::ellipseOf(LogTensor(centre + root * Vec3(x, y, z)));
    const Vec3 off(drawn.half_major_mm - mean.half_major_mm.value, 1.0 / drawn.aspect - mean.major_over_minor.value,
                   axisDeg(drawn.direction_rad * kDegPerRad - mean.direction_deg.value));
    squares += off.cwiseAbs2();
  }
  const Vec3 sd = (squares / static_cast<double>(kDraws)).cwiseSqrt();
  mean.half_major_mm.sd = sd.x();
  mean.major_over_minor.sd = sd.y();
  mean.direction_deg.sd = sd.z();
}

MeanEllipse makeMeanEllipse(const maps::Ellipse& ellipse, const Error3& error) {
  MeanEllipse mean{.ellipse = ellipse,
                   .half_major_mm = {ellipse.half_major_mm, kNotKnown},
                   .major_over_minor = {1.0 / ellipse.aspect, kNotKnown},
                   .direction_deg = {axisDeg(ellipse.direction_rad * kDegPerRad), kNotKnown},
                   .covariance = error.covariance,
                   .freedom = error.freedom};
  if (error.freedom > 0.0) estimateErrors(mean);
  return mean;
}

void countIn(MeanEllipse& mean, const std::vector<const PressRow*>& presses) {
  mean.presses = presses.size();
  mean.subjects = bySubject(presses).size();
  Vec2 sum = Vec2::Zero();
  for (const PressRow* press : presses) sum += doubled(ellipseOf(*press).direction_rad);
  mean.resultant = sum.norm() / static_cast<double>(presses.size());
  mean.hardly_determined = mean.direction_deg.sd > kHardlyDeg || mean.resultant < kHardlyResultant;
}

// --- plain

maps::PlainMean computePlainMean(const std::vector<Unit>& units) {
  maps::PlainMean mean{0.0, 0.0, 0.0, 0.0};
  for (const Unit& unit : units) {
    mean.major_cm += unit.plain.major_cm;
    mean.minor_cm += unit.plain.minor_cm;
    mean.major_over_minor += unit.plain.major_over_minor;
    mean.direction_deg += unit.plain.direction_deg;
  }
  const auto n = static_cast<double>(units.size());
  return {mean.major_cm / n, mean.minor_cm / n, mean.major_over_minor / n, mean.direction_deg / n};
}

maps::Ellipse ellipseOf(const Group& group, Averaging averaging) {
  return averaging == Averaging::plain ? maps::asPrinted(computePlainMean(group.units)) : maps::ellipseOf(group.mean);
}

// --- drags of a point

/// Axes of the drags that are farthest apart, degrees; 0 where a drag is not known.
double betweenDrags(const std::vector<Group>& groups) {
  double most = 0.0;
  for (const Group& a : groups) {
    for (const Group& b : groups) {
      if (a.drag_deg && b.drag_deg) most = std::max(most, std::abs(axisDeg(*a.drag_deg - *b.drag_deg)));
    }
  }
  return most;
}

/// Over the drags, each counting the same.
struct OverDrags {
  LogTensor mean = LogTensor::Zero();
  Error3 error{Mat3::Zero(), std::numeric_limits<double>::infinity()};
};

OverDrags overDrags(const std::vector<DragMean>& drags) {
  OverDrags all;
  const auto n = static_cast<double>(drags.size());
  for (const DragMean& drag : drags) {
    all.mean += maps::logTensor(drag.mean.ellipse) / n;
    all.error.covariance += drag.mean.covariance / (n * n);
    all.error.freedom = std::min(all.error.freedom, drag.mean.freedom);
  }
  return all;
}

/// Tensor of a drag = that of the tissue + stretch * (0, cos 2 drag, sin 2 drag): takes the stretch out of the mean.
Estimate removeDragStretch(const std::vector<DragMean>& drags, OverDrags& all) {
  Vec2 centre = Vec2::Zero();
  for (const DragMean& drag : drags) centre += doubled(*drag.drag_deg * kRadPerDeg) / static_cast<double>(drags.size());
  double square = 0.0;
  double product = 0.0;
  double variance = 0.0;
  for (const DragMean& drag : drags) {
    const Vec2 off = doubled(*drag.drag_deg * kRadPerDeg) - centre;
    square += off.squaredNorm();
    product += off.dot((maps::logTensor(drag.mean.ellipse) - all.mean).tail<2>());
    variance += off.dot(drag.mean.covariance.bottomRightCorner<2, 2>() * off);
  }
  const double stretch = product / square;
  variance /= square * square;
  all.mean.tail<2>() -= stretch * centre;
  all.error.covariance.bottomRightCorner<2, 2>() += variance * centre * centre.transpose();
  const double ratio = std::exp(2.0 * stretch);
  return {ratio, all.error.freedom > 0.0 ? 2.0 * ratio * std::sqrt(variance) : kNotKnown};
}

/// Mean over all presses that state it.
std::optional<double> meanNumber(const std::vector<const PressRow*>& presses, std::optional<double> PressRow::*member) {
  double sum = 0.0;
  double count = 0.0;
  for (const PressRow* press : presses) {
    if (!(press->*member)) continue;
    sum += *(press->*member);
    count += 1.0;
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

PointMean pointMean(const std::vector<Group>& groups, const PooledScatter& of_people, const PooledScatter& of_presses,
                    Averaging averaging) {
  std::vector<const PressRow*> presses;
  PointMean point;
  for (const Group& group : groups) {
    DragMean drag{group.drag_deg, makeMeanEllipse(ellipseOf(group, averaging),
                                                  meanError(group, group.of_people ? of_people : of_presses))};
    countIn(drag.mean, group.presses);
    point.drags.push_back(std::move(drag));
    presses.insert(presses.end(), group.presses.begin(), group.presses.end());
  }
  point.name = presses.front()->point;
  for (const PressRow* press : presses) point.place_mm += press->place_mm;
  point.place_mm /= static_cast<double>(presses.size());
  point.mean = point.drags.front().mean;
  if (point.drags.size() > 1) {
    OverDrags all = overDrags(point.drags);
    if (betweenDrags(groups) >= kMinBetweenDragsDeg) point.along_drag = removeDragStretch(point.drags, all);
    point.mean = makeMeanEllipse(maps::ellipseOf(all.mean), all.error);
    countIn(point.mean, presses);
  }
  point.half_major_4_mm = meanNumber(presses, &PressRow::half_major_4_mm);
  point.peak_mm = meanNumber(presses, &PressRow::peak_mm);
  point.stiffness_n_per_mm = meanNumber(presses, &PressRow::stiffness_n_per_mm);
  return point;
}

// --- mirror images

void mirror(MeanEllipse& mean) {
  const maps::Ellipse& e = mean.ellipse;
  mean.ellipse =
      maps::canonicalEllipse(e.half_major_mm, e.half_major_mm * e.aspect, std::numbers::pi - e.direction_rad);
  mean.direction_deg.value = axisDeg(180.0 - mean.direction_deg.value);
  const Mat3 flip = Vec3(1.0, 1.0, -1.0).asDiagonal();
  mean.covariance = flip * mean.covariance * flip;
}

PointMean mirrored(const PointMean& point, const std::string& name) {
  PointMean other = point;
  other.name = name;
  other.mirrored_from = point.name;
  other.place_mm.x() = -point.place_mm.x();
  mirror(other.mean);
  for (DragMean& drag : other.drags) {
    mirror(drag.mean);
    if (drag.drag_deg) drag.drag_deg = std::remainder(180.0 - *drag.drag_deg, 360.0);
  }
  return other;
}

void addMirrors(Averages& averages) {
  std::vector<std::string> names;
  for (const PointMean& point : averages.points) names.push_back(point.name);
  for (const auto& [from, to] : averages.settings.mirrors) {
    const auto source = std::ranges::find(averages.points, from, &PointMean::name);
    if (source == averages.points.end()) throw Error(unknownName("point", from, "mirror", names));
    if (std::ranges::find(averages.points, to, &PointMean::name) != averages.points.end()) {
      throw Error(fmt::format("the point {} is measured, so it cannot be the mirror image of {}", oneLine(to), from));
    }
    PointMean other = mirrored(*source, to);  // a copy first: the list may move
    averages.points.push_back(std::move(other));
  }
}

/// The groups of every point, in the order of the rows.
std::vector<std::vector<Group>> groupPresses(std::span<const PressRow> presses, const AverageSettings& settings) {
  std::vector<std::string> order;
  std::map<std::string, std::map<int, std::vector<const PressRow*>>, std::less<>> points;
  for (const PressRow& press : presses) {
    if (settings.drag_deg && dragSector(press.drag_deg) != dragSector(settings.drag_deg)) continue;
    if (!points.contains(press.point)) order.push_back(press.point);
    points[press.point][dragSector(press.drag_deg)].push_back(&press);
  }
  std::vector<std::vector<Group>> all;
  for (const std::string& name : order) {
    std::vector<Group>& groups = all.emplace_back();
    for (auto& [sector, rows] : points[name]) groups.push_back(makeGroup(std::move(rows)));
  }
  return all;
}

}  // namespace

Averages averagePresses(std::span<const PressRow> presses, const AverageSettings& settings) {
  const std::vector<std::vector<Group>> points = groupPresses(presses, settings);
  if (points.empty()) {
    throw Error(settings.drag_deg ? fmt::format("no press was dragged {}", dragDirectionName(*settings.drag_deg))
                                  : std::string("no press to average"));
  }
  PooledScatter of_people;
  PooledScatter of_presses;
  for (const auto& groups : points) {
    for (const Group& group : groups) (group.of_people ? of_people : of_presses).add(group);
  }
  Averages averages{settings, {}};
  for (const auto& groups : points) {
    averages.points.push_back(pointMean(groups, of_people, of_presses, settings.averaging));
  }
  addMirrors(averages);
  return averages;
}

std::array<std::vector<Vec2>, 2> confidenceBand(const MeanEllipse& mean) {
  std::array<std::vector<Vec2>, 2> band;
  if (!(mean.freedom > 0.0)) return band;
  constexpr int kRays = 180;
  constexpr double kStep = 1e-4;
  const double factor = quantile95(mean.freedom);
  const LogTensor centre = maps::logTensor(mean.ellipse);
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRays;
    const Vec2 ray(std::cos(angle), std::sin(angle));
    const auto log_radius = [&](const LogTensor& tensor) {
      return -std::log(maps::locationRatio(maps::ellipseOf(tensor), ray));
    };
    Vec3 slope;
    for (int k = 0; k < 3; ++k) {
      const LogTensor step = kStep * LogTensor::Unit(k);
      slope[k] = (log_radius(centre + step) - log_radius(centre - step)) / (2.0 * kStep);
    }
    const double sd = std::sqrt(slope.dot(mean.covariance * slope));
    const double radius = std::exp(log_radius(centre));
    band[0].emplace_back(ray * radius * std::exp(-factor * sd));
    band[1].emplace_back(ray * radius * std::exp(factor * sd));
  }
  return band;
}

std::string dragRemark(const PointMean& point) {
  if (point.knowsTissue()) return {};
  const auto known = [](const DragMean& drag) { return drag.drag_deg.has_value(); };
  if (!std::ranges::all_of(point.drags, known)) {
    return "the rows do not say which way the skin was pulled: the direction may be that of the drag (E34)";
  }
  if (point.drags.size() == 1) {
    return fmt::format(
        "pulled {} only: one way of pulling can never give the tissue's own direction (E34); pull a "
        "second time across it",
        dragDirectionName(*point.drags.front().drag_deg));
  }
  return "the drag directions are less than 60 degrees apart as axes: they cannot separate the tissue from the drag "
         "(E34)";
}

}  // namespace palpate::measure
