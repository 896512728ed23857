// A run of `palpate serve`: a world, its servo with devices or with fingers that pages move, and sixty frames a second
// of the skin.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/kit/simulate_options.h"
#include "cli/serve/network.h"

namespace palpate::app::serving {

struct ServeOptions {
  SimulateOptions input;             ///< the scene; `seconds` is the duration, 0: until a signal
  std::vector<std::string> devices;  ///< for the first fingers, instead of pages
  std::string host = "127.0.0.1";
  int port = 8080;
  Tokens tokens;  ///< those that are given
  std::filesystem::path token_file;
  std::filesystem::path tls_cert, tls_key;  ///< both or neither
  std::vector<std::string> origins;
  std::size_t watchers = 64;
  std::filesystem::path site;       ///< empty: the installed one, or a page that reports its absence
  std::filesystem::path recording;  ///< to record; empty: none
  bool overwrite = false;
  bool json = false;
};

/// Runs until its time is over or a signal ends it. Throws Error.
void serve(const ServeOptions& options);

}  // namespace palpate::app::serving
