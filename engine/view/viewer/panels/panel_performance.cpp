// Rates and punctuality: the hand's side and the eye's side separately.
#include <fmt/format.h>
#include <imgui.h>

#include "palpate/base/language.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

void performancePanel(const Performance& p) {
  ImGui::TextUnformatted(tr("Haptic (last second)"));
  valueLine("rate", fmt::format("{:.0f} Hz", p.servo.ticks_per_s));
  valueLine("tick, median", fmt::format("{:.1f} us", p.servo.compute.p50_us));
  valueLine("tick, 99 %", fmt::format("{:.1f} us", p.servo.compute.p99_us));
  valueLine("late, median", fmt::format("{:.1f} us", p.servo.lateness.p50_us));
  valueLine("late, 99 %", fmt::format("{:.1f} us", p.servo.lateness.p99_us));
  valueLine("late, worst", fmt::format("{:.0f} us", p.servo.lateness.max_us));
  valueLine("overruns", trf("{} of {}", p.servo.overruns, p.servo.ticks));
  valueLine("stalls", fmt::format("{}", p.servo.stalls));
  valueLine("samples lost", fmt::format("{}", p.dropped_samples));
  ImGui::Separator();
  ImGui::TextUnformatted(tr("Graphic"));
  valueLine("rate", fmt::format("{:.0f} fps", p.frames_per_s));
  valueLine("deformation", fmt::format("{:.2f} ms", p.deform_ms));
  valueLine("upload", fmt::format("{:.2f} ms", p.upload_ms));
  valueLine("drawing", fmt::format("{:.2f} ms", p.draw_ms));
  valueLine("whole frame", fmt::format("{:.2f} ms", p.frame_ms));
  valueLine("resolution", fmt::format("{:.0f} %", 100.0 * p.picture_share));
  remark(p.graphics);
}

}  // namespace palpate::viewer
