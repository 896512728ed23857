// What `palpate tissue realism --living` finds, for people and for programs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "palpate/base/progress.h"
#include "solve/realism/living_limbs.h"

namespace palpate::app {

/// Of people with odd numbers, which the limb's muscles were fitted to, and with even ones, which nothing was.
struct LivingHalves {
  lab::LivingFigures odd;
  lab::LivingFigures even;
};

struct LivingReport {
  std::size_t people = 0;
  int left_out = 0;
  LivingHalves body;          ///< LimbModel::body
  LivingHalves limb;          ///< LimbModel::limb
  LivingHalves relaxed_limb;  ///< LimbModel::relaxed_limb
};

/// Throws Error as lab::readLivingTests does.
LivingReport judgeLiving(const std::filesystem::path& list_or_folder, const Progress& progress = {});

nlohmann::ordered_json livingJson(const LivingReport& report);
std::string livingText(const LivingReport& report);

}  // namespace palpate::app
