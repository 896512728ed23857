// The preview of the file that is chosen in a dialog: made on a thread of its own, shown when ready.
#pragma once

#include <filesystem>
#include <optional>

#include "palpate/view/offscreen.h"
#include "view/viewer/files/file_preview.h"
#include "view/viewer/state/async_task.h"

namespace palpate::viewer {

/// Needs a current GL context, to whose thread it belongs.
class PreviewPane {
 public:
  /// Chooses the file of the preview; empty: none. The newest one is next as soon as the work before it is done.
  void choose(const std::filesystem::path& file);
  /// Draws it in the current window, as wide as there is room.
  void draw();
  const FilePreview* shown() const { return preview_ && of_ == chosen_ ? &*preview_ : nullptr; }

 private:
  void follow();

  std::filesystem::path chosen_;
  std::filesystem::path working_on_;
  std::filesystem::path of_;
  std::optional<FilePreview> preview_;
  std::optional<view::FlatPicture> picture_;
  AsyncTask<FilePreview> work_;
};

}  // namespace palpate::viewer
