// What `palpate tissue fit profile` found, for people and for programs, and as a picture.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "palpate/tissue/fitting/force_fit.h"
#include "palpate/tissue/fitting/profile_fit.h"
#include "report/charts/figure.h"

namespace palpate::app {

struct ProfileResult {
  std::string file;
  std::vector<tissue::SkinProfile> profiles;          ///< by depth; at least one
  std::vector<std::vector<tissue::ProfileFit>> fits;  ///< of each depth all forms, in the order of kProfileForms
  tissue::ProfileForm chosen = tissue::ProfileForm::two_gaussians;
  std::optional<tissue::ForceFit> force;  ///< where forces were given
  tissue::LayeredTable table;             ///< of the chosen form
  tissue::SharedProfile shared;           ///< one curve for all depths
  std::string table_file;                 ///< that was written; empty: none
  std::string profile_file;               ///< likewise
  std::vector<std::string> written;

  const tissue::ProfileFit& chosenFit(std::size_t depth) const { return fits[depth][static_cast<std::size_t>(chosen)]; }
};

std::string textOf(const ProfileResult& result);
nlohmann::ordered_json jsonOf(const ProfileResult& result);

/// Places and fits by depth, down and sideways; what is missed; the curve for all depths.
figures::Figure profileFitFigure(const ProfileResult& result);

}  // namespace palpate::app
