#include "palpate/measure/synthesis/synthetic_stick.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/measure/synthesis/synthetic_skin.h"

namespace palpate::measure {

namespace {

constexpr int kShift = 4;  // fractions of a pixel in OpenCV's drawing
constexpr double kStickWidth = 15.0;

cv::Point fine(const Vec2& place) {
  return {static_cast<int>(std::lround(place.x() * (1 << kShift))),
          static_cast<int>(std::lround(place.y() * (1 << kShift)))};
}

/// The pen of this drawing: shapes in millimetres from the tip, along the stick and across it.
class Shapes {
 public:
  Shapes(cv::Mat& colour, cv::Mat& cover, const Vec2& tip, const Vec2& along, double px_per_mm)
      : colour_(colour), cover_(cover), tip_(tip), along_(along), scale_(px_per_mm) {}

  Vec2 at(const Vec2& mm) const { return tip_ + scale_ * (mm.x() * along_ + mm.y() * Vec2(-along_.y(), along_.x())); }
  void polygon(const std::vector<Vec2>& corners, const cv::Scalar& colour) {
    std::vector<cv::Point> points;
    for (const Vec2& corner : corners) points.push_back(fine(at(corner)));
    cv::fillConvexPoly(colour_, points, colour, cv::LINE_AA, kShift);
    cv::fillConvexPoly(cover_, points, cv::Scalar(255), cv::LINE_AA, kShift);
  }
  /// `angle`: of the longer axis against the stick.
  void oval(const Vec2& middle, const Vec2& half_axes, double angle, const cv::Scalar& colour) {
    const double turn = (std::atan2(along_.y(), along_.x()) + angle) * kDegPerRad;
    const cv::Size axes(static_cast<int>(half_axes.x() * scale_ * (1 << kShift)),
                        static_cast<int>(half_axes.y() * scale_ * (1 << kShift)));
    cv::ellipse(colour_, fine(at(middle)), axes, turn, 0.0, 360.0, colour, cv::FILLED, cv::LINE_AA, kShift);
    cv::ellipse(cover_, fine(at(middle)), axes, turn, 0.0, 360.0, cv::Scalar(255), cv::FILLED, cv::LINE_AA, kShift);
  }

 private:
  cv::Mat& colour_;
  cv::Mat& cover_;
  Vec2 tip_;
  Vec2 along_;
  double scale_;
};

cv::Scalar stored(const cv::Vec3f& light) {
  const auto root = [](float value) { return 255.0 * std::sqrt(std::clamp(static_cast<double>(value), 0.0, 1.0)); };
  return {root(light[0]), root(light[1]), root(light[2])};
}

void drawWood(Shapes& shapes, double length) {
  const cv::Scalar wood = stored({0.36f, 0.21f, 0.09f});
  const cv::Scalar bright = stored({0.48f, 0.30f, 0.14f});
  const double half = 0.5 * kStickWidth;
  shapes.oval({0.0, 0.0}, {half, half}, 0.0, wood);
  shapes.polygon({{0.0, -half}, {length, -half}, {length, half}, {0.0, half}}, wood);
  shapes.polygon({{0.0, -0.3 * half}, {length, -0.3 * half}, {length, 0.2 * half}, {0.0, 0.2 * half}}, bright);
}

void drawHand(Shapes& shapes, const SyntheticCase& made, double length) {
  // Not the skin of the back: another person holds the stick.
  const cv::Vec3f base = skinColour((made.skin.colour + 1) % 4);
  const cv::Scalar skin = stored(0.9f * base);
  const cv::Scalar dim = stored(0.72f * base);
  const double arm = made.press.arm_turn_rad;
  const Vec2 wrist(length + 62.0, 0.0);
  const Vec2 out = 500.0 * Vec2(std::cos(arm), std::sin(arm));
  const Vec2 side(-std::sin(arm), std::cos(arm));
  shapes.polygon({wrist - 27.0 * side, wrist + out - 42.0 * side, wrist + out + 42.0 * side, wrist + 27.0 * side}, dim);
  shapes.oval({length + 32.0, 4.0}, {46.0, 37.0}, arm, skin);
  shapes.oval({length - 4.0, 22.0}, {28.0, 9.0}, -0.35, dim);  // the thumb
  for (int finger = 0; finger < 4; ++finger) {
    shapes.oval({length + 2.0 + 15.0 * finger, -16.0}, {21.0, 8.0}, 1.25, finger % 2 == 0 ? dim : skin);
  }
}

/// Shadow is soft: a small picture is enough.
cv::Mat castShadow(const cv::Mat& cover, const Vec2& thrown_px, double soft_px) {
  const double small = std::min(1.0, 4.0 / soft_px);
  cv::Mat low;
  cv::resize(cover, low, {}, small, small, cv::INTER_AREA);
  const cv::Matx23d throwing(1.0, 0.0, thrown_px.x() * small, 0.0, 1.0, thrown_px.y() * small);
  cv::warpAffine(low, low, throwing, low.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::GaussianBlur(low, low, {}, soft_px * small);
  cv::Mat shadow;
  cv::resize(low, shadow, cover.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return shadow;
}

}  // namespace

StickPicture drawStick(const SyntheticCase& made, const Vec2& tip_px, const Vec2& away_px, double px_per_mm) {
  StickPicture picture;
  const cv::Size size(made.width_px, made.height_px);
  picture.cover = cv::Mat(size, CV_8U, cv::Scalar(0));
  picture.colour = cv::Mat(size, CV_8UC3, cv::Scalar(0, 0, 0));
  Shapes shapes(picture.colour, picture.cover, tip_px, away_px, px_per_mm);
  drawWood(shapes, made.press.stick_length_mm + 40.0);
  drawHand(shapes, made, made.press.stick_length_mm);
  // Colours are mixed into black at the rim of a shape; the cover is their weight.
  const Vec2 from_light = -Vec2(made.look.light.x(), -made.look.light.y()) / made.look.light.z();
  picture.shadow = castShadow(picture.cover, 28.0 * px_per_mm * from_light, 6.0 * px_per_mm);
  return picture;
}

}  // namespace palpate::measure
