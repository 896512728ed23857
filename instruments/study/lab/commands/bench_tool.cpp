// Prints a tool along a trajectory, compared with one finger for each of its pads.
#include <fmt/format.h>

#include <utility>

#include "cli/kit/json.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/peers_report.h"
#include "palpate/base/json.h"

namespace palpate::app {

namespace {

Json toJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json toolJson(const BenchToolArguments& arguments, const bench::ToolFigures& f) {
  Json json;
  json["tool"] = arguments.tool;
  json["triangles"] = f.triangles;
  json["pads"] = f.pads;
  json["parts"] = f.parts;
  json["groups"] = f.groups;
  json["ticks"] = f.ticks;
  json["all_touch_ticks"] = f.all_touch;
  json["tick_us"] = percentilesJson(f.tick_us);
  json["any_tick_us"] = percentilesJson(f.any_tick_us);
  json["air_tick_us"] = percentilesJson(f.air_tick_us);
  json["apart_tick_us"] = percentilesJson(f.apart_tick_us);
  json["ratio_to_apart"] = f.apart_tick_us.p50 > 0.0 ? f.tick_us.p50 / f.apart_tick_us.p50 : 0.0;
  json["different"] = f.different;
  json["wrench"] = {{"about_mm", toJson(f.wrench.point)},
                    {"force_n", toJson(f.wrench.force_n)},
                    {"moment_n_mm", toJson(f.wrench.moment_n_mm)},
                    {"peak_moment_n_mm", f.peak_moment_n_mm}};
  json["allocations"] = orNull(f.counts.allocations);
  json["locks"] = orNull(f.counts.locks);
  json["page_faults"] = orNull(f.counts.page_faults);
  return json;
}

std::string toolText(const BenchToolArguments& arguments, const bench::ToolFigures& f) {
  std::string text = fmt::format("tool                     {}: {} pads in {} parts, {} groups\n", arguments.tool,
                                 f.pads, f.parts, f.groups);
  text += fmt::format("triangles                {}\n", f.triangles);
  text += fmt::format("ticks                    {} ({} with every pad in contact)\n", f.ticks, f.all_touch);
  text += fmt::format("tick time                {}\n", percentilesText(f.tick_us));
  text += fmt::format("  with any pads touching {}\n", percentilesText(f.any_tick_us));
  text += fmt::format("  in the air             {}\n", percentilesText(f.air_tick_us));
  text += fmt::format("  a finger for each pad  {}\n", percentilesText(f.apart_tick_us));
  text += fmt::format("pads that felt otherwise {}\n", f.different);
  text += fmt::format("largest wrench           {:.3f} N, moment up to {:.1f} N mm about the first part\n",
                      f.wrench.force_n.norm(), f.peak_moment_n_mm);
  return text + fmt::format("heap allocations         {}, locks {}, page faults {}\n", countText(f.counts.allocations),
                            countText(f.counts.locks), countText(f.counts.page_faults));
}

}  // namespace

void runToolBench(const BenchToolArguments& arguments) {
  const bench::ContactWorld world =
      bench::buildContactWorld(meshFrom(arguments.mesh), 1.0, arguments.stiffness_n_per_mm);
  const device::Trajectory trajectory = trajectoryFrom(arguments.trajectory);
  const contact::ToolShape shape = bench::toolNamed(arguments.tool);
  const bench::ToolFigures figures = bench::measureTool(world, trajectory, shape, arguments.finger, arguments.window);
  Json json = toolJson(arguments, figures);
  std::string text = toolText(arguments, figures);
  if (arguments.peers.wanted) {
    const bench::ToolQueries queries{shape,
                                     bench::posesOnSkin(world, trajectory, shape, arguments.finger, arguments.window)};
    const auto peers = bench::comparePeers(arguments.peers.tool_peers, world, queries, arguments.peers.seconds);
    addPeers(json, peers, PeerTask::tool, figures.any_tick_us.p50);
    text += peersText(peers, PeerTask::tool, figures.any_tick_us.p50);
  }
  printReport(std::move(json), text, arguments.json);
}

}  // namespace palpate::app
