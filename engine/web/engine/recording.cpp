// Rows are stored in short form and become samples again when they are written.
#include "engine/live_body.h"

#include "palpate/trace/forces_rows.h"

namespace palpate::web {

void Recording::add(std::uint64_t tick, std::size_t finger, const contact::FingerOutput& felt) {
  if (rows_.size() == kMaxRecorded) rows_.pop_front();
  rows_.push_back({tick, felt.tip, felt.proxy, felt.anchor, felt.force, felt.depth_mm, felt.triangle, felt.status,
                   static_cast<std::uint8_t>(finger), felt.touch});
}

std::string Recording::asForcesCsv() const {
  trace::ForcesCsvSettings settings;
  settings.finger_names = {"left", "right"};
  std::string text(trace::forcesCsvHeader());
  text += '\n';
  for (const Row& row : rows_) {
    trace::Sample sample;
    sample.tick = row.tick;
    sample.finger = row.finger;
    sample.contact.tip = row.tip;
    sample.contact.proxy = row.proxy;
    sample.contact.anchor = row.anchor;
    sample.contact.force = row.force;
    sample.contact.depth_mm = row.depth_mm;
    sample.contact.triangle = row.triangle;
    sample.contact.status = row.status;
    sample.contact.touch = row.touch;
    sample.device_force = row.force;
    trace::appendForcesRow(text, settings, sample);
  }
  return text;
}

}  // namespace palpate::web
