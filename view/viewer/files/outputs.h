// What the viewer writes while it runs: forces, pictures, plots, the scene. Every success and failure becomes a
// message.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "palpate/view/cut_out.h"
#include "view/viewer/files/recorders.h"
#include "view/viewer/state/session.h"

namespace palpate::viewer {

/// A file that does not exist yet: "palpate.png", "palpate-2.png", ... in a folder that is made when it is first
/// needed; that it cannot be is told by the writing.
std::filesystem::path freshFile(const std::filesystem::path& folder, const std::string& stem, const std::string& kind);

class Outputs {
 public:
  explicit Outputs(const std::filesystem::path& folder)
      : folder_(std::filesystem::absolute(folder).lexically_normal()) {}
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Into the recording that runs, if any. A disk that is full or gone ends it, with what was recorded kept.
  void addSample(Session& session, const trace::Sample& sample);
  void toggleForces(Session& session);
  void toggleSequence(Session& session);
  void savePlots(Session& session);
  enum class Saving : std::uint8_t { done, asked, failed };
  /// To the request's file, else to where the scene came from, else to a fresh name in the folder. Asks before it
  /// writes over what this window has neither read nor written, unless the request is sure.
  Saving saveScene(Session& session, const SaveScene& request);
  /// Writes the drawn displacement profile to a file and has the scene use it.
  void useProfile(Session& session);
  void askForScreenshot(bool with_pop_ups = false) {
    screenshot_ = true;
    with_pop_ups_ = with_pop_ups;
  }
  /// The body alone, without a background.
  void askForClearPicture() { clear_picture_ = true; }
  /// It was asked for in this frame; once.
  bool takeClearPicture() { return std::exchange(clear_picture_, false); }
  /// The picture of this frame is kept, and pop-ups are no part of it. Pictures of a sequence never have them.
  bool wantsNoPopUps(const Session& session) const { return screenshot_ ? !with_pop_ups_ : session.recording.sequence; }
  /// The picture that was saved since the last call, or empty.
  std::filesystem::path takeSavedPicture() { return std::exchange(saved_picture_, {}); }
  void saveClearPicture(Session& session, const view::CutOut& picture);
  const std::filesystem::path& folder() const { return folder_; }

  /// A frame has been drawn; `read` fetches it when somebody wants it.
  template <class Read>
  void frameDrawn(Session& session, const Read& read) {
    if (screenshot_ || session.recording.sequence) keepFrame(session, read());
    tellErrors(session);
  }

  /// A changed scene that nobody could be asked about goes beside the one it came from, to a fresh name
  /// (scene-backup.toml): which, or empty when nothing was changed. Throws Error.
  std::filesystem::path keepChanges(const Session& session) const;

  /// Completes what is being recorded.
  void finish(Session& session);

 private:
  void endBrokenForces(Session& session, const std::string& why);
  void keepFrame(Session& session, view::Image image);
  void tellErrors(Session& session);

  std::filesystem::path folder_;
  ForceRecorder forces_;
  PictureWriter pictures_;
  std::filesystem::path saved_picture_;
  bool screenshot_ = false;
  bool with_pop_ups_ = false;
  bool clear_picture_ = false;
};

}  // namespace palpate::viewer
