#include "view/viewer/panels/preview_pane.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

void PreviewPane::choose(const std::filesystem::path& file) { chosen_ = file; }

void PreviewPane::follow() {
  if (auto result = work_.collectResult()) {
    of_ = working_on_;
    preview_ = result->value ? std::move(*result->value) : FilePreview{result->error, {}, {}};
    picture_.reset();
    if (preview_->picture) picture_.emplace(*preview_->picture);
  }
  if (chosen_.empty() || of_ == chosen_ || work_.busy()) return;
  working_on_ = chosen_;
  work_.start([file = chosen_] { return previewFile(file); });
}

void PreviewPane::draw() {
  follow();
  if (chosen_.empty()) return remark("Choose a file to see it here.");
  const FilePreview* preview = shown();
  if (preview == nullptr) return remark("reading ...");
  if (picture_) {
    const float side = std::min(static_cast<float>(preview->picture->width), ImGui::GetContentRegionAvail().x);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): ImGui's own way
    const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_->texture()));
    ImGui::Image(texture, {side, side});
    notePlace("open/picture");
  }
  remark(preview->words);
  for (const std::string& note : preview->notes) remark(note);
  if (!preview->longest_units) return;
  if (const auto guess = unitGuess(*preview->longest_units)) remark("No unit: you are asked when it opens.");
}

}  // namespace palpate::viewer
