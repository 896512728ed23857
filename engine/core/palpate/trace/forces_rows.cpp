// fmt's plain {} is the shortest decimal that reads back.
#include "palpate/trace/forces_rows.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace palpate::trace {

namespace {

std::string_view nameOf(contact::Touch touch) {
  constexpr std::array<std::string_view, 3> kNames = {"free", "stick", "slip"};
  return kNames[static_cast<std::size_t>(touch)];
}

void appendVector(std::string& text, const Vec3& v) {
  fmt::format_to(std::back_inserter(text), ",{},{},{}", v.x(), v.y(), v.z());
}

std::int64_t signedIndex(Index index) { return index == kNoIndex ? -1 : static_cast<std::int64_t>(index); }

}  // namespace

std::string_view forcesCsvHeader() {
  return "t_s,finger,tip_x_mm,tip_y_mm,tip_z_mm,proxy_x_mm,proxy_y_mm,proxy_z_mm,anchor_x_mm,anchor_y_mm,anchor_z_mm,"
         "force_x_n,force_y_n,force_z_n,depth_mm,state,triangle,device_x_n,device_y_n,device_z_n,contact_status,"
         "safety_status";
}

void appendForcesRow(std::string& text, const ForcesCsvSettings& settings, const Sample& sample) {
  const contact::FingerOutput& contact = sample.contact;
  const double time = settings.start_s + static_cast<double>(sample.tick) / settings.ticks_per_s;
  fmt::format_to(std::back_inserter(text), "{},{}", time, settings.finger_names[sample.finger]);
  for (const Vec3& v : {contact.tip, contact.proxy, contact.anchor, contact.force}) appendVector(text, v);
  fmt::format_to(std::back_inserter(text), ",{},{},{}", contact.depth_mm, nameOf(contact.touch),
                 signedIndex(contact.triangle));
  appendVector(text, sample.device_force);
  fmt::format_to(std::back_inserter(text), ",{},{}\n", contact.status, sample.safety);
}

}  // namespace palpate::trace
