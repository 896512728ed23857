#include "palpate/measure/synthesis/synthetic_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "palpate/base/random.h"
#include "palpate/measure/synthesis/synthetic_camera.h"
#include "palpate/measure/synthesis/synthetic_mesh.h"
#include "palpate/measure/synthesis/synthetic_skin.h"
#include "palpate/measure/synthesis/synthetic_stick.h"

namespace palpate::measure {

namespace {

/// 65536 values of a normal distribution: a picture needs millions.
const std::vector<float>& normals() {
  static const std::vector<float> table = [] {
    std::vector<float> values(65536);
    Random random(20061);
    for (float& value : values) value = static_cast<float>(random.normal());
    return values;
  }();
  return table;
}

/// Light to screen values, by a table: 16 bits of a channel from 12 bits of light.
std::uint16_t encodeSrgb16(float light) {
  static const std::vector<std::uint16_t> table = [] {
    std::vector<std::uint16_t> values(4097);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = static_cast<double>(i) / 4096.0;
      const double shown = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
      values[i] = static_cast<std::uint16_t>(std::lround(shown * 65280.0));  // 255 * 256
    }
    return values;
  }();
  // Dark tones need more than 12 bits: between two entries.
  const float place = std::clamp(light, 0.0f, 0.9999f) * 4096.0f;
  const auto i = static_cast<std::size_t>(place);
  const float part = place - static_cast<float>(i);
  return static_cast<std::uint16_t>((1.0f - part) * table[i] + part * table[i + 1]);
}

/// Data shared by all pictures of a case.
struct Stage {
  explicit Stage(const SyntheticCase& wanted)
      : made(wanted), body(wanted.back), field(wanted.press), marks(makeInkMarks(wanted.marks)) {
    constexpr double kTexelsPerPixel = 1.3;
    const double scale = SyntheticCamera(made, body, false).pixelsPerMm();
    skin = paintSkin(made, marks, std::clamp(kTexelsPerPixel * scale, 3.0, 9.0));
  }
  const SyntheticCase& made;
  SyntheticBody body;
  TrueField field;
  InkMarks marks;
  SkinTexture skin;
};

Vec2 contactPixel(const SyntheticCase& made, const SyntheticBody& body, const TrueField& field,
                  const SyntheticCamera& camera) {
  return camera.project(movedBody(body.pressedAt(made.press.contact_mm, field), made.motion));
}

StickPicture drawPressStick(const SyntheticCase& made, const SyntheticBody& body, const TrueField& field,
                            const SyntheticCamera& camera) {
  if (!made.press.stick) return {};
  const Vec2 tip = contactPixel(made, body, field, camera);
  const double angle = made.press.drag_rad + std::numbers::pi + made.press.stick_turn_rad;
  const Vec2 behind = made.press.contact_mm + field.displacementAt(made.press.contact_mm) +
                      10.0 * Vec2(std::cos(angle), std::sin(angle));
  const Vec2 seen =
      camera.project(movedBody(body.placeAt(behind), made.motion)) -
      camera.project(movedBody(body.placeAt(behind - 10.0 * Vec2(std::cos(angle), std::sin(angle))), made.motion));
  return drawStick(made, tip, seen.normalized(), camera.pixelsPerMm());
}

/// A cloth under the body.
cv::Mat paintCloth(const SyntheticCase& made) {
  Random random(made.look.seed ^ 0x9d39247e33776d41ull);
  cv::Mat_<cv::Vec3f> cloth(made.height_px / 40 + 4, made.width_px / 40 + 4);
  const auto blue = static_cast<float>(random.uniform(0.24, 0.38));
  const auto green = static_cast<float>(random.uniform(0.25, 0.38));
  const cv::Vec3f base(static_cast<float>(random.uniform(0.22, 0.36)), green, blue);
  for (cv::Vec3f& value : cloth) value = static_cast<float>(random.uniform(0.75, 1.15)) * base;
  return cloth;
}

/// One band of rows after the other, so that a large picture needs little memory.
class Painter {
 public:
  Painter(const Stage& stage, const SyntheticCamera& camera, const StickPicture& stick)
      : stage_(stage), stick_(stick), cloth_(paintCloth(stage.made)), scale_(camera.pixelsPerMm()) {}

  cv::Mat paint(const SyntheticMesh& mesh) {
    const SyntheticCase& made = stage_.made;
    cv::Mat picture(made.height_px, made.width_px, CV_16UC3);
    constexpr int kBand = 192;
    for (int first = 0; first < picture.rows; first += kBand) {
      const int rows = std::min(kBand, picture.rows - first);
      seen_.place.create(rows, picture.cols, CV_32FC2);
      seen_.light.create(rows, picture.cols, CV_32FC2);
      seen_.depth.create(rows, picture.cols, CV_32F);
      mesh.paint(first, seen_);
      look();
      for (int row = 0; row < rows; ++row) paintRow(first + row, row, picture.ptr<cv::Vec3w>(first + row));
    }
    return picture;
  }

 private:
  /// The painted skin at the places that are seen.
  void look() {
    cv::Mat texels(seen_.place.size(), CV_32FC2);
    for (int y = 0; y < texels.rows; ++y) {
      const auto* place = seen_.place.ptr<cv::Vec2f>(y);
      auto* texel = texels.ptr<cv::Vec2f>(y);
      for (int x = 0; x < texels.cols; ++x) {
        const cv::Point2f at = stage_.skin.toTexel({place[x][0], place[x][1]});
        texel[x] = {at.x, at.y};
      }
    }
    cv::remap(stage_.skin.albedo, albedo_, texels, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }

  cv::Vec3f clothAt(int x, int y) const {
    const float column =
        static_cast<float>(x) * static_cast<float>(cloth_.cols - 2) / static_cast<float>(stage_.made.width_px);
    const float row =
        static_cast<float>(y) * static_cast<float>(cloth_.rows - 2) / static_cast<float>(stage_.made.height_px);
    const int i = static_cast<int>(column);
    const int j = static_cast<int>(row);
    const float right = column - static_cast<float>(i);
    const float down = row - static_cast<float>(j);
    const auto* above = cloth_.ptr<cv::Vec3f>(j) + i;
    const auto* below = cloth_.ptr<cv::Vec3f>(j + 1) + i;
    return (1.0f - down) * ((1.0f - right) * above[0] + right * above[1]) +
           down * ((1.0f - right) * below[0] + right * below[1]);
  }

  void paintRow(int y, int row, cv::Vec3w* shown) const {
    const PictureLook& look = stage_.made.look;
    const auto* depth = seen_.depth.ptr<float>(row);
    const auto* lit = seen_.light.ptr<cv::Vec2f>(row);
    const auto* albedo = albedo_.ptr<cv::Vec3w>(row);
    const auto* cover = stick_.cover.empty() ? nullptr : stick_.cover.ptr<std::uint8_t>(y);
    const auto* shadow = stick_.cover.empty() ? nullptr : stick_.shadow.ptr<std::uint8_t>(y);
    const auto* front = stick_.cover.empty() ? nullptr : stick_.colour.ptr<cv::Vec3b>(y);
    const auto ambient = static_cast<float>(look.ambient);
    const auto sheen = static_cast<float>(look.sheen);
    const float middle_x = 0.5f * static_cast<float>(stage_.made.width_px);
    const float from_middle =
        static_cast<float>(y) / middle_x - static_cast<float>(stage_.made.height_px) / (2.0f * middle_x);
    for (int x = 0; x < stage_.made.width_px; ++x) {
      const float open = shadow != nullptr ? 1.0f - 0.55f * static_cast<float>(shadow[x]) / 255.0f : 1.0f;
      cv::Vec3f light;
      if (depth[x] < std::numeric_limits<float>::max()) {
        const float shade = ambient + (1.0f - ambient) * 1.25f * lit[x][0] * open;
        light = shade / 65535.0f * cv::Vec3f(albedo[x][0], albedo[x][1], albedo[x][2]) +
                cv::Vec3f::all(sheen * lit[x][1] * open);
      } else {
        light = clothAt(x, y) * (0.5f + 0.5f * open);
      }
      if (cover != nullptr && cover[x] > 0) {
        const float part = static_cast<float>(cover[x]) / 255.0f;
        const auto square = [](std::uint8_t value) { return static_cast<float>(value * value) / 65025.0f; };
        light = (1.0f - part) * light + cv::Vec3f(square(front[x][0]), square(front[x][1]), square(front[x][2]));
      }
      const float across = static_cast<float>(x) / middle_x - 1.0f;
      const float corner = (across * across + from_middle * from_middle) / 2.8f;  // about 1 in the corner
      const float kept = static_cast<float>(look.exposure) * (1.0f - static_cast<float>(look.vignette) * corner);
      for (int channel = 0; channel < 3; ++channel) {
        shown[x][channel] = encodeSrgb16(kept * static_cast<float>(look.balance[channel]) * light[channel]);
      }
    }
  }

  const Stage& stage_;
  const StickPicture& stick_;
  cv::Mat cloth_;
  SeenSkin seen_;
  cv::Mat albedo_;
  double scale_;
};

/// Blur of the lens, then noise of the sensor, to 8 bits.
Photograph developed(const cv::Mat& picture, const PictureLook& look, Moment moment) {
  cv::Mat soft = picture;
  if (look.blur_px > 0.0) cv::GaussianBlur(picture, soft, {}, look.blur_px);
  Photograph photograph;
  photograph.width_px = picture.cols;
  photograph.height_px = picture.rows;
  photograph.rgb.resize(3 * static_cast<std::size_t>(picture.cols) * static_cast<std::size_t>(picture.rows));
  Random random(look.seed + 77 * (1 + static_cast<std::uint64_t>(moment)));
  const std::vector<float>& normal = normals();
  const auto strength = static_cast<float>(look.noise);
  std::uint8_t* out = photograph.rgb.data();
  for (int y = 0; y < soft.rows; ++y) {
    const auto* row = soft.ptr<cv::Vec3w>(y);
    for (int x = 0; x < soft.cols; ++x) {
      std::uint64_t bits = random.bits();
      std::array<float, 3> value{};
      for (std::size_t channel = 0; channel < 3; ++channel, bits >>= 16) {
        value[channel] = row[x][static_cast<int>(channel)] / 256.0f + strength * normal[bits & 0xffff];
      }
      if (look.grey) value.fill(0.3f * value[0] + 0.59f * value[1] + 0.11f * value[2]);
      for (const float channel : value) *out++ = static_cast<std::uint8_t>(std::clamp(channel + 0.5f, 0.0f, 255.0f));
    }
  }
  return photograph;
}

Photograph render(const Stage& stage, Moment moment) {
  const SyntheticCase& made = stage.made;
  const bool after = moment == Moment::after;
  const SyntheticCamera camera(made, stage.body, after);
  const StickPicture stick = after ? drawPressStick(made, stage.body, stage.field, camera) : StickPicture{};
  const BodyMotion motion = after ? made.motion : moment == Moment::again ? made.null_motion : BodyMotion{};
  const SyntheticMesh mesh(made, stage.body, camera, after ? &stage.field : nullptr, motion);
  Photograph photograph = developed(Painter(stage, camera, stick).paint(mesh), made.look, moment);
  photograph.name = after ? "after" : moment == Moment::again ? "before2" : "before";
  // Times of one session: the first pictures, then the press two seconds later.
  constexpr double kNoon = 1.7672e9;
  photograph.taken_at_s = kNoon + (after ? 6.0 : moment == Moment::again ? 3.0 : 0.0);
  return photograph;
}

/// Share of a mark under stick or hand.
double coveredShare(const cv::Mat& cover, const Vec2& middle_px, double radius_px) {
  if (cover.empty()) return 0.0;
  double sum = 0.0;
  int count = 0;
  for (int ring = 0; ring <= 3; ++ring) {
    for (int step = 0; step < std::max(1, 6 * ring); ++step, ++count) {
      const double angle = 2.0 * std::numbers::pi * step / std::max(1, 6 * ring);
      const Vec2 place = middle_px + radius_px * (ring / 3.0) * Vec2(std::cos(angle), std::sin(angle));
      const int x = static_cast<int>(std::lround(place.x()));
      const int y = static_cast<int>(std::lround(place.y()));
      if (x >= 0 && y >= 0 && x < cover.cols && y < cover.rows) sum += cover.at<std::uint8_t>(y, x) / 255.0;
    }
  }
  return sum / count;
}

}  // namespace

SyntheticTruth computeTruth(const SyntheticCase& made) {
  const SyntheticBody body(made.back);
  const TrueField field(made.press);
  const SyntheticCamera before(made, body, false);
  const SyntheticCamera after(made, body, true);
  const StickPicture stick = drawPressStick(made, body, field, after);
  const InkMarks marks = makeInkMarks(made.marks);
  SyntheticTruth truth;
  for (const InkMark& mark : marks.dots) {
    TrueDot dot;
    dot.site = mark.site;
    dot.skin_mm = mark.skin_mm;
    dot.moved_mm = field.displacementAt(mark.skin_mm);
    dot.before_px = before.project(body.placeAt(mark.skin_mm));
    dot.after_px = after.project(movedBody(body.pressedAt(mark.skin_mm, field), made.motion));
    dot.covered = coveredShare(stick.cover, dot.after_px, mark.radius_mm * after.pixelsPerMm());
    truth.dots.push_back(dot);
  }
  for (const InkMark& mark : marks.strays) truth.strays_px.push_back(before.project(body.placeAt(mark.skin_mm)));
  truth.field = field.formula();
  truth.at_2_mm = field.ellipseAt(2.0);
  truth.at_4_mm = field.ellipseAt(4.0);
  truth.drag_deg = made.press.drag_rad * kDegPerRad;
  truth.contact_px = before.project(body.placeAt(made.press.contact_mm));
  truth.tip_px = contactPixel(made, body, field, after);
  truth.px_per_mm = before.pixelsPerMm();
  return truth;
}

Photograph renderPicture(const SyntheticCase& made, Moment moment) { return render(Stage(made), moment); }

std::vector<std::uint8_t> jpegBytes(const Photograph& picture, int quality) {
  const cv::Mat rgb(picture.height_px, picture.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));  // NOLINT: only read
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

Photograph throughJpeg(const Photograph& picture, int quality) {
  Photograph decoded = picture;
  const cv::Mat bgr = cv::imdecode(jpegBytes(picture, quality), cv::IMREAD_COLOR);
  cv::Mat rgb(picture.height_px, picture.width_px, CV_8UC3, decoded.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return decoded;
}

SyntheticPair renderPair(const SyntheticCase& made) {
  const Stage stage(made);
  return {throughJpeg(render(stage, Moment::before), made.look.jpeg_quality),
          throughJpeg(render(stage, Moment::after), made.look.jpeg_quality), computeTruth(made)};
}

OneThread::OneThread() : before_(cv::getNumThreads()) { cv::setNumThreads(1); }
OneThread::~OneThread() { cv::setNumThreads(before_); }

}  // namespace palpate::measure
