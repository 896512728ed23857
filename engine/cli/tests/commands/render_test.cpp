// `palpate render` from the outside: which files it writes, what they hold, and what it refuses.
#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "pictures/read_png.h"
#include "support/expect_each.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;

class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "dome.toml")
        << "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n\n[[finger]]\nname = \"a\"\n"
           "at_mm = [0, 0]\nscript = [{ do = \"press\", depth_mm = 5, seconds = 1 }]\n";
    writeDome();
  }
  CommandResult render(const std::string& arguments) const {
    return support::runPalpate("render dome.toml --supersampling 1 --size 160x120 " + arguments, folder_.path());
  }
  std::string runForError(const std::string& arguments) const {
    const CommandResult result = render(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(!result.err.empty() && result.err.find('\n') == result.err.size() - 1) << "one line: " << result.err;
    return result.err;
  }
  view::Image image(const std::string& name) const { return support::readPng(folder_ / name); }

  support::TemporaryFolder folder_;

 private:
  void writeDome() const {
    std::ofstream dome(folder_ / "dome.obj");
    constexpr int kCells = 20;
    for (int j = 0; j <= kCells; ++j) {
      for (int i = 0; i <= kCells; ++i) {
        const double x = -100.0 + 10.0 * i;
        const double y = -100.0 + 10.0 * j;
        dome << "v " << x << " " << y << " " << 20.0 - 0.001 * (x * x + y * y) << "\n";
      }
    }
    for (int j = 0; j < kCells; ++j) {
      for (int i = 0; i < kCells; ++i) {
        const int a = j * (kCells + 1) + i + 1;
        dome << "f " << a << " " << a + 1 << " " << a + kCells + 2 << " " << a + kCells + 1 << "\n";
      }
    }
  }
};

TEST_F(Render, DrawsTheBodyAtRest) {
  const CommandResult result = render("-o rest.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, 20), "rest.png: 160 x 120,");
  const view::Image picture = image("rest.png");
  EXPECT_EQ(picture.width, 160);
  EXPECT_NE(picture.at(80, 60), picture.at(2, 60)) << "the body stands out from the background";
}

TEST_F(Render, DrawsASceneThatNobodyTouchesAtRestOnly) {
  std::ofstream(folder_ / "alone.toml") << "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n";
  const auto alone = [&](const std::string& arguments) {
    return support::runPalpate("render alone.toml --supersampling 1 --size 160x120 --no-labels " + arguments,
                               folder_.path());
  };
  ASSERT_EQ(alone("-o alone.png").exit_code, 0);
  ASSERT_EQ(render("--no-labels -o rest.png").exit_code, 0);
  EXPECT_EQ(image("alone.png").pixels, image("rest.png").pixels);
  EXPECT_EQ(alone("--pose 0,0,15 -o pressed.png").exit_code, 0);
  EXPECT_EQ(alone("--at 1 -o b.png").err, "palpate: alone.toml: has no [[finger]]; add at least one\n");
}

TEST_F(Render, ShowsTheMomentThatIsAskedFor) {
  ASSERT_EQ(render("--no-labels -o a.png --at 0").exit_code, 0);
  const CommandResult pressed = render("--no-labels -o b.png --at 0.99 --json");
  ASSERT_EQ(pressed.exit_code, 0) << pressed.err;
  const auto finger = nlohmann::json::parse(pressed.out)["pictures"][0]["fingers"][0];
  EXPECT_TRUE(finger["touching"]);
  EXPECT_NEAR(finger["depth_mm"], 5.0, 0.5);
  EXPECT_NE(image("a.png").pixels, image("b.png").pixels);
}

TEST_F(Render, PressesAFingerAtAPose) {
  const CommandResult result = render("--pose 20,0,12,30,0,12 --json -o pose.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto finger = nlohmann::json::parse(result.out)["pictures"][0]["fingers"][0];
  EXPECT_NEAR(finger["depth_mm"], 7.1, 0.4) << "the dome is 19.1 mm high at (30, 0)";
}

TEST_F(Render, WritesASequence) {
  const CommandResult result = render("--at 0.5 --frames 3 --fps 10 -o film.png --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(result.out)["pictures"][2]["time_s"], 0.7);
  EXPECT_NE(image("film_0001.png").pixels, image("film_0003.png").pixels);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.png"));
}

/// A stand-in on a PATH of its own: what a machine has installed must not matter.
class RenderFilm : public Render {
 protected:
  CommandResult film(const std::string& arguments) const {
    const std::string line = "PATH=" + (folder_ / "bin").string() + ":/usr/bin-without-ffmpeg " +
                             support::builtProgram() +
                             " render dome.toml --supersampling 1 --size 160x120 --at 0.5 --fps 10 " + arguments;
    return support::runProgram("/usr/bin/env", line, folder_.path());
  }
  /// Shell lines as ffmpeg. "$last" is the file that it is to write.
  void installFfmpeg(const std::string& lines) const {
    std::filesystem::create_directories(folder_ / "bin");
    const auto file = folder_ / "bin" / "ffmpeg";
    std::ofstream(file) << "#!/bin/sh\nfor last in \"$@\"; do :; done\nlast=\"${last#file:}\"\n" << lines << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  std::size_t filesHere() const {
    const auto entries = std::filesystem::directory_iterator(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }
};

TEST_F(RenderFilm, GivesFfmpegRawPicturesAndAnArgumentList) {
  installFfmpeg("echo \"$@\" >said.txt; /bin/cat >\"$last\"");
  const CommandResult result = film("--frames 3 -o 'a film; $(touch x).mp4' --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["film"], "a film; $(touch x).mp4");
  EXPECT_EQ(std::filesystem::file_size(folder_ / "a film; $(touch x).mp4"), 3u * 160 * 120 * 3) << "three raw pictures";
  const std::string said = support::contentOf(folder_ / "said.txt");
  EXPECT_NE(said.find("-video_size 160x120 -framerate 10 -i pipe:0"), std::string::npos) << said;
  EXPECT_NE(said.find("-f mp4 file:/"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x"));
}

TEST_F(RenderFilm, SaysWhenFfmpegFailsAndKeepsTheFilmThatWasThere) {
  std::ofstream(folder_ / "film.mp4") << "before";
  installFfmpeg("echo 'Unknown encoder' >&2; exit 3");
  const std::size_t before = filesHere();
  const CommandResult failed = film("--frames 3 -o film.mp4");
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_EQ(failed.err, "palpate: film.mp4: ffmpeg failed to write the film (exit code 3): Unknown encoder\n");
  installFfmpeg("/bin/cat >\"$last\"; kill -9 $$");
  const CommandResult killed = film("--frames 3 -o film.mp4");
  EXPECT_EQ(killed.exit_code, 2);
  EXPECT_EQ(killed.err, "palpate: film.mp4: ffmpeg failed to write the film (signal 9)\n");
  // What ffmpeg 5.1 does where the last bytes find no room; seen on a disk of 4 kB.
  installFfmpeg("/bin/cat >\"$last\"; echo 'Error closing file x: No space left on device' >&2");
  const CommandResult cut = film("--frames 3 -o film.mp4");
  EXPECT_EQ(cut.exit_code, 2) << cut.out;
  EXPECT_EQ(cut.err,
            "palpate: film.mp4: ffmpeg failed to write the film (exit code 0): Error closing file x: No space left on "
            "device\n");
  EXPECT_EQ(support::contentOf(folder_ / "film.mp4"), "before");
  EXPECT_EQ(filesHere(), before) << "nothing half done is left";
}

TEST_F(RenderFilm, SaysBeforeTheWorkWhatNeedsFfmpegAndWhatDoesNot) {
  const std::size_t before = filesHere();
  const CommandResult result = film("--frames 3 -o film.mp4");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err,
            "palpate: film.mp4: MP4 requires ffmpeg, which is not installed; film.webm and film.gif do not\n");
  EXPECT_EQ(filesHere(), before);
}

TEST_F(RenderFilm, NeedsNothingElseForWebmAndGif) {
  const auto beginning = [&](const char* name) { return support::contentOf(folder_ / name).substr(0, 6); };
  const CommandResult result = film("--frames 3 -o film.webm --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["film"], "film.webm");
  EXPECT_EQ(beginning("film.webm").substr(0, 4), "\x1A\x45\xDF\xA3");
  ASSERT_EQ(film("--frames 3 -o film.gif").exit_code, 0);
  EXPECT_EQ(beginning("film.gif"), "GIF89a");
  EXPECT_EQ(runForError("--frames 3 --fps 60 -o fast.gif"),
            "palpate: fast.gif: a GIF shows at most 50 pictures a second; .webm shows more\n");
}

TEST_F(Render, IsTheSamePictureEveryTime) {
  ASSERT_EQ(render("--at 0.8 --show strain,wireframe -o a.png").exit_code, 0);
  ASSERT_EQ(render("--at 0.8 --show strain,wireframe -o b.png").exit_code, 0);
  EXPECT_EQ(image("a.png").pixels, image("b.png").pixels);
}

TEST_F(Render, SaysWhatStereoCannotDo) {
  const CommandResult result = render("--stereo quad-buffer -o quad.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("quad-buffer stereo is not offered here"), std::string::npos);
}

/// A body with names.
class RenderOfATorso : public Render {
 protected:
  void SetUp() override { std::ofstream(folder_ / "torso.toml") << "[body]\nkind = \"torso\"\ntriangles = 8163\n"; }
  CommandResult ofTorso(const std::string& arguments) const {
    return support::runPalpate("render torso.toml --no-labels --supersampling 1 --size 480x320 " + arguments,
                               folder_.path());
  }
};

TEST_F(RenderOfATorso, WearsItsTextureAsTheSceneSaysUnlessAFlagDoes) {
  std::ofstream(folder_ / "torso.toml") << "[body]\nkind = \"torso\"\ntriangles = 8163\ntexture = \"made:3\"\n";
  ASSERT_EQ(ofTorso("-o worn.png").exit_code, 0);
  ASSERT_EQ(ofTorso("--texture -o asked.png").exit_code, 0);
  ASSERT_EQ(ofTorso("--no-texture -o bare.png").exit_code, 0);
  EXPECT_EQ(image("worn.png").pixels, image("asked.png").pixels);
  EXPECT_NE(image("worn.png").pixels, image("bare.png").pixels);
  std::ofstream(folder_ / "torso.toml", std::ios::app) << "[view]\ntexture = false\n";
  ASSERT_EQ(ofTorso("-o off.png").exit_code, 0);
  ASSERT_EQ(ofTorso("--texture -o on.png").exit_code, 0);
  EXPECT_EQ(image("off.png").pixels, image("bare.png").pixels);
  EXPECT_EQ(image("on.png").pixels, image("worn.png").pixels);
}

TEST_F(RenderOfATorso, HasNoMusclesAndSaysSoInOneLine) {
  const CommandResult refused = ofTorso("--muscles -o muscles.png");
  EXPECT_EQ(refused.exit_code, 2);
  // On a slow machine the body's progress stands before it.
  EXPECT_TRUE(refused.err.ends_with(
      "palpate: --muscles: this body lacks places that its muscles are drawn between; the built-in trunk has them\n"))
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "muscles.png"));
  const CommandResult noted = ofTorso("--show muscles -o noted.png");
  EXPECT_EQ(noted.exit_code, 0);
  EXPECT_NE(noted.out.find("note: this body lacks places that its muscles"), std::string::npos) << noted.out;
}

TEST_F(RenderOfATorso, TurnsToAPlaceByItsName) {
  ASSERT_EQ(ofTorso("--zoom 3 --look-at T6 -o a.png").exit_code, 0);
  ASSERT_EQ(ofTorso("--zoom 3 --look-at 't6 right 60 mm' -o b.png").exit_code, 0);
  ASSERT_EQ(ofTorso("--zoom 3 --look-at 'T6 right 30 right 30' -o c.png").exit_code, 0);
  EXPECT_NE(image("a.png").pixels, image("b.png").pixels);
  EXPECT_EQ(image("b.png").pixels, image("c.png").pixels);
  const CommandResult unknown = ofTorso("--look-at T66 -o d.png");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("palpate: --look-at: unknown place 'T66'; did you mean 'T6'?"), std::string::npos)
      << unknown.err;
}

TEST_F(RenderOfATorso, PressesPlacesByTheirNames) {
  const auto depth = [&](const std::string& pose) -> double {
    const CommandResult result = ofTorso("--pose " + pose + " --json -o pose.png");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["pictures"][0]["fingers"][0]["depth_mm"];
  };
  EXPECT_NEAR(depth("T6"), 6.0, 0.6);
  EXPECT_NEAR(depth("'T6; T6 right 30 mm'"), 6.0, 1.5) << "on a slope, after a drag";
  EXPECT_EQ(ofTorso("--pose 'T6; nowhere' -o x.png").exit_code, 2);
}

TEST_F(RenderOfATorso, ShowsItsNames) {
  ASSERT_EQ(ofTorso("-o plain.png").exit_code, 0);
  const CommandResult named = ofTorso("--show names -o named.png");
  ASSERT_EQ(named.exit_code, 0) << named.err;
  EXPECT_EQ(named.out.find("named places"), std::string::npos);
  EXPECT_NE(image("plain.png").pixels, image("named.png").pixels);
}

TEST_F(Render, SaysWhereABodyHasNoNames) {
  EXPECT_NE(render("--show names -o dome.png").out.find("note: this body has no named places"), std::string::npos);
}

TEST_F(Render, DrawsTheTrunkInTheBuildAndPostureAskedFor) {
  const auto trunk = [&](const std::string& arguments, const std::string& file) {
    const CommandResult result = support::runPalpate(
        "render trunk.toml --no-labels --supersampling 1 --size 160x120 " + arguments + " -o " + file, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return image(file).pixels;
  };
  const auto named = [&](const std::string& keys, const std::string& file) {
    std::ofstream(folder_ / file) << "[body]\ntriangles = 8000\n" << keys;
  };
  named("", "trunk.toml");
  const auto standing = trunk("", "standing.png");
  EXPECT_NE(trunk("--view below", "below.png"), standing);
  const auto thin_sitting = trunk("--build thin --posture sitting", "a.png");
  EXPECT_NE(thin_sitting, standing);
  named(
      "body_mass_index = 18\nmuscle = 0.6\ngirth = 0.92\nspine_relief = 1.6\nrib_relief = 1.6\nposture = \"sitting\"\n",
      "trunk.toml");
  EXPECT_EQ(trunk("", "b.png"), thin_sitting) << "as examples/scenes/thin.toml has it";
  EXPECT_EQ(trunk("--build average --posture standing", "c.png"), standing);
  EXPECT_EQ(runForError("--build thin"), "palpate: --build and --posture need the trunk; this body is of kind mesh\n");
  EXPECT_EQ(runForError("--build thinn"),
            "palpate: --build: 'thinn' is not one of average|thin|heavy; did you mean 'thin'? (see --help)\n");
}

TEST_F(Render, RefusesWithOneLine) {
  EXPECT_EQ(runForError("-o picture.jpg"),
            "palpate: picture.jpg: must be named *.png for pictures, or *.webm, *.gif or *.mp4 for films\n");
  support::expectEach([&](const std::string& options) { return runForError(options); },
                      {{"-o film.mp4", "palpate: film.mp4: a film requires --frames above 1\n"},
                       {"--at 7", "palpate: 7 s is outside the run, which lasts from 0 to 1.000 s\n"},
                       {"--pose 1,2", "palpate: --pose: expected x,y,z, or several of them (see --help)\n"},
                       {"--pose 1,2,x", "palpate: --pose: 'x' is not a number (-100,000 to 100,000 mm) (see --help)\n"},
                       {"--look-at 1,2", "palpate: --look-at: '1,2' must be three numbers x,y,z in mm (see --help)\n"},
                       {"--show wirefame", "palpate: --show: unknown word 'wirefame'; did you mean 'wireframe'?\n"}});
  EXPECT_NE(runForError("--stereo 3d").find("--stereo"), std::string::npos);
  EXPECT_EQ(runForError("--at nan"), "palpate: --at: 'nan' is not a finite number (0 to 10,800 s) (see --help)\n");
  EXPECT_EQ(runForError("--at -5"), "palpate: --at: -5 is out of range: 0 to 10,800 s (see --help)\n");
  EXPECT_EQ(support::runPalpate("render dome.toml --size 12x0", folder_.path()).err,
            "palpate: --size: 0 is out of range: 1 to 16,384 pixels (see --help)\n");
  EXPECT_NE(runForError("-o /dev/null/a.png").find("/dev/null/a.png"), std::string::npos);
}

}  // namespace
}  // namespace palpate
