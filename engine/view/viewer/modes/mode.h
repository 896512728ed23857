// A use of the window other than pressing a body with the mouse: measuring photographs, training people. A program
// passes the modes of its window (ViewerSettings::modes); the viewer is complete without any.
//
//   InputEvent, Command, Request, answer ─► Modes ─ not handled ─► Viewer
//   Mode ─ Claims ─► Viewer: the parts of the window that the mode has taken
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/view/painter.h"
#include "palpate/window/gui.h"
#include "palpate/window/input.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/state/free_area.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/live_servo.h"
#include "view/viewer/world/world_swap.h"

namespace palpate::viewer {

/// The parts that a mode has taken for now.
struct Claims {
  bool window = false;  ///< menus, panels, hints, title and files: the viewer's own are unreachable
  bool body = false;    ///< the area where the body is drawn
  bool touch = false;   ///< the mouse presses and turns nothing
};

struct ModeMenuItem {
  window::Action action;
  bool on;
};

/// The view from between the eyes in this frame.
struct Sight {
  view::Frustum frustum;
  Vec2 size_points;
  double pixels_per_point;
  Pointer& pointer;
};

/// A mode's resources in a frame.
struct ModeWork {
  ViewerState& viewer;
  LiveServo& servo;
  WorldSwap& world_swap;
  const scene::World& world;
  double elapsed_s;
};

/// The functions in the order in which the viewer calls them; those that handle something return true if it needs no
/// further handling.
class Mode {
 public:
  Mode() = default;
  virtual ~Mode() = default;
  Mode(const Mode&) = delete;
  Mode& operator=(const Mode&) = delete;

  virtual Claims claims() const = 0;
  /// Once, before the first frame. Throws Error if the mode cannot work with this world.
  virtual void begin(ViewerState& /*viewer*/, const scene::World& /*world*/, window::Gui& /*gui*/) {}
  /// The servo has adopted a world.
  virtual void handleNewWorld(const scene::World& /*world*/) {}
  /// Every tick of every finger.
  virtual void feel(const trace::Sample& /*sample*/) {}
  /// The part of the body that the standard views show (default: all of it).
  virtual std::optional<Eigen::AlignedBox3d> homeBox() const { return std::nullopt; }
  virtual void look(const Sight& /*sight*/, const ViewerState& /*viewer*/) {}
  /// `typing`: a text field has the keyboard.
  virtual bool handle(const window::InputEvent& /*event*/, ViewerState& /*viewer*/, bool /*typing*/) { return false; }
  virtual bool handle(const window::Command& /*command*/, ViewerState& /*viewer*/) { return false; }
  virtual std::optional<ModeMenuItem> menuItem() const { return std::nullopt; }
  /// Draws the claimed part: the area of the body, or the whole window. Needs a Gui frame that has begun.
  virtual void draw(const FreeArea& /*area*/) {}
  virtual bool handle(const Request& /*request*/, ViewerState& /*viewer*/) { return false; }
  /// Returns true if the question was this mode's.
  virtual bool answer(const Question& /*question*/, std::string_view /*chosen*/, ViewerState& /*viewer*/) {
    return false;
  }
  /// Called before changes of the scene take effect.
  virtual void advance(const ModeWork& /*work*/) {}
  virtual bool wantsToQuit() const { return false; }
  virtual void adjust(view::PictureSettings& /*picture*/) const {}
  /// Lines over the body, drawn with the rings of the fingers.
  virtual std::vector<view::Lines> marks(const scene::World& /*world*/, const ViewerState& /*viewer*/) const {
    return {};
  }
  /// The run is over; the servo has stopped. Returns what could not be kept, or empty.
  virtual std::string finish(std::string_view /*ended_by*/) { return {}; }
};

/// All modes of a window; the first one goes first.
class Modes {
 public:
  explicit Modes(std::vector<std::unique_ptr<Mode>> modes) : modes_(std::move(modes)) {}
  auto begin() const { return modes_.begin(); }
  auto end() const { return modes_.end(); }

  Claims claims() const;
  /// The mode that has taken this part of the window, or null.
  Mode* claimant(bool Claims::*part) const;
  std::optional<Eigen::AlignedBox3d> homeBox() const;
  bool handle(const window::InputEvent& event, ViewerState& viewer, bool typing) const;
  bool handle(const window::Command& command, ViewerState& viewer) const;
  bool handle(const Request& request, ViewerState& viewer) const;
  void answer(const Question& question, std::string_view chosen, ViewerState& viewer) const;

 private:
  std::vector<std::unique_ptr<Mode>> modes_;
};

}  // namespace palpate::viewer
