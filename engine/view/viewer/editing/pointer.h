// Moves the mouse fingers and the camera: commands of the input rules, applied to a camera and two finger targets.
// Pure; it picks on the surface of the skin at rest.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/view/orbit.h"
#include "palpate/window/input.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

/// The screen the cursor moves on: pixels, and the eye to pick with.
struct PickScreen {
  view::Screen screen;
  Vec3 eye = Vec3::Zero();
  Vec2 size = Vec2(1, 1);  ///< pixels
  view::StereoMode stereo = view::StereoMode::mono;
};

class Pointer {
 public:
  /// Pixels to a ray through the scene; the cursor in a half of a stereo picture is folded back.
  view::Ray rayAt(const Vec2& pixel) const;
  std::optional<SkinPlace> skinAt(const Vec2& pixel) const;

  /// The current view; once a frame.
  void look(const PickScreen& screen, std::shared_ptr<const scene::World> world);
  /// Resets for another body: no finger is on it yet.
  void reset();

  /// Returns true if the command was about a finger or the camera, and then it is done; false for actions and the
  /// editor's.
  bool apply(const window::Command& command, BodyView& seen, double now_s);
  /// A ring step of the keyboard.
  bool step(window::Action action, bool fine, const BodyView& seen);
  /// Presses without a user: the first seconds' demonstration.
  void demonstrate(std::size_t finger, const SkinPlace& place, bool pressed);
  /// Puts a finger at a named place: it waits there, whatever is under the mouse, until that really moves.
  void put(std::size_t finger, const SkinPlace& place);

  /// The target for the servo. Depth, force and radius come from the settings.
  device::FingerTarget target(std::size_t finger, const BodyView& seen, const scene::Scene& scene) const;
  const std::optional<SkinPlace>& placeOf(std::size_t finger) const { return fingers_[finger].place; }
  /// Whether it waits, or presses, where it was put, until the mouse leads it elsewhere.
  bool isAtNamedPlace(std::size_t finger) const { return fingers_[finger].named; }
  bool pressed(std::size_t finger) const { return fingers_[finger].pressed; }
  /// Once a frame, after all targets were sent: a tap that began and ended within the frame has been felt.
  void targetsSent();
  /// Sends the camera to another view; immediately with reduced motion.
  void fly(const view::Camera& to, const BodyView& seen, double now_s, double seconds);
  /// Once a frame: advances the camera's flight.
  void advance(BodyView& seen, double now_s);

 private:
  struct Finger {
    std::optional<SkinPlace> place;
    /// Set when its place was named or stepped to by keys, with the mouse here. Empty: it follows the mouse.
    std::optional<Vec2> mouse_at_rest;
    bool named = false;
    bool pressed = false;
    bool fresh = false;   ///< pressed in this frame: not sent as a target yet
    bool tapped = false;  ///< and lifted in it: pressed until the next frame
    double depth_mm = 6.0;
    double force_n = 3.0;
  };

  bool applyToFinger(const window::Command& command, BodyView& seen);
  bool applyToCamera(const window::Command& command, BodyView& seen, double now_s);
  void moveFinger(std::size_t finger, const Vec2& pixel);
  void hover(std::size_t finger, const Vec2& pixel);
  static void press(Finger& finger);
  void rest(Finger& finger, const SkinPlace& place);
  static void deepen(TouchSettings& touch, double notches);
  Vec3 pivotAt(const Vec2& pixel, const view::Camera& camera) const;

  PickScreen screen_;
  std::shared_ptr<const scene::World> world_;
  std::array<Finger, kFingers> fingers_;
  Vec2 mouse_ = Vec2::Zero();  ///< pixels
  Vec3 pivot_ = Vec3::Zero();
  struct Flight {
    view::Camera from, to;
    double start_s, seconds;
  };
  std::optional<Flight> flight_;
};

}  // namespace palpate::viewer
