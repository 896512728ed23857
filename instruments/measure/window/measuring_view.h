// Measuring a person in the window: two photographs, the marks in them, the results and the corrections by hand. Plain
// data and pure functions, without ImGui, files or threads.
//
//   mouse, keys, fields ─► MeasuringView ─ stale ─► MeasuringMode: measured on its own thread ─► taken by the view
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/overlay.h"
#include "palpate/window/keys.h"
#include "view/viewer/state/edit_history.h"

namespace palpate::viewer {

enum class Photo : std::uint8_t { before, after };
inline constexpr std::array<std::string_view, 2> kPhotoNames = {toTranslate("before"), toTranslate("after")};

/// Action of the left button on a photograph.
enum class MeasuringTool : std::uint8_t { look, contact, dots };
/// `numbers` is a tab only where the window is too narrow for a column next to the photographs.
enum class MeasuringTab : std::uint8_t { before, after, result, all, numbers };
/// Part that has to be measured again.
enum class Stale : std::uint8_t { nothing, marks, photographs };

struct ShownPhoto {
  std::string file = {};  ///< empty: none chosen
  int width_px = 0;       ///< photograph's own width; 0: not read
  int height_px = 0;
  std::vector<std::string> notes = {};
  std::uint32_t texture = 0;  ///< on the graphics card (view::GlId), perhaps smaller; 0: none
};

// Requests that only the mode can fulfil.

/// This photograph takes a place.
struct ShowPhoto {
  Photo place = Photo::before;
  std::string file = {};
};
struct SwapPhotos {};
struct AcceptMeasurement {
  bool sure = false;  ///< despite objections
};
/// Cancels the work under way.
struct CancelMeasuring {};
using MeasuringRequest = std::variant<ShowPhoto, SwapPhotos, AcceptMeasurement, CancelMeasuring>;
using MeasuringRequests = std::vector<MeasuringRequest>;

struct ChosenMark {
  Photo photo = Photo::before;
  std::size_t index = 0;
  bool operator==(const ChosenMark&) const = default;
};

/// State that undo restores.
struct Corrections {
  measure::DotPair marks = {};
  std::optional<Vec2> contact_px = {};
};

/// A left button that is down.
struct MarkDrag {
  Photo photo = Photo::before;
  Vec2 from_px = Vec2::Zero();
  std::optional<std::size_t> mark = {};  ///< the one pressed
  bool moved = false;
  bool selects = false;  ///< with Shift: the mark is neither moved nor removed
  Corrections before = {};
};

/// Destination of a result.
struct AcceptForm {
  std::string name = {};   ///< empty: that of the place
  std::string place = {};  ///< as an examiner writes it ("T6 left 40 mm"), or "x, y" in mm
  std::string table = {};  ///< a file of key points
  bool use_in_scene = true;
  // Place of the contact on the current body.
  std::optional<Vec2> at_mm = {};
  std::string place_name = {};   ///< "T6 left 40 mm"; empty: numbers were typed
  std::string place_words = {};  ///< with its numbers, or why it cannot be found
};
std::string acceptedName(const AcceptForm& form);

/// A photograph before and one after.
struct PhotoPair {
  std::string before;
  std::string after;
};
/// The first file that is called "before" somewhere, with the one of the same name but for "after" in its place.
std::optional<PhotoPair> pairAmong(std::span<const std::filesystem::path> files);

struct MeasuringView {
  bool open = false;
  std::optional<PhotoPair> pair_here = {};  ///< in the folder that the dialogs look at, when the view appeared
  std::array<ShownPhoto, 2> photos = {};
  measure::MeasureSettings settings = {};
  measure::DotPair marks = {};
  EditHistory<Corrections> history = {};
  std::optional<ChosenMark> selected = {};
  std::optional<ChosenMark> nudged = {};  ///< by the newest step
  std::optional<MarkDrag> drag = {};
  std::shared_ptr<const measure::Measurement> measured = nullptr;
  measure::Overlay overlay = {};
  std::string failure = {};  ///< why nothing could be measured
  bool corrected = false;    ///< the marks are not as they were found
  bool unsaved = false;      ///< corrected, and not accepted since
  Stale stale = Stale::nothing;

  // Work in progress.
  bool working = false;
  std::string stage = {};
  double done = 0.0;

  // View settings; all photographs alike.
  MeasuringTab tab = MeasuringTab::before;
  MeasuringTool tool = MeasuringTool::look;
  double zoom = 1.0;                  ///< 1: the whole photograph
  Vec2 middle = Vec2::Constant(0.5);  ///< middle of the visible part, in widths and heights
  std::optional<Photo> dialog = {};   ///< the one being chosen
  AcceptForm form = {};

  ShownPhoto& photo(Photo which) { return photos[static_cast<std::size_t>(which)]; }
  const ShownPhoto& photo(Photo which) const { return photos[static_cast<std::size_t>(which)]; }
  std::vector<measure::Dot>& photoMarks(Photo which) { return which == Photo::before ? marks.before : marks.after; }
  const std::vector<measure::Dot>& photoMarks(Photo which) const {
    return which == Photo::before ? marks.before : marks.after;
  }
  bool hasPair() const { return !photos[0].file.empty() && !photos[1].file.empty(); }
  /// Nothing is on its way that could change the result.
  bool settled() const { return stale == Stale::nothing && !working; }
};

inline constexpr double kMaxZoom = 40.0;
inline constexpr double kNudgePx = 1.0;
inline constexpr double kFineNudgePx = 0.2;

/// Another photograph takes the place of one: measurements and corrections are dropped.
void choosePhoto(MeasuringView& view, Photo which, std::string file);
/// Swaps the photographs of before and after.
void swapPhotos(MeasuringView& view);
/// Where a photograph belongs that was only named: the first place that is free, else the one after.
Photo freePlace(const MeasuringView& view);
/// Decides by the name: JPEG, PNG or TIFF.
bool isPhotograph(std::string_view file);

/// Every mark that the photographs' measurement found.
measure::DotPair photoMarks(const measure::Measurement& measured);
/// A result and its overlay. With `of_photographs` the marks are those that were found.
void acceptMeasurement(MeasuringView& view, std::shared_ptr<const measure::Measurement> measured,
                       measure::Overlay overlay, bool of_photographs);

/// The nearest mark within `reach_px` of the photograph.
std::optional<std::size_t> markAt(const MeasuringView& view, Photo which, const Vec2& at_px, double reach_px);

/// Marks cannot be corrected on the result, so it is left for them.
void useTool(MeasuringView& view, MeasuringTool tool);

// The left button on a photograph, by the tool: down, moved while down, up.
void pressPhoto(MeasuringView& view, Photo which, const Vec2& at_px, double reach_px, bool shift);
void dragPhoto(MeasuringView& view, const Vec2& at_px, double slack_px);
void releasePhoto(MeasuringView& view);

void removeSelected(MeasuringView& view);
void nudgeSelected(MeasuringView& view, const Vec2& by_px);
void setContact(MeasuringView& view, const std::optional<Vec2>& at_px);

/// Undoes a correction and describes it; empty: nothing to undo.
std::string undoCorrection(MeasuringView& view);
std::string redoCorrection(MeasuringView& view);

/// A field of the settings was changed.
void settingsChanged(MeasuringView& view);

/// Zooms so that the place under the cursor, in widths and heights of the photograph, stays where it is.
void zoomAbout(MeasuringView& view, const Vec2& place, double factor);
void panBy(MeasuringView& view, const Vec2& by);

/// Handles a key while the view is open. False: the key has its usual meaning.
bool measuringKey(MeasuringView& view, window::Key key, const window::Modifiers& modifiers,
                  MeasuringRequests& requests);

/// Why the result cannot be accepted; empty: it can. A refusal by the measuring does not count: the user is asked.
std::string obstacleToAccept(const MeasuringView& view);

}  // namespace palpate::viewer
