#include "view/viewer/frame_painter.h"

#include <algorithm>
#include <utility>

#include "palpate/base/stopwatch.h"
#include "view/viewer/editing/rings.h"
#include "view/viewer/state/free_area.h"
#include "view/viewer/state/home_view.h"

namespace palpate::viewer {

namespace {

/// Width for the finger that stays where it was put, points.
constexpr double kOutline = 1.5;
/// A script's finger without a size is drawn as a fingertip.
constexpr double kDrawnPointMm = 8.0;
/// For a picture without background: each pixel is the mean of this many squared.
constexpr int kClearSupersampling = 2;

/// A finger that moves less in a frame is at rest.
constexpr double kSeenMm = 0.05;

bool sameView(const view::Camera& a, const view::Camera& b) {
  return a.centre == b.centre && a.yaw_rad == b.yaw_rad && a.pitch_rad == b.pitch_rad && a.roll_rad == b.roll_rad &&
         a.distance_mm == b.distance_mm && a.height_rad == b.height_rad;
}

bool isOffBody(const contact::FingerOutput& finger) { return finger.tip.z() > 0.5 * device::kNowhere.z(); }

std::vector<view::FingerMark> marksBeside(const FrameParts& frame) {
  std::vector<view::FingerMark> marks;
  const TouchHistory::Moment& moment = frame.replay.momentBeside(frame.viewer.replay);
  const std::vector<double>& radius_mm = frame.replay.beside()->touch.radius_mm;
  for (std::size_t i = 0; i < std::min(kFingers, radius_mm.size()); ++i) {
    if (isOffBody(moment[i].contact)) continue;
    const double radius = radius_mm[i];
    marks.push_back({.contact = moment[i].contact,
                     .radius_mm = radius <= 0.0 ? kDrawnPointMm : radius,
                     .colour = i == 0 ? view::kLeftFinger : view::kRightFinger,
                     .haptic_radius_mm = radius,
                     .left = i == 0});
  }
  return marks;
}

/// The twelve edges of the workspace of each device that holds a finger, where the clutch has moved it.
void addReach(const DevicesShown& devices, std::vector<view::Lines>& lines) {
  constexpr double kReachPx = 1.6;
  for (std::size_t i = 0; i < kFingers; ++i) {
    const FingerHeld& held = devices.fingers[i];
    device::DeviceFrame frame = held.workspace.frame;
    frame.origin_mm += held.reading.shift_mm;
    const std::vector<Vec3> corners = device::reachOf(held.able, frame);
    view::Lines edges{kReachPx, {}};
    for (std::size_t from = 0; from < corners.size(); ++from) {
      for (const std::size_t axis : {1u, 2u, 4u}) {
        if ((from & axis) == 0) edges.add(corners[from], corners[from | axis], kFingerPaint[i]);
      }
    }
    if (!corners.empty()) lines.push_back(std::move(edges));
  }
}

/// Empty while the past is shown: rings mark the present fingers.
std::vector<view::Lines> rings(const FrameParts& frame) {
  ViewerState& viewer = frame.viewer;
  const BodyView& seen = viewer;
  const std::optional<SkinPlace>& under = frame.pointer.placeOf(seen.active_finger);
  if (seen.ruler.active) return rulerLines(seen.ruler);
  if (viewer.editor.active) return dysfunctionRings(viewer.dysfunctions(viewer.output), under, frame.world);
  if (viewer.lump_editor.active) return lumpRings(viewer.lumps(viewer.output), under, frame.world);
  std::vector<view::Lines> marks;
  if (!viewer.replay.frozen) marks = fingerRings(seen, viewer.scene, frame.pointer);
  if (seen.reading && seen.vertex_panel_open && seen.mark_vertex) {
    marks.push_back(vertexMark(*seen.reading, frame.world, frame.model.surface()));
  }
  if (seen.state.shown.reach) addReach(viewer.devices, marks);
  for (const auto& mode : frame.modes) {
    for (view::Lines& lines : mode->marks(frame.world, viewer)) marks.push_back(std::move(lines));
  }
  return marks;
}

view::Canvas canvasOn(const view::Target& target, double pixels_per_point) {
  return {.framebuffer = target.framebuffer(),
          .width = target.width(),
          .height = target.height(),
          .pixels_per_point = pixels_per_point};
}

}  // namespace

bool drawsItself(const view::StereoSettings& stereo, bool quad_buffer) {
  return quad_buffer && stereo.mode == view::StereoMode::quad_buffer;
}

view::PictureSettings FramePainter::pictureSettings(const FrameParts& frame) const {
  const BodyView& seen = frame.viewer;
  view::PictureSettings picture;
  picture.camera = seen.camera;
  picture.look = seen.state.look;
  picture.look.finger = finger_shape_;
  if (seen.simple_shading) picture.look.shading = view::Shading::gouraud;
  picture.look.light_background = seen.state.theme == window::Theme::light;
  picture.stereo = frame.stereo;
  picture.labels.numbers = seen.state.shown.numbers;
  for (const auto& mode : frame.modes) mode->adjust(picture);
  return picture;
}

/// Whether a finger touches or moves, or the view turns.
bool FramePainter::inMotion(const FrameParts& frame) {
  const BodyView& seen = frame.viewer;
  bool moves = !sameView(seen.camera, std::exchange(seen_from_, seen.camera));
  for (std::size_t i = 0; i < kFingers; ++i) {
    const contact::FingerOutput& finger = seen.fingers[i];
    moves = moves || finger.touch != contact::Touch::free || frame.pointer.pressed(i);
    moves = moves || (finger.tip - tips_[i]).norm() > kSeenMm;
    tips_[i] = finger.tip;
  }
  return moves;
}

/// Once a frame. Two recordings next to each other look alike.
void FramePainter::chooseEffort(const FrameParts& frame) {
  ViewerState& viewer = frame.viewer;
  const double elapsed_s = viewer.now_s - painted_s_.value_or(viewer.now_s);
  painted_s_ = viewer.now_s;
  const bool adapts = viewer.state.adapts_resolution && frame.stereo.mode == view::StereoMode::mono;
  if (!adapts) scale_.reset();
  const bool moves = inMotion(frame);
  const bool counts = elapsed_s > 0.0 && !viewer.building && !frame.kept;
  if (adapts && counts && moves && std::exchange(moved_, moves)) scale_.frame(elapsed_s);
  moved_ = moves && !frame.kept;
  viewer.performance.picture_share = adapts && moves && !frame.kept ? scale_.share() : 1.0;
  const bool hand_counts = elapsed_s > 0.0 && !viewer.building && !viewer.recording.sequence;
  finger_shape_ = fingerShapeNow(finger_form_, viewer, elapsed_s, hand_counts);
}

std::vector<view::FingerMark> FramePainter::fingerMarks(const FrameParts& frame) {
  const ViewerState& viewer = frame.viewer;
  const RecordedTouch* recorded = frame.replay.recorded();
  std::vector<view::FingerMark> marks;
  for (std::size_t i = 0; i < kFingers; ++i) {
    peaks_[i].follow(viewer.fingers[i], viewer.now_s);
    if (!viewer.finger_present[i] || isOffBody(viewer.fingers[i])) continue;
    const bool has_radius = recorded != nullptr && i < recorded->radius_mm.size();
    const double radius = has_radius ? recorded->radius_mm[i] : fingerRadius(viewer.scene, i);
    const bool left = i == 0;
    marks.push_back({.contact = viewer.fingers[i],
                     .radius_mm = radius <= 0.0 ? kDrawnPointMm : radius,
                     .colour = left ? view::kLeftFinger : view::kRightFinger,
                     .haptic_radius_mm = radius,
                     .left = left,
                     .outline = i == viewer.active_finger ? 0.0 : kOutline,
                     .lifted = peaks_[i].shown(viewer.now_s),
                     .pad = view::fingerPad(viewer.scene, i)});
  }
  return marks;
}

void FramePainter::paint(const FrameParts& frame, window::Gui::Choice windows) {
  chooseEffort(frame);
  if (frame.modes.claims().body && frame.stereo.mode == view::StereoMode::mono) {
    frame.target.clear();
    frame.target.bind();
    return frame.gui.present(frame.target.width(), frame.target.height(), windows);
  }
  const bool itself = drawsItself(frame.stereo, frame.quad_buffer);
  if (frame.replay.beside() != nullptr && !itself) return paintBeside(frame, windows);
  const Clock::time_point started = Clock::now();
  ViewerState& viewer = frame.viewer;
  view::Canvas canvas = canvasOn(frame.target, frame.pixels_per_point);
  if (itself) canvas.framebuffer = 0;
  canvas.quad_buffer = frame.quad_buffer;
  canvas.body_share = viewer.performance.picture_share;
  const auto width = static_cast<float>(viewer.size_points.x());
  const auto height = static_cast<float>(viewer.size_points.y());
  const FreeArea free = freeArea(viewer.state.shown, width, height);
  canvas.covered = {free.left, free.top, width - free.right, height - free.below};
  const auto over = [&](const view::EyePicture& eye) { frame.gui.present(eye.width, eye.height, windows); };
  const std::vector<view::FingerMark> fingers = fingerMarks(frame);
  const std::vector<view::Lines> shown_rings = rings(frame);
  frame.model.painter().paint(
      {.fingers = fingers, .time_s = viewer.now_s, .lift_mm = frame.model.lift(), .marks = shown_rings},
      frame.model.surface(), pictureSettings(frame), canvas, over);
  viewer.performance.draw_ms = millisecondsSince(started);
}

/// Each in a half of the area that the panels leave free.
void FramePainter::paintBeside(const FrameParts& frame, window::Gui::Choice windows) {
  const BodyView& seen = frame.viewer;
  const auto shown_width = static_cast<float>(seen.size_points.x());
  const FreeArea free = freeArea(seen.state.shown, shown_width, static_cast<float>(seen.size_points.y()));
  const auto pixels = [&](float points) {
    return static_cast<int>(frame.pixels_per_point * static_cast<double>(points));
  };
  const int width = std::max(1, pixels(0.5f * (free.right - free.left)) - 1);  // a line between them
  const int height = std::max(1, pixels(free.below - free.top));
  if (!half_ || half_->width() != width || half_->height() != height) {
    half_ = std::make_unique<view::Target>(width, height);
  }
  frame.target.clear();
  const int below = frame.target.height() - pixels(free.top) - height;
  paintHalf(frame, frame.model, fingerMarks(frame));
  frame.target.put(*half_, pixels(free.left), below);
  paintHalf(frame, frame.replay.beside()->model, marksBeside(frame));
  frame.target.put(*half_, pixels(free.right) - width, below);
  frame.target.bind();
  frame.gui.present(frame.target.width(), frame.target.height(), windows);
}

/// One of two bodies, by one eye, in the middle of its half and so far away that a square fits.
void FramePainter::paintHalf(const FrameParts& frame, LiveModel& model, std::span<const view::FingerMark> fingers) {
  view::PictureSettings picture = pictureSettings(frame);
  picture.stereo.mode = view::StereoMode::mono;
  picture.camera = cameraOfFreePart(picture.camera, frame.viewer.state.shown, frame.viewer.size_points);
  picture.camera.distance_mm *= std::max(1.0, static_cast<double>(half_->height()) / half_->width());
  model.painter().paint({.fingers = fingers, .time_s = frame.viewer.now_s, .lift_mm = model.lift()}, model.surface(),
                        picture, canvasOn(*half_, frame.pixels_per_point));
}

/// Drawn on white and on black.
view::CutOut FramePainter::paintClear(const FrameParts& frame) {
  view::PictureSettings picture = pictureSettings(frame);
  picture.look.shading = frame.viewer.state.look.shading;
  picture.stereo.mode = view::StereoMode::mono;
  picture.labels = view::LabelSettings::none();
  const std::vector<view::FingerMark> fingers = fingerMarks(frame);
  const auto drawn = [&](double background) {
    picture.look.plain_background = background;
    view::Target target(kClearSupersampling * frame.target.width(), kClearSupersampling * frame.target.height());
    view::Canvas canvas = canvasOn(target, kClearSupersampling * frame.pixels_per_point);
    canvas.supersampling = kClearSupersampling;
    frame.model.painter().paint({.fingers = fingers, .time_s = frame.viewer.now_s, .lift_mm = frame.model.lift()},
                                frame.model.surface(), picture, canvas);
    return view::reduced(target.read(), kClearSupersampling);
  };
  return view::cutOut(drawn(1.0), drawn(0.0));
}

}  // namespace palpate::viewer
