// What a hunt found: as text, as JSON, as folders of cases.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/commands/hunt_options.h"
#include "lab/hunt/kept_case.h"

namespace palpate::app {

/// `files`: for each failing path the folder of its case, or nothing.
nlohmann::ordered_json huntJson(const lab::HuntPlan& plan, const lab::HuntResult& result,
                                const std::vector<std::string>& files);
std::string huntText(const lab::HuntResult& result, const std::vector<std::string>& files);
std::string replayText(const std::string& folder, const lab::KeptCase& kept, const lab::HuntReport& report);

/// Makes the first failing paths of each fault short, of different kinds of bodies as far as there are, and writes them
/// into --out. For each failing path its folder or nothing. Throws Error.
std::vector<std::string> writeCases(const lab::HuntPlan& plan, const lab::HuntResult& result,
                                    const HuntArguments& arguments, const Progress& progress);

}  // namespace palpate::app
