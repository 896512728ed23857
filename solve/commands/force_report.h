// What `palpate tissue fit force` found, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "palpate/tissue/fitting/force_fit.h"

namespace palpate::app {

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
  std::string table;                 ///< that was written; empty: none
  std::vector<std::string> written;  ///< every file

  /// Of the only curve, or those that all share.
  const std::vector<tissue::ForceFit>& fits() const { return shared.empty() ? curves.front().fits : shared; }
};

const tissue::ForceFit& fitOf(const std::vector<tissue::ForceFit>& fits, tissue::ForceForm form);

/// Lines for a scene file; the table's name is needed where the engine has no law of this form.
std::string sceneKeys(const ForceResult& result);

std::string textOf(const ForceResult& result);
nlohmann::ordered_json jsonOf(const ForceResult& result);

}  // namespace palpate::app
