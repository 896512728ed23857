#include "palpate/measure/synthesis/synthetic_files.h"

#include <fmt/format.h>

#include "palpate/base/text.h"

namespace palpate::measure {

namespace {

/// Numbers to a thousandth, without a zero that has a sign.
std::string number(double value) {
  const std::string text = fmt::format("{:.3f}", value);
  return text == "-0.000" ? "0.000" : text;
}
std::string pair(const Vec2& place) { return fmt::format("[{}, {}]", number(place.x()), number(place.y())); }
std::string triple(const Vec3& v) { return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z())); }

std::string ellipseJson(const KeyEllipse& ellipse) {
  return fmt::format(R"({{"half_major_mm": {}, "half_minor_mm": {}, "major_over_minor": {}, "direction_deg": {}}})",
                     number(ellipse.half_major_mm.value), number(ellipse.half_minor_mm.value),
                     number(ellipse.major_over_minor.value), number(ellipse.direction_deg.value));
}

std::string motionJson(const BodyMotion& motion) {
  return fmt::format(R"({{"shift_mm": {}, "turn_deg": {}, "scale_percent": {}}})", triple(motion.shift_mm),
                     triple(kDegPerRad * motion.turn_rad), number(100.0 * motion.scale));
}

std::string dotJson(const TrueDot& dot) {
  return fmt::format(
      R"({{"column": {}, "row": {}, "skin_mm": {}, "moved_mm": {}, "before_px": {}, "after_px": {}, "hidden": {}}})",
      dot.site.column, dot.site.row, pair(dot.skin_mm), pair(dot.moved_mm), pair(dot.before_px), pair(dot.after_px),
      dot.hidden());
}

std::string_view inkName(InkColour ink) {
  switch (ink) {
    case InkColour::red:
      return "red";
    case InkColour::blue:
      return "blue";
    case InkColour::green:
      break;
  }
  return "green";
}

}  // namespace

std::string_view nameOf(TailFamily family) {
  switch (family) {
    case TailFamily::compact:
      return "compact";
    case TailFamily::long_tail:
      return "long";
    case TailFamily::half_space:
      return "half-space";
    case TailFamily::windowed_half_space:
      return "windowed";
    case TailFamily::given:
      break;
  }
  return "given";
}

std::string truthJson(const SyntheticCase& made, const SyntheticTruth& truth) {
  std::string json = fmt::format("{{\n \"synthetic\": true,\n \"seed\": {},\n \"width_px\": {},\n \"height_px\": {},\n",
                                 made.seed, made.width_px, made.height_px);
  const auto say = [&](std::string_view key, const std::string& value) {
    json += fmt::format(" \"{}\": {},\n", key, value);
  };
  say("frame",
      "\"skin: arc length, x to the right, y towards the head, from the middle of the back; pictures: from the "
      "centre of the top left pixel, y down\"");
  say("tail", fmt::format("\"{}\"", nameOf(made.press.family)));
  say("tail_power", made.press.family == TailFamily::long_tail ? number(made.press.tail_power) : "null");
  say("ellipse_2_mm", ellipseJson(truth.at_2_mm));
  say("ellipse_4_mm", ellipseJson(truth.at_4_mm));
  say("contact_mm", pair(truth.field.contact_mm));
  say("contact_px", pair(truth.contact_px));
  say("tip_px", pair(truth.tip_px));
  say("peak_mm", pair(truth.field.peak_mm));
  say("drag_deg", number(truth.drag_deg));
  say("asymmetry", number(made.press.asymmetry));
  say("dent_mm", number(made.press.dent_mm));
  say("body_motion", motionJson(made.motion));
  say("body_motion_before2", motionJson(made.null_motion));
  say("camera",
      fmt::format(R"({{"distance_mm": {}, "tilt_deg": {}, "roll_deg": {}, "k1": {}, "px_per_mm": {}}})",
                  number(made.camera.distance_mm), number(kDegPerRad * made.camera.tilt_rad),
                  number(kDegPerRad * made.camera.roll_rad), number(made.camera.distortion), number(truth.px_per_mm)));
  say("marks",
      fmt::format(
          R"({{"ink": "{}", "spacing_mm": {}, "radius_mm": {}, "jitter_mm": {}, "columns": {}, "rows": {}, "missing": {}, "strays": {}}})",
          inkName(made.marks.ink), number(made.marks.spacing_mm), number(made.marks.radius_mm),
          number(made.marks.jitter_mm), made.marks.columns, made.marks.rows, made.marks.missing, made.marks.strays));
  json += " \"dots\": [";
  for (std::size_t i = 0; i < truth.dots.size(); ++i) json += (i == 0 ? "\n  " : ",\n  ") + dotJson(truth.dots[i]);
  return json + "\n ]\n}\n";
}

std::vector<std::filesystem::path> writeSynthetic(const std::filesystem::path& folder, const SyntheticCase& made,
                                                  const Progress& progress) {
  std::vector<std::filesystem::path> files;
  double done = 0.0;
  for (const Moment moment : {Moment::before, Moment::again, Moment::after}) {
    report(progress, "painting", done);
    done += 0.33;
    const Photograph picture = renderPicture(made, moment);
    files.push_back(folder / (picture.name + ".jpg"));
    writeJpeg(files.back(), picture, made.look.jpeg_quality);
  }
  files.push_back(folder / "truth.json");
  writeFile(files.back(), truthJson(made, computeTruth(made)));
  return files;
}

}  // namespace palpate::measure
