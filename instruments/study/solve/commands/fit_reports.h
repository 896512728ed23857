// Reports of `palpate tissue fit`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/tissue/fitting/force_fit.h"
#include "palpate/tissue/fitting/profile_fit.h"
#include "report/charts/figure.h"

namespace palpate::app {

/// {value, standard_error, at_end} by name.
Json numbersJson(const std::vector<tissue::FittedNumber>& numbers);

/// Every form on one curve; the fits in the order of kForceForms.
struct FittedCurve {
  tissue::ForceCurve curve;
  std::vector<tissue::ForceFit> fits;
};

struct ForceResult {
  std::string file;
  bool free_offset = false;
  std::vector<FittedCurve> curves;       ///< at least one
  std::vector<tissue::ForceFit> shared;  ///< one shape for all curves; empty where there is one curve
  tissue::ForceForm chosen = tissue::ForceForm::power;
  std::string table;                 ///< written table; empty: none
  std::vector<std::string> written;  ///< every file

  /// Fits of the only curve, or those that all share.
  const std::vector<tissue::ForceFit>& fits() const { return shared.empty() ? curves.front().fits : shared; }
};

const tissue::ForceFit& findFit(const std::vector<tissue::ForceFit>& fits, tissue::ForceForm form);

std::string textOf(const ForceResult& result);
Json toJson(const ForceResult& result);

struct ProfileResult {
  std::string file;
  std::vector<tissue::SkinProfile> profiles;          ///< by depth; at least one
  std::vector<std::vector<tissue::ProfileFit>> fits;  ///< per depth all forms, in the order of kProfileForms
  tissue::ProfileForm chosen = tissue::ProfileForm::two_gaussians;
  std::optional<tissue::ForceFit> force;  ///< where forces were given
  tissue::LayeredTable table;             ///< table of the chosen form
  tissue::SharedProfile shared;           ///< one curve for all depths
  std::string table_file;                 ///< written file; empty: none
  std::string profile_file;               ///< likewise
  std::vector<std::string> written;

  const tissue::ProfileFit& chosenFit(std::size_t depth) const { return fits[depth][static_cast<std::size_t>(chosen)]; }
};

std::string textOf(const ProfileResult& result);
Json toJson(const ProfileResult& result);

/// Places and fits by depth, down and sideways; misses; the curve for all depths.
figures::Figure profileFitFigure(const ProfileResult& result);

}  // namespace palpate::app
