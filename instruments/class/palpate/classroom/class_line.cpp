#include "palpate/classroom/class_line.h"

#include <algorithm>
#include <utility>

namespace palpate::classroom {

void ClassLine::update(const trace::Sample& sample) {
  const bool newer = sample.tick > pressing_.tick;
  if (newer || sample.contact.force.norm() > pressing_.contact.force.norm()) pressing_ = sample;
}

void ClassLine::follow(const training::Session* session) {
  if (session == nullptr) {
    if (std::exchange(told_, false)) link_.clearState();
    seen_.reset();
    return;
  }
  const StateInputs now{session->screen(), session->trialNumber(), session->paused()};
  if (seen_ != now) {
    seen_ = now;
    told_ = true;
    link_.publishState(makeStationState(*session));
  }
  const auto& sites = session->plan().sites.sites;
  const auto pressed =
      std::ranges::count_if(sites, [&](const training::Site& site) { return session->visited(site.number); });
  link_.publishLive({.finger_mm = pressing_.contact.tip,
                     .force_n = pressing_.contact.force.norm(),
                     .depth_mm = pressing_.contact.depth_mm,
                     .site = session->touchedSite(),
                     .sites_pressed = static_cast<int>(pressed),
                     .phase = session->screen()});
}

}  // namespace palpate::classroom
