// Which words are the origin of a page, and which folder is that of the page.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/serve/access.h"
#include "cli/serve/site.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::app::serving {
namespace {

TEST(OriginOf, HasSmallLettersAndNoStandardPort) {
  EXPECT_EQ(parseOrigin("HTTPS://Place.Example:8443/page?x=1"), "https://place.example:8443");
  EXPECT_EQ(parseOrigin("http://place.example:80"), "http://place.example");
  EXPECT_EQ(parseOrigin("https://place.example:443"), "https://place.example");
  EXPECT_EQ(parseOrigin("http://place.example:443"), "http://place.example:443") << "that of the other scheme";
  EXPECT_EQ(parseOrigin("http://[::1]:8000"), "http://[::1]:8000");
}

TEST(OriginOf, IsEmptyForWhatIsNoOriginOfAPage) {
  for (const char* url : {"", "null", "place.example", "ftp://place.example", "http://", "http:///page",
                          "http://place example", "http://place.example\"", "http://a@place.example"})
    EXPECT_EQ(parseOrigin(url), "") << url;
  EXPECT_EQ(parseOrigin("http://" + std::string(1000, 'a')), "") << "no name is so long";
}

TEST(Site, OfMoreFilesThanAPageHasIsRefused) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "index.html") << "<!doctype html><head></head>";
  for (std::size_t i = 1; i < kMaxSiteFiles; ++i) std::ofstream(folder / (std::to_string(i) + ".txt")) << "";
  EXPECT_NE(Site(folder.path()).find("/index.html"), nullptr);
  std::ofstream(folder / "one_more.txt") << "";
  EXPECT_NE(support::thrownMessage([&] { const Site too_many(folder.path()); }).find("more than 4096 files"),
            std::string::npos);
}

}  // namespace
}  // namespace palpate::app::serving
