// The page's files, read once into memory: a request is looked up among their names and never becomes a path, so it
// cannot leave the folder, list it or reach a file added later.
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
  std::string tag;     ///< tag of the content, for If-None-Match, in quotes
  std::string policy;  ///< Content-Security-Policy of a page; otherwise empty
};

inline constexpr std::uint64_t kMaxSiteBytes = std::uint64_t{256} << 20;
inline constexpr std::size_t kMaxSiteFiles = 4096;

class Site {
 public:
  /// One page on how to install the site.
  Site();
  /// Reads the folder and its subfolders; pages are marked as served. Links and names with a dot at the front are left
  /// out. Throws Error: no folder, no index.html, too many or too large files.
  explicit Site(const std::filesystem::path& folder);

  /// The file for the path of a request, "/" being index.html; null where there is none. Valid as long as the site.
  const SiteFile* find(std::string_view request_path) const;
  std::size_t files() const { return files_.size(); }

 private:
  std::map<std::string, SiteFile, std::less<>> files_;  ///< "/page/main.js"
};

/// The rights of a page in the browser: its own files and streams, nothing from elsewhere; scripts inside the page by
/// their hash.
std::string contentPolicy(std::string_view html);

/// By the name's ending; "application/octet-stream" for an unknown one.
std::string_view mediaType(const std::filesystem::path& file);

}  // namespace palpate::app::serving
