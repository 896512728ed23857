#include "view/viewer/opening_view.h"

#include <imgui.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/window/gui_passes.h"

namespace palpate::viewer {

namespace {

void progress(const std::optional<engine::BuildProgress>& building) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * room.x, 0.5f * room.y}, ImGuiCond_Always, {0.5f, 0.5f});
  if (ImGui::Begin("opening", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::TextUnformatted(tr(building ? building->stage.c_str() : "opening"));
    ImGui::ProgressBar(building ? static_cast<float>(building->done) : 0.0f, {320.0f, 0.0f});
  }
  ImGui::End();
}

}  // namespace

bool OpeningView::isBeingClicked() const { return page_ && ImGui::IsMouseDown(ImGuiMouseButton_Left); }

std::span<const window::InputEvent> OpeningView::frame(const Frame& frame, std::span<const window::InputEvent> events,
                                                       const std::optional<engine::BuildProgress>& building) {
  const bool first = !target_;
  if (page_ && offers_.activities) activities_ = offers_.activities();
  if (first || target_->width() != frame.width || target_->height() != frame.height) {
    target_ = std::make_unique<view::Target>(std::max(1, frame.width), std::max(1, frame.height));
  }
  const double points = frame.scale * state_.text_size;
  gui_.setTheme(state_.theme);
  const auto draw = [&](std::span<const window::InputEvent> pass) {
    gui_.begin(Vec2(frame.width, frame.height) / points, points, frame.elapsed_s, pass);
    if (!page_) progress(building);
    startPage({state_.recent, state_.start_page, pictures_, activities_, awaited_, building}, page_, output_);
    gui_.end();
  };
  // A dialog knows its size, and is visible, from its second pass on.
  if (first) draw({});
  std::span<const window::InputEvent> left = events;
  for (const auto pass : window::guiPasses(events)) {
    if (!page_) {
      draw({});
      break;
    }
    draw(pass);
    left = left.subspan(pass.size());
  }
  target_->clear();
  target_->bind();
  gui_.present(frame.width, frame.height);
  return left;
}

}  // namespace palpate::viewer
