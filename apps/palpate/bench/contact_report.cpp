#include "apps/palpate/bench/contact_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/palpate/bench/bench_report.h"

namespace palpate::app {

nlohmann::ordered_json jsonOf(const bench::ContactFigures& f) {
  nlohmann::ordered_json json;
  json["triangles"] = f.triangles;
  json["ticks"] = f.ticks;
  json["tick_us"] = percentilesJson(f.tick_us);
  json["lag_mm"] = {{"p99", f.lag_mm.p99}, {"max", f.lag_mm.max}};
  json["fall_throughs"] = f.falls.ticks;
  json["first_contact_delay_ticks"] = f.falls.first_contact_delay_ticks;
  json["friction"] = {{"kinetic", f.friction.kinetic},
                      {"static", f.friction.static_peak},
                      {"kinetic_min", f.friction.kinetic_min},
                      {"kinetic_max", f.friction.kinetic_max}};
  json["peak_force_n"] = f.peak_force_n;
  json["max_force_step_n"] = f.max_force_step_n;
  json["allocations"] = countJson(f.counts.allocations);
  json["locks"] = countJson(f.counts.locks);
  json["page_faults"] = countJson(f.counts.page_faults);
  json["hash"] = fmt::format("{:016x}", f.hash);
  json["contact_ticks"] = f.contact_ticks;
  json["stick_ticks"] = f.friction.stick_ticks;
  json["slip_ticks"] = f.friction.slip_ticks;
  json["first_contacts"] = f.falls.first_contacts;
  json["fall_events"] = f.falls.events;
  json["peak_depth_mm"] = f.peak_depth_mm;
  json["teleport_ticks"] = f.teleports;
  if (f.sphere) {
    json["sphere"] = {{"least_distance_over_radius", f.sphere->least_distance},
                      {"infeasible_ticks", f.sphere->infeasible_ticks},
                      {"missed_ticks", f.sphere->missed_ticks}};
  }
  return json;
}

std::string textOf(const bench::ContactFigures& f) {
  std::string text = fmt::format("triangles                {}\n", f.triangles);
  text += fmt::format("ticks                    {} ({} in contact)\n", f.ticks, f.contact_ticks);
  text += fmt::format("tick time                {}\n", percentilesText(f.tick_us));
  text += fmt::format("lag |anchor - tip|       p99 {:.3f}  max {:.3f} mm\n", f.lag_mm.p99, f.lag_mm.max);
  text += fmt::format("fall-throughs            {} ticks in {} events\n", f.falls.ticks, f.falls.events);
  text += fmt::format("first contacts           {}, worst delay {} ticks\n", f.falls.first_contacts,
                      f.falls.first_contact_delay_ticks);
  text += fmt::format("friction                 kinetic {:.6f} ({} ticks), break-away peak {:.6f}\n",
                      f.friction.kinetic, f.friction.slip_ticks, f.friction.static_peak);
  text += fmt::format("force                    peak {:.3f} N, largest step {:.3f} N (tick {})\n", f.peak_force_n,
                      f.max_force_step_n, f.max_force_step_tick);
  text += fmt::format("heap allocations         {}, locks {}, page faults {}\n", countText(f.counts.allocations),
                      countText(f.counts.locks), countText(f.counts.page_faults));
  return text + fmt::format("hash                     {:016x}\n", f.hash);
}

nlohmann::ordered_json jsonOf(const bench::HdbFigures& f) {
  nlohmann::ordered_json json = jsonOf(f.contact);
  json["hdb"] = {{"edge_mm", f.edge_mm}, {"leaves", f.leaves}, {"most_listed", f.most_listed}, {"queries", f.queries}};
  return json;
}

std::string textOf(const bench::HdbFigures& f) {
  return textOf(f.contact) +
         fmt::format("detecting box            {:.1f} mm; {} leaves, at most {} triangles listed, {} queries\n",
                     f.edge_mm, f.leaves, f.most_listed, f.queries);
}

}  // namespace palpate::app
