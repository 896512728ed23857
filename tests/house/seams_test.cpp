// What the libraries leave to others: printing and exiting to programs, threads for cold work and opening files to
// base/host_environment.cpp and base/output_file.h, foreign mesh formats to read_foreign.cpp. And what the whole
// product leaves to one place: writing files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "support/places.h"

namespace {

namespace fs = std::filesystem;

const fs::path kSourceFolder = palpate::support::sourceFolder();
/// The libraries: what is below <house>/palpate.
const std::vector<fs::path> kLibraries = [] {
  std::vector<fs::path> folders;
  for (const char* house : {"engine/core", "engine/host", "engine/view", "instruments/measure", "instruments/teach",
                            "instruments/class", "instruments/study/solve"}) {
    folders.push_back(kSourceFolder / house / "palpate");
  }
  return folders;
}();

constexpr const char* kFoldersOfHouses[] = {"engine/core",
                                            "engine/host",
                                            "engine/view",
                                            "engine/cli",
                                            "engine/bindings",
                                            "instruments/report",
                                            "instruments/measure",
                                            "instruments/teach",
                                            "instruments/class",
                                            "instruments/study/dissertation",
                                            "instruments/study/solve",
                                            "instruments/study/lab",
                                            "examples"};

/// std::regex is slow, and few lines bear one of the words without which none matches.
struct Pattern {
  std::vector<std::string_view> words;
  std::regex expression;
};

/// Whether a line matches, its comment apart.
bool matches(std::string_view line, const Pattern& pattern) {
  const std::string_view code = line.substr(0, line.find("//"));
  const auto is_there = [&](std::string_view word) { return code.find(word) != std::string_view::npos; };
  return std::ranges::any_of(pattern.words, is_there) &&
         std::regex_search(code.begin(), code.end(), pattern.expression);
}

/// "room/file:line" of every line of code below `folder`, tests apart, that matches, but for files whose names begin as
/// one of `except`.
std::vector<std::string> placesIn(const fs::path& folder, const Pattern& pattern,
                                  const std::vector<std::string>& except) {
  std::vector<std::string> places;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    const auto excepted = [&](const std::string& beginning) { return name.starts_with(beginning); };
    if (!entry.is_regular_file() || name.starts_with("tests/")) continue;
    if (std::any_of(except.begin(), except.end(), excepted)) continue;
    std::ifstream stream(entry.path());
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (matches(line, pattern)) places.push_back(name + ":" + std::to_string(number) + ": " + line);
    }
  }
  return places;
}

/// In all libraries.
std::vector<std::string> placesOf(const Pattern& pattern, const std::vector<std::string>& except = {}) {
  std::vector<std::string> places;
  for (const fs::path& library : kLibraries) {
    for (std::string& place : placesIn(library, pattern, except)) places.push_back(std::move(place));
  }
  return places;
}

const std::vector<std::string> kNowhere;

/// Nobody matches but these, and each of them does: a name that is no longer needed goes.
void expectOnlyIn(const std::vector<std::string>& owners, const Pattern& pattern) {
  EXPECT_EQ(placesOf(pattern, owners), kNowhere);
  const std::vector<std::string> places = placesOf(pattern);
  for (const std::string& owner : owners) {
    const auto of_owner = [&](const std::string& place) { return place.starts_with(owner); };
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), of_owner)) << owner;
  }
}

const Pattern kPrints{{"std::c", "printf", "puts", "perror", "fmt::print"},
                      std::regex(R"(std::c(out|err|log)\b|\bf?printf\(|\b(fputs|puts|perror)\(|fmt::print)")};
const Pattern kExits{{"xit(", "abort(", "terminate("}, std::regex(R"(\b(exit|_Exit|quick_exit|abort|terminate)\()")};
const Pattern kThreads{{"std::async", "thread", "packaged_task", "hardware_concurrency"},
                       std::regex(R"(std::(async|thread|jthread|packaged_task)\b|hardware_concurrency)")};
const Pattern kOpens{{"stream", "filebuf", "open(", "stbi_", "_file(", "ReadFile("},
                     std::regex(R"(\b[io]?fstream\b|\bfilebuf\b|\b(f|fd|fre|p)open\(|(^|[^A-Za-z0-9_])::open\()"
                                R"(|\bstbi_(load|info|write_[a-z]+)\(|\b(parse_file|load_file|ReadFile)\()")};
const Pattern kWrites{
    {"stream", "open", "creat", "rename(", "copy_file(", "stbi_", "cairo_", "save_file(", "SaveFile("},
    std::regex(R"(std::(basic_)?o?fstream\b|\b(f|fd|fre|p)open\(|(^|[^A-Za-z0-9_])::open\(|\bopenat\(|\bcreat\()"
               R"(|\b(rename|copy_file)\(|\bstbi_write_(png|jpg|bmp|tga|hdr)\()"
               R"(|\bcairo_(surface_write_to_png|(svg|pdf|ps)_surface_create)\(|\b(save_file|SaveFile)\()")};

TEST(Seams, LibrariesNeitherPrintNorExit) {
  EXPECT_EQ(placesOf(kPrints), kNowhere);
  EXPECT_EQ(placesOf(kExits), kNowhere);
}

TEST(Seams, APrintOrAnExitWouldBeSeen) {
  for (const char* line : {"  std::cout << force;", "std::cerr << name;", "std::clog << 1;", R"(printf("%f", force);)",
                           R"(  std::fprintf(stderr, "no");)", "fputs(text, stdout);", "std::puts(text);",
                           R"(perror("open");)", R"(fmt::print("{}", force);)"}) {
    EXPECT_TRUE(matches(line, kPrints)) << line;
  }
  for (const char* line : {"std::exit(1);", "  exit(2);", "_Exit(1);", "std::quick_exit(0);", "if (bad) std::abort();",
                           "std::terminate();"}) {
    EXPECT_TRUE(matches(line, kExits)) << line;
  }
  EXPECT_FALSE(matches("std::snprintf(text, size, format);", kPrints));
  EXPECT_FALSE(matches("force += more;  // a printf( in a comment", kPrints));
  EXPECT_FALSE(matches("if (!exits(name)) return;", kExits));
}

/// The servo loop, the drain of its samples, the recorder of sessions, the builder of worlds and drivers that wait are
/// threads themselves.
TEST(Seams, ColdWorkAsksOnePlaceForThreads) {
  expectOnlyIn({"base/host_environment.cpp", "device/detail/driver_thread.", "engine/servo_thread.", "engine/recorder.",
                "engine/world_builder.", "servo/loop.", "classroom/station_link.", "classroom/mqtt_link.",
                "classroom/collector."},
               kThreads);
}

/// One place reads whole files, one pieces of them, one writes them.
TEST(Seams, FilesAreOpenedInOnePlace) {
  expectOnlyIn({"base/host_environment.cpp", "base/byte_file.", "base/system/files_posix.cpp"}, kOpens);
  for (const char* line : {"#include <fstream>", "std::ifstream stream(file);", "std::ofstream out(file);",
                           R"(std::FILE* file = std::fopen(name, "rb");)", "stbi_load(file.c_str(), &w, &h, &n, 3);",
                           "stbi_write_png(name, w, h, 3, pixels, 3 * w);", "toml::parse_file(name);"}) {
    EXPECT_TRUE(matches(line, kOpens)) << line;
  }
  EXPECT_FALSE(matches("stbi_load_from_memory(data, size, &w, &h, &n, 3);", kOpens));
}

/// Whatever the product writes appears whole or not at all: through OutputFile. The window's broken state and the
/// folder of a class's removed station are put aside.
TEST(Seams, TheWholeProductWritesFilesInOnePlace) {
  const std::vector<std::string> owners = {"palpate/base/system/files_posix.cpp", "viewer/state/state_file.cpp",
                                           "palpate/classroom/class_folder.cpp"};
  for (const char* house : kFoldersOfHouses) {
    EXPECT_EQ(placesIn(kSourceFolder / house, kWrites, owners), kNowhere) << house;
  }
  for (const char* line :
       {"std::ofstream out(file);", "std::fstream both(file);", R"(std::fopen(name, "w");)", "::open(name, O_WRONLY);",
        "creat(name, 0666);", "fs::rename(a, b);", "std::rename(a, b);", "fs::copy_file(a, b);",
        "stbi_write_png(name, w, h, 3, pixels, 3 * w);", "cairo_surface_write_to_png(surface, name);",
        "cairo_svg_surface_create(name, w, h);", "document.save_file(name);", "scene.SaveFile(name);"}) {
    EXPECT_TRUE(matches(line, kWrites)) << line;
  }
  for (const char* line : {"std::ifstream in(file);", "stbi_write_png_to_func(append, &bytes, w, h, 3, pixels, 3 * w);",
                           "cairo_svg_surface_create_for_stream(append, &bytes, w, h);", "outputs.open(name);"}) {
    EXPECT_FALSE(matches(line, kWrites)) << line;
  }
}

/// Plain dump() throws where a name of a file is no UTF-8, after all the work is done.
TEST(Seams, JsonBecomesTextInOnePlace) {
  const Pattern dumps{{".dump("}, std::regex(R"(\.dump\()")};
  EXPECT_EQ(placesIn(kSourceFolder / "engine/host", dumps, {}).size(), 1u) << "base/json.cpp writes it";
  for (const char* house : kFoldersOfHouses) {
    EXPECT_EQ(placesIn(kSourceFolder / house, dumps, {"palpate/base/json.cpp"}), kNowhere) << house;
  }
}

/// Its templates cost every file that includes it seconds of compile time: all others include base/json.h.
TEST(Seams, OneFileKnowsTheJsonLibrary) {
  const Pattern knows{{"nlohmann"}, std::regex(R"(<nlohmann/|\bnlohmann::)")};
  EXPECT_EQ(placesIn(kSourceFolder / "engine/host", knows, {}).empty(), false) << "base/json.cpp includes it";
  for (const char* house : kFoldersOfHouses) {
    EXPECT_EQ(placesIn(kSourceFolder / house, knows, {"palpate/base/json.cpp"}), kNowhere) << house;
  }
  EXPECT_TRUE(matches("#include <nlohmann/json_fwd.hpp>", knows));
  EXPECT_TRUE(matches("const nlohmann::ordered_json json;", knows));
}

TEST(Seams, NoLibraryKnowsBoost) {
  const Pattern boost{{"boost"}, std::regex("<boost/|boost::")};
  EXPECT_EQ(placesOf(boost), kNowhere);
  EXPECT_TRUE(matches("#include <boost/asio/ip/tcp.hpp>", boost));
}

TEST(Seams, OneFileKnowsAssimp) {
  expectOnlyIn({"mesh/files/read_foreign.cpp"}, {{"ssimp"}, std::regex("<assimp/|Assimp::")});
}

/// Each house declares its own, so that the kit below them knows none.
TEST(Seams, TheKitNamesNoCommand) {
  const Pattern adds{{"add"}, std::regex(R"(\badd\w*(Command|Family)\()")};
  EXPECT_EQ(placesIn(kSourceFolder / "engine/cli/kit", adds, {"options."}), kNowhere) << "options.h has addCommand";
  EXPECT_TRUE(matches("void addRunCommand(Command& app);", adds));
}

/// What a program needs and nobody refers to is installed by a call of its main, which the linker follows by itself.
TEST(Seams, NoLinkerIsToldOfANameThatNobodyUses) {
  const Pattern told{{"undefined=", "-u,"}, std::regex("--undefined=|-Wl,-u,")};
  for (const char* folder : {"engine", "instruments", "cmake", "examples", "tools"}) {
    EXPECT_EQ(placesIn(kSourceFolder / folder, told, {}), kNowhere) << folder;
  }
  EXPECT_TRUE(matches("target_link_options(palpate INTERFACE LINKER:--undefined=palpate_host)", told));
}

TEST(Seams, OneFileKnowsSqlite) {
  expectOnlyIn({"trace/database.cpp"}, {{"sqlite3"}, std::regex("<sqlite3\\.h>|sqlite3_open")});
}

}  // namespace
