#include "palpate/body/fitting/body_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/mesh/files/detail/json.h"

namespace palpate::body {

namespace {

constexpr int kFitVersion = 1;
constexpr std::size_t kMaxMoves = 5000;
constexpr std::size_t kMaxPoints = 200;
constexpr double kFarthestMm = 1e6;

std::string asJson(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

template <class Range, class Line>
std::string listAsJson(const Range& range, const Line& line) {
  std::string text = "[";
  for (const auto& one : range) text += (text.size() > 1 ? ",\n    " : "\n    ") + line(one);
  return text + "\n  ]";
}

double finite(const mesh::JsonValue& value, double limit) {
  const double number = value.number();
  if (!(std::abs(number) <= limit)) value.fail("is out of range");
  return number;
}

/// Reads members that must be there.
class FitReader {
 public:
  FitReader(std::string_view text, std::string_view file) : document_(text, {.file = file}) {}

  BodyFit fit() const {
    const mesh::JsonValue root = document_.root();
    if (member(root, "palpate_fit").number() != kFitVersion) root.fail("is a fit of another version");
    BodyFit fit;
    readPlacement(root, fit.placement);
    const auto moves = member(root, "skin_moves").items();
    if (moves.size() > kMaxMoves) root.fail("has too many skin_moves");
    for (const auto& move : moves)
      fit.skin_moves.push_back({vector(member(move, "place")), vector(member(move, "by"))});
    const auto points = member(root, "points").items();
    if (points.size() > kMaxPoints) root.fail("has too many points");
    for (const auto& point : points)
      fit.points.push_back({plainName(member(point, "name")), vector(member(point, "mm"))});
    for (const auto& value : member(root, "expected_mm").items()) fit.expected_mm.push_back(number(value));
    fit.rms_mm = number(member(root, "rms_mm"));
    fit.matched = number(member(root, "matched"));
    fit.spine_expected_mm = number(member(root, "spine_expected_mm"));
    fit.certainty = number(member(root, "certainty"));
    return fit;
  }

 private:
  static mesh::JsonValue member(const mesh::JsonValue& of, std::string_view name) {
    const mesh::JsonValue value = of[name];
    if (!value) of.fail(fmt::format("has no \"{}\": is it a fit that palpate body fit wrote?", name));
    return value;
  }
  static double number(const mesh::JsonValue& value) { return finite(value, kFarthestMm); }
  static Vec3 vector(const mesh::JsonValue& value) {
    const auto items = value.items();
    if (items.size() != 3) value.fail("must be a place of three numbers");
    return {number(items[0]), number(items[1]), number(items[2])};
  }
  /// A spoken name has nothing that would have to be escaped when the fit is written again.
  static std::string plainName(const mesh::JsonValue& value) {
    constexpr std::size_t kLongestName = 100;
    const std::string name = value.text();
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ';
    });
    if (!plain || name.empty() || name.size() > kLongestName) value.fail("is not a name of a place");
    return name;
  }
  static void readPlacement(const mesh::JsonValue& root, BodyPlacement& placement) {
    const mesh::JsonValue build = member(root, "build");
    for (const ShapeNumber& one : kShapeNumbers) placement.shape.*one.member = number(member(build, one.name));
    try {
      check(placement.shape);
    } catch (const Error& error) {
      build.fail(error.what());
    }
    const mesh::JsonValue turn = member(root, "rotation");
    const auto columns = turn.items();
    if (columns.size() != 3) turn.fail("must be a rotation");
    for (int axis = 0; axis < 3; ++axis) placement.rotation.col(axis) = vector(columns[static_cast<std::size_t>(axis)]);
    const Mat3 square = placement.rotation.transpose() * placement.rotation;
    if (!square.isIdentity(1e-6) || placement.rotation.determinant() < 0) turn.fail("must be a rotation");
    placement.translation = vector(member(root, "translation"));
  }

  mesh::JsonDocument document_;
};

}  // namespace

std::string fitAsJson(const BodyFit& fit) {
  std::string build;
  for (const ShapeNumber& one : kShapeNumbers) {
    build += fmt::format("{}\"{}\": {}", build.empty() ? "" : ", ", one.name, fit.placement.shape.*one.member);
  }
  const Mat3& turn = fit.placement.rotation;
  std::string text = fmt::format("{{\n  \"palpate_fit\": {},\n  \"build\": {{{}}},\n", kFitVersion, build);
  text += fmt::format("  \"rotation\": [{}, {}, {}],\n  \"translation\": {},\n", asJson(turn.col(0)),
                      asJson(turn.col(1)), asJson(turn.col(2)), asJson(fit.placement.translation));
  text += fmt::format("  \"rms_mm\": {},\n  \"matched\": {},\n  \"spine_expected_mm\": {},\n  \"certainty\": {},\n",
                      fit.rms_mm, fit.matched, fit.spine_expected_mm, fit.certainty);
  text += "  \"points\": " + listAsJson(fit.points, [](const NamedPoint& p) {
            return fmt::format("{{\"name\": \"{}\", \"mm\": {}}}", p.name, asJson(p.position));
          });
  text += ",\n  \"expected_mm\": " + listAsJson(fit.expected_mm, [](double mm) { return fmt::format("{}", mm); });
  text += ",\n  \"skin_moves\": " + listAsJson(fit.skin_moves, [](const Move& move) {
            return fmt::format("{{\"place\": {}, \"by\": {}}}", asJson(move.place), asJson(move.by));
          });
  return text + "\n}\n";
}

BodyFit fitFromJson(std::string_view text, std::string_view file) { return FitReader(text, file).fit(); }

}  // namespace palpate::body
