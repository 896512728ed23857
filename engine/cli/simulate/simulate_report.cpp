#include "cli/simulate/simulation.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/kit/interruption.h"
#include "cli/kit/json.h"
#include "palpate/base/json.h"
#include "palpate/body/places.h"
#include "palpate/scene/words.h"

namespace palpate::app {

namespace {

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Ticks in which the limiter acted, by kind; kinds that never happened are left out.
Json interventionsJson(const FingerStatistics& finger) {
  Json json = Json::object();
  for (std::size_t i = 0; i < finger.interventions.size(); ++i) {
    if (finger.interventions[i] == 0) continue;
    std::string name = servo::safetyNames()[i];
    std::replace(name.begin(), name.end(), ' ', '_');
    json[name] = finger.interventions[i];
  }
  return json;
}

/// The place of deepest pressure as an examiner names it; empty without a touch or on a body without names.
std::string describePlace(const scene::World& world, const FingerStatistics& finger) {
  return finger.touching == 0 ? "" : body::describePlace(world.body->anatomy.landmarks, finger.deepest_at);
}

Json fingerJson(const scene::World& world, std::size_t i, const FingerStatistics& finger) {
  Json json = {{"name", world.scene.fingers[i].name},
               {"touching_share", share(finger.touching, finger.ticks)},
               {"stick_share", share(finger.sticking, finger.touching)},
               {"slip_share", share(finger.slipping, finger.touching)},
               {"force_n", {{"mean", finger.meanForceN()}, {"peak", finger.peak_force_n}}},
               {"depth_mm", {{"mean", finger.meanDepthMm()}, {"peak", finger.peak_depth_mm}}},
               {"device_force_peak_n", finger.peak_device_force_n},
               {"device_limited_share", share(finger.limited, finger.touching)},
               {"interventions", interventionsJson(finger)},
               {"triangles_touched", finger.triangles}};
  const std::string where = describePlace(world, finger);
  if (!where.empty()) json["where"] = where;
  return json;
}

/// Distance between skin and bone at the deepest press; null on a body without bones, and where none moved.
Json coverJson(const SimulationResult& result) {
  if (!result.cover) return nullptr;
  const engine::BoneCover& cover = *result.cover;
  return {{"least_mm", cover.least_mm},
          {"bone", result.world->body->anatomy.bones[cover.bone].name},
          {"at_mm", {cover.at.x(), cover.at.y(), cover.at.z()}}};
}

/// The limits on the device's force in this scene, or the same without a device.
Json deviceJson(const servo::LimiterSettings& limits) {
  return {{"force_n", limits.force_n},
          {"stiffness_factor", limits.stiffness_factor},
          {"stiffness_n_per_mm", limits.stiffness_factor * limits.stiffness_n_per_mm},
          {"ratios_kept_to_n", limits.cap_n_per_mm > 0.0 ? limits.compared_n : limits.force_n},
          {"unsafe_stiffness", limits.unsafe}};
}

Json bodyJson(const scene::World& world) {
  const auto [soft, stiff] =
      std::minmax_element(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end());
  return {{"name", world.body->name},
          {"skin_triangles", world.body->skin.triangles.size()},
          {"skin_vertices", world.body->skin.positions.size()},
          {"closed", world.body->closed},
          {"self_intersecting", world.surface.geometry->self_intersecting},
          {"bones", world.body->anatomy.bones.size()},
          {"stiffness_n_per_mm", {{"min", *soft}, {"max", *stiff}}}};
}

Json pacingJson(const servo::LoopReport& loop, const DisplayReport& display) {
  return {{"lateness_us", percentilesJson(loop.lateness)},
          {"stalls", loop.stalls},
          {"dropped_samples", loop.dropped_samples},
          {"fifo", loop.grant.realtime},
          {"memory_locked", loop.grant.memory_locked},
          {"refused", loop.grant.note},
          {"display",
           {{"frames", display.frames},
            {"deform_us", percentilesJson(display.deform)},
            {"contact_age_us", percentilesJson(display.staleness)}}}};
}

std::string percentilesLine(const servo::DurationPercentiles& p) {
  return fmt::format("p50 {:.2f}   p99 {:.2f}   p99.9 {:.2f}   max {:.2f} us", p.p50_us, p.p99_us, p.p99_9_us,
                     p.max_us);
}

std::string bodyLine(const scene::World& world) {
  const auto [soft, stiff] =
      std::minmax_element(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end());
  const std::string stiffness =
      *soft == *stiff ? fmt::format("{:.2f}", *soft) : fmt::format("{:.2f} to {:.2f}", *soft, *stiff);
  return fmt::format("{}; skin of {} triangles, {} N/mm", world.body->name, world.body->skin.triangles.size(),
                     stiffness);
}

std::string runLine(const SimulationResult& result) {
  const std::string how = result.display ? "in real time"
                                         : fmt::format("{:.0f} times as fast as real time",
                                                       result.duration_s / std::max(result.loop.wall_s, 1e-9));
  return fmt::format("{:.3f} s, {} ticks, {}", result.duration_s, result.loop.ticks, how);
}

std::string fingerLine(const std::string& name, const FingerStatistics& finger) {
  return fmt::format("  {:<12} {:>6.1f} % {:>7.1f} % {:>6.1f} % {:>8.2f} {:>6.2f} {:>8.2f} {:>6.2f} {:>10}\n", name,
                     100.0 * share(finger.touching, finger.ticks), 100.0 * share(finger.sticking, finger.touching),
                     100.0 * share(finger.slipping, finger.touching), finger.meanForceN(), finger.peak_force_n,
                     finger.meanDepthMm(), finger.peak_depth_mm, finger.triangles);
}

std::string fingerTable(const SimulationResult& result) {
  std::string text = fmt::format("\n  {:<12} {:>8} {:>9} {:>8} {:>15} {:>15} {:>10}\n", "finger", "touching",
                                 "sticking", "slipping", "mean  peak N", "mean  peak mm", "triangles");
  for (std::size_t i = 0; i < result.fingers.size(); ++i) {
    text += fingerLine(result.world->scene.fingers[i].name, result.fingers[i]);
  }
  return text + "\n";
}

std::string placeLines(const SimulationResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.fingers.size(); ++i) {
    const std::string where = describePlace(*result.world, result.fingers[i]);
    if (where.empty()) continue;
    text += fmt::format("  place      {} pressed deepest at {}\n", result.world->scene.fingers[i].name, where);
  }
  return text;
}

std::string coverLine(const SimulationResult& result) {
  if (!result.cover) return {};
  return fmt::format("  clearance  {} at the deepest press\n", engine::describe(*result.cover, *result.world));
}

std::string realtimeLines(const SimulationResult& result) {
  if (!result.display) return {};
  const servo::LoopReport& loop = result.loop;
  std::string text = fmt::format("  late       {}   ({} scheduling{})\n", percentilesLine(loop.lateness),
                                 loop.grant.realtime ? "real-time" : "ordinary",
                                 loop.grant.note.empty() ? "" : ": " + loop.grant.note);
  text += fmt::format("  display    {} frames; deformation {}\n", result.display->frames,
                      percentilesLine(result.display->deform));
  if (loop.dropped_samples > 0) text += fmt::format("  lost       {} samples were not written\n", loop.dropped_samples);
  return text;
}

std::string safetyLine(const SimulationResult& result) {
  std::uint64_t limited = 0;
  std::uint64_t touching = 0;
  for (const FingerStatistics& finger : result.fingers) {
    limited += finger.limited;
    touching += finger.touching;
  }
  const servo::LimiterSettings& limits = result.limits;
  std::string factor;
  if (limits.stiffness_factor < 1.0) factor = fmt::format("; all forces times {:.2f}", limits.stiffness_factor);
  if (limits.cap_n_per_mm > 0.0) {
    factor += fmt::format("; above {:.1f} N no steeper than {:.2f} N/mm", limits.compared_n, limits.cap_n_per_mm);
  }
  const char* unsafe = limits.unsafe ? "UNSAFE: " : "";
  return fmt::format("  device     {}force limit {:.1f} N (active in {:.1f} % of contact ticks){}\n", unsafe,
                     limits.force_n, 100.0 * share(limited, touching), factor);
}

std::string filesLines(const SimulationResult& result) {
  std::string text = fmt::format("\n  results in {}:", result.folder.string());
  for (const std::string& file : result.files) text += " " + file;
  return text + "\n";
}

}  // namespace

Json reportJson(const SimulationResult& result) {
  Json fingers = Json::array();
  for (std::size_t i = 0; i < result.fingers.size(); ++i) {
    fingers.push_back(fingerJson(*result.world, i, result.fingers[i]));
  }
  Json report = {{"title", result.world->scene.title},
                 {"preset", result.preset.empty() ? Json(nullptr) : Json(result.preset)},
                 {"tissue", wordFor(result.world->tissue.model)},
                 {"law", wordFor(result.world->tissue.law)},
                 {"mode", result.display ? "realtime" : "headless"},
                 {"complete", result.ended_by == 0},
                 {"ended_by", result.ended_by == 0 ? Json(nullptr) : Json(nameOfSignal(result.ended_by))},
                 {"folder", result.folder.string()},
                 {"body", bodyJson(*result.world)},
                 {"build_s", result.build_s},
                 {"pictures_s", result.pictures_s},
                 {"duration_s", result.duration_s},
                 {"planned_s", result.planned_s},
                 {"wall_s", result.loop.wall_s},
                 {"ticks", result.loop.ticks},
                 {"tick_us", percentilesJson(result.loop.compute)},
                 {"overruns", result.loop.overruns},
                 {"slow_ticks", result.loop.slow_ticks},
                 {"device", deviceJson(result.limits)},
                 {"fingers", fingers},
                 {"bone_cover", coverJson(result)},
                 {"hash", fmt::format("{:016x}", result.hash)},
                 {"files", result.files},
                 {"notes", result.notes}};
  if (result.display) report["realtime"] = pacingJson(result.loop, *result.display);
  return report;
}

std::string formatSummary(const SimulationResult& result) {
  std::string text = fmt::format("{}\n", result.world->scene.title);
  text += fmt::format("  body       {}\n", bodyLine(*result.world));
  text += fmt::format("  tissue     {}\n", scene::describe(result.world->tissue));
  text += fmt::format("  run        {}\n", runLine(result));
  text += fingerTable(result);
  text += placeLines(result);
  text += coverLine(result);
  text += fmt::format("  tick       {}   overruns {}\n", percentilesLine(result.loop.compute), result.loop.overruns);
  text += realtimeLines(result);
  text += safetyLine(result);
  if (result.pictures_s > 0.0) text += fmt::format("  pictures   drawn in {:.1f} s\n", result.pictures_s);
  for (const std::string& note : result.notes) text += fmt::format("  note       {}\n", note);
  return text + filesLines(result);
}

}  // namespace palpate::app
