// The page's files, read once into memory: a request is looked up among their names and never becomes a path, so there
// is no way out of the folder, no list of it, and no file that came later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace palpate::app::serving {

struct SiteFile {
  std::string content;
  std::string type;    ///< "text/html; charset=utf-8"
  std::string tag;     ///< of the content, for If-None-Match, in quotes
  std::string policy;  ///< of a page, its Content-Security-Policy; otherwise empty
};

inline constexpr std::uint64_t kMaxSiteBytes = std::uint64_t{256} << 20;
inline constexpr std::size_t kMaxSiteFiles = 4096;

class Site {
 public:
  /// One page that says how a page comes here.
  Site();
  /// What lies in the folder and below; pages are told that they are served. Links and names with a dot at the front
  /// left out. Throws Error: no folder, no index.html, too many or too large files.
  explicit Site(const std::filesystem::path& folder);

  /// For the path of a request, "/" being index.html; null where there is none. Valid as long as the site.
  const SiteFile* find(std::string_view request_path) const;
  std::size_t files() const { return files_.size(); }

 private:
  std::map<std::string, SiteFile, std::less<>> files_;  ///< "/page/main.js"
};

/// What a browser may do on a page: its own files and streams, nothing from elsewhere; scripts that stand in the page
/// itself by their hash.
std::string contentPolicy(std::string_view html);

/// By the name's ending; "application/octet-stream" for one that is not known.
std::string_view typeOf(const std::filesystem::path& file);

}  // namespace palpate::app::serving
