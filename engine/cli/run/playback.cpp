#include "cli/run/playback.h"

#include "cli/kit/device_option.h"
#include "cli/kit/interruption.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app {

Playback::Playback(const std::string& file) {
  if (!file.empty()) script_ = viewer::readInputScript(pathOf(file));
}

bool Playback::play(double now_s, window::Window& window, viewer::Viewer& viewer,
                    std::vector<window::InputEvent>& events) {
  for (; !finished() && script_[next_].time_s <= now_s; ++next_) {
    const viewer::ScriptEvent& event = script_[next_];
    if (event.kind == viewer::ScriptEvent::Kind::close) {
      if (next_ + 1 == script_.size()) return true;
      viewer.state().request(viewer::Quit{});
    } else if (event.kind == viewer::ScriptEvent::Kind::size) {
      window.setSize(event.width, event.height);
    } else if (event.kind == viewer::ScriptEvent::Kind::head) {
      viewer.headAt(event.head_mm, now_s);
    } else {
      events.push_back(event.input);
    }
  }
  return false;
}

void showFrames(window::Window& window, viewer::Viewer& viewer, Playback& playback, std::uint64_t frames,
                const std::function<void(std::uint64_t frame, double now_s)>& shown) {
  const auto started = Clock::now();
  double first_shown_s = 0.0;
  for (std::uint64_t frame = 1;; ++frame) {
    std::vector<window::InputEvent> events = window.events();
    const double now_s = frame == 1 ? 0.0 : secondsSince(started) - first_shown_s;  // a script begins at the first
    const bool close = playback.play(now_s, window, viewer, events);
    if (window.closing()) {
      window.stayOpen();
      viewer.state().request(viewer::Quit{});
    }
    if (close || viewer.wantsToQuit() || endingSignal() != 0) return;
    viewer.state().state.stereo.monitor_row = window.top();
    viewer.frame(window.width(), window.height(), window.contentScale(), now_s, events);
    viewer.drawsItself() ? window.swap() : window.present(viewer.target());
    if (frame == 1) first_shown_s = secondsSince(started);
    shown(frame, now_s);
    if (frames > 0 && frame >= frames) return;
  }
}

viewer::ViewerHost makeViewerHost(window::Window& window) {
  return {[&window] { window.setFullScreen(!window.fullScreen()); },
          [&window](const std::string& text) { window.setClipboard(text); },
          [&window] { return window.clipboard(); },
          [&window](bool shown) { window.showCursor(shown); },
          [&window](const std::string& title) { window.setTitle(title); },
          window.quadBuffered()};
}

std::vector<viewer::OpenedDevice> openedFor(const scene::World& world, const std::vector<std::string>& names) {
  std::vector<device::OpenOptions> fingers(viewer::kFingers);
  for (device::OpenOptions& options : fingers) options.tick_s = 1.0 / world.scene.ticks_per_s;
  std::vector<device::Device> devices = openDevices(names, fingers);
  std::vector<viewer::OpenedDevice> opened;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const Vec3 origin = device::standardOrigin(world, names[i], i);
    const auto settings = device::settingsOf(world.scene, names[i], i).value_or(scene::DeviceSettings{});
    opened.push_back({names[i], std::move(devices[i]), device::workspaceOf(settings, origin)});
  }
  return opened;
}

}  // namespace palpate::app
