#include "cli/serve/site.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <vector>

#include "palpate/base/base64.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::app::serving {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kNoSite = R"html(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Palpate</title>
<p>Palpate serves a skin here, but not the page that shows it: build it (tools/build-web) and name its folder with
--site, or open the page from elsewhere and allow that with --origin.</p></html>
)html";

struct TypeOfEnding {
  std::string_view ending, type;
};
constexpr std::array kTypes = {
    TypeOfEnding{".html", "text/html; charset=utf-8"},
    TypeOfEnding{".js", "text/javascript; charset=utf-8"},
    TypeOfEnding{".mjs", "text/javascript; charset=utf-8"},
    TypeOfEnding{".css", "text/css; charset=utf-8"},
    TypeOfEnding{".json", "application/json"},
    TypeOfEnding{".webmanifest", "application/manifest+json"},
    TypeOfEnding{".txt", "text/plain; charset=utf-8"},
    TypeOfEnding{".md", "text/plain; charset=utf-8"},
    TypeOfEnding{".wasm", "application/wasm"},
    TypeOfEnding{".svg", "image/svg+xml"},
    TypeOfEnding{".png", "image/png"},
    TypeOfEnding{".jpg", "image/jpeg"},
    TypeOfEnding{".webp", "image/webp"},
    TypeOfEnding{".ico", "image/x-icon"},
    TypeOfEnding{".woff2", "font/woff2"},
};

std::string sha256(std::string_view text) {
  std::string digest(32, '\0');
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), reinterpret_cast<unsigned char*>(digest.data()), &size, EVP_sha256(), nullptr);
  return digest;
}

std::string hex(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

/// The texts between <script ...> and </script> without a file.
std::vector<std::string_view> scriptsIn(std::string_view html) {
  std::vector<std::string_view> scripts;
  std::size_t at = 0;
  while ((at = html.find("<script", at)) != std::string_view::npos) {
    const std::size_t begin = html.find('>', at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = html.find("</script", begin);
    if (end == std::string_view::npos) break;
    if (html.substr(at, begin - at).find(" src") == std::string_view::npos) {
      scripts.push_back(html.substr(begin + 1, end - begin - 1));
    }
    at = end;
  }
  return scripts;
}

SiteFile siteFile(std::string content, std::string_view type) {
  SiteFile file;
  file.type = type;
  file.tag = '"' + hex(sha256(content)).substr(0, 32) + '"';
  if (type.starts_with("text/html")) file.policy = contentPolicy(content);
  file.content = std::move(content);
  return file;
}

/// Marks the page as served: the body is felt here (engine/web/page/source.js).
void markServed(std::string& html) {
  constexpr std::string_view kHead = "<head>";
  if (const std::size_t head = html.find(kHead); head != std::string::npos) {
    html.insert(head + kHead.size(), "\n<meta name=\"palpate-source\" content=\"served\">");
  }
}

bool isHidden(const fs::path& relative) {
  return std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part.string()[0] == '.'; });
}

}  // namespace

std::string_view mediaType(const fs::path& file) {
  const std::string ending = file.extension().string();
  const auto* row = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& one) { return one.ending == ending; });
  return row == kTypes.end() ? "application/octet-stream" : row->type;
}

std::string contentPolicy(std::string_view html) {
  std::string scripts = "'self' 'wasm-unsafe-eval'";
  for (const std::string_view script : scriptsIn(html)) scripts += " 'sha256-" + base64(sha256(script)) + "'";
  return "default-src 'none'; script-src " + scripts +
         "; worker-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
         "connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

Site::Site() { files_.emplace("/index.html", siteFile(std::string(kNoSite), mediaType("index.html"))); }

Site::Site(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw Error::inFile(folder.string(), "no such folder");
  std::uint64_t bytes = 0;
  for (fs::recursive_directory_iterator at(folder, error), end; at != end; at.increment(error)) {
    if (error) throw Error::inFile(folder.string(), error.message());
    const fs::path relative = at->path().lexically_relative(folder);
    if (at->is_symlink() || isHidden(relative)) {
      at.disable_recursion_pending();
      continue;
    }
    if (!at->is_regular_file()) continue;
    std::string content = readFile(at->path(), kMaxSiteBytes);
    bytes += content.size();
    if (bytes > kMaxSiteBytes || files_.size() == kMaxSiteFiles) {
      throw Error::inFile(folder.string(),
                          fmt::format("has more than {} files or {} MB; check that it is the page's folder",
                                      kMaxSiteFiles, kMaxSiteBytes >> 20));
    }
    if (mediaType(relative).starts_with("text/html")) markServed(content);
    files_.emplace("/" + relative.generic_string(), siteFile(std::move(content), mediaType(relative)));
  }
  if (!files_.contains("/index.html"))
    throw Error::inFile(folder.string(), "has no index.html; build the page with tools/build-web");
}

const SiteFile* Site::find(std::string_view request_path) const {
  const auto file = files_.find(request_path == "/" ? std::string_view("/index.html") : request_path);
  return file == files_.end() ? nullptr : &file->second;
}

}  // namespace palpate::app::serving
