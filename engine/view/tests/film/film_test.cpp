// Films read back by code that shares nothing with what wrote them: WebM's container by libwebm, its pictures by
// libvpx's decoder, GIF by stb.
#include "palpate/film/film.h"

#include <gtest/gtest.h>
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_GIF
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>
#include <webm/buffer_reader.h>
#include <webm/webm_parser.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

#include "palpate/base/error.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::film {
namespace {

constexpr view::ImageSize kSize{75, 42};  // an odd width: half a sample of colour at the edge
constexpr int kPictures = 12;
constexpr double kFramesPerS = 20.0;

/// Skin with a darker square that moves to the right, so that the order of the pictures can be seen.
view::Image makePicture(int number) {
  view::Image image(kSize.width, kSize.height, {214, 168, 140});
  for (int y = 10; y < 30; ++y) {
    for (int x = 5 * number; x < 5 * number + 15; ++x) image.at(x, y) = {60, 90, 160};
  }
  return image;
}

void expectNear(const view::Pixel& got, const view::Pixel& wanted, const std::string& where) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], 10) << where << ", channel " << c;
}

/// A place of the square, one of the skin.
void expectThePicture(const view::Image& image, int number) {
  const std::string where = "picture " + std::to_string(number);
  ASSERT_EQ(image.width, kSize.width);
  ASSERT_EQ(image.height, kSize.height);
  expectNear(image.at(5 * number + 7, 20), {60, 90, 160}, where + ", square");
  expectNear(image.at((5 * number + 40) % 75, 20), {214, 168, 140}, where + ", skin beside it");
  expectNear(image.at(40, 36), {214, 168, 140}, where + ", skin");
}

view::Pixel rgbOf(double y, double u, double v) {
  const double light = 1.16438 * (y - 16.0);
  const auto clamped = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
  return {clamped(light + 1.79274 * (v - 128.0)), clamped(light - 0.21325 * (u - 128.0) - 0.53291 * (v - 128.0)),
          clamped(light + 2.11240 * (u - 128.0))};
}

class Vp9Decoder {
 public:
  Vp9Decoder() { EXPECT_EQ(vpx_codec_dec_init(&codec_, vpx_codec_vp9_dx(), nullptr, 0), VPX_CODEC_OK); }
  ~Vp9Decoder() { vpx_codec_destroy(&codec_); }
  std::optional<view::Image> decode(const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(vpx_codec_decode(&codec_, bytes.data(), static_cast<unsigned>(bytes.size()), nullptr, 0), VPX_CODEC_OK);
    vpx_codec_iter_t at = nullptr;
    const vpx_image_t* frame = vpx_codec_get_frame(&codec_, &at);
    if (frame == nullptr) return std::nullopt;
    EXPECT_EQ(frame->cs, VPX_CS_BT_709);
    view::Image image(static_cast<int>(frame->d_w), static_cast<int>(frame->d_h));
    const auto sample = [&](int plane, int x, int y) { return frame->planes[plane][y * frame->stride[plane] + x]; };
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        image.at(x, y) = rgbOf(sample(0, x, y), sample(1, x / 2, y / 2), sample(2, x / 2, y / 2));
      }
    }
    return image;
  }

 private:
  vpx_codec_ctx_t codec_{};
};

/// What a player learns from the container.
class ReadWebm : public webm::Callback {
 public:
  explicit ReadWebm(const std::string& bytes) {
    webm::BufferReader reader(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    webm::WebmParser parser;
    EXPECT_TRUE(parser.Feed(this, &reader).completed_ok());
  }
  webm::Status OnEbml(const webm::ElementMetadata&, const webm::Ebml& ebml) override {
    EXPECT_EQ(ebml.doc_type.value(), "webm");
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnInfo(const webm::ElementMetadata&, const webm::Info& info) override {
    duration_ms = info.duration.value();
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSegmentBegin(const webm::ElementMetadata& metadata, webm::Action* action) override {
    *action = webm::Action::kRead;
    segment_at = metadata.position + metadata.header_size;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSeek(const webm::ElementMetadata&, const webm::Seek& seek) override {
    sought[seek.id.value()] = segment_at + seek.position.value();
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnElementBegin(const webm::ElementMetadata& metadata, webm::Action* action) override {
    *action = webm::Action::kRead;
    found.insert({metadata.id, metadata.position});
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnTrackEntry(const webm::ElementMetadata&, const webm::TrackEntry& track) override {
    codec = track.codec_id.value();
    EXPECT_EQ(track.video.value().pixel_width.value(), static_cast<std::uint64_t>(kSize.width));
    EXPECT_EQ(track.video.value().colour.value().matrix_coefficients.value(), webm::MatrixCoefficients::kBt709);
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnCuePoint(const webm::ElementMetadata&, const webm::CuePoint& point) override {
    cues.push_back({point.time.value(), segment_at + point.cue_track_positions.at(0).value().cluster_position.value()});
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnClusterBegin(const webm::ElementMetadata& metadata, const webm::Cluster& cluster,
                              webm::Action* action) override {
    *action = webm::Action::kRead;
    cluster_ms_ = cluster.timecode.value();
    clusters.push_back({cluster_ms_, metadata.position});
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSimpleBlockBegin(const webm::ElementMetadata&, const webm::SimpleBlock& block,
                                  webm::Action* action) override {
    *action = webm::Action::kRead;
    moments_ms.push_back(cluster_ms_ + static_cast<std::uint64_t>(block.timecode));
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnFrame(const webm::FrameMetadata&, webm::Reader* reader, std::uint64_t* left) override {
    std::vector<std::uint8_t> bytes(*left);
    std::uint64_t count = 0;
    const webm::Status status = reader->Read(bytes.size(), bytes.data(), &count);
    *left -= count;
    packets.push_back(std::move(bytes));
    return status;
  }

  using Placed = std::pair<std::uint64_t, std::uint64_t>;
  double duration_ms = 0.0;
  std::uint64_t segment_at = 0;
  std::map<webm::Id, std::uint64_t> sought, found;
  std::string codec;
  std::vector<Placed> cues, clusters;  ///< ms, place in the file
  std::vector<std::uint64_t> moments_ms;
  std::vector<std::vector<std::uint8_t>> packets;

 private:
  std::uint64_t cluster_ms_ = 0;
};

class Films : public testing::Test {
 protected:
  void write(const char* name, Effort effort = Effort::careful, int pictures = kPictures) const {
    const auto film = beginFilm(folder_ / name, {kSize, kFramesPerS, effort});
    for (int i = 0; i < pictures; ++i) film->add(makePicture(i % kPictures), 3.0 + i / kFramesPerS);
    EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << "it appears whole";
    film->finish();
  }
  void expectThePicturesOf(const ReadWebm& film) const {
    Vp9Decoder decoder;
    for (std::size_t i = 0; i < film.packets.size(); ++i) {
      const auto image = decoder.decode(film.packets[i]);
      ASSERT_TRUE(image) << i;
      expectThePicture(*image, static_cast<int>(i) % kPictures);
      EXPECT_EQ(film.moments_ms[i], 50 * i);
    }
  }
  std::string filmError(const char* name, const FilmFormat& format) const {
    try {
      beginFilm(folder_ / name, format);
    } catch (const Error& error) {
      return std::string(error.cause());
    }
    return "none";
  }
  std::size_t filesHere() const {
    const auto entries = std::filesystem::directory_iterator(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }

  support::TemporaryFolder folder_;
};

TEST_F(Films, AWebmHoldsEveryPictureAtItsMoment) {
  for (const Effort effort : {Effort::careful, Effort::live}) {
    const char* name = effort == Effort::live ? "live.webm" : "careful.webm";
    write(name, effort);
    const ReadWebm film(support::contentOf(folder_ / name));
    EXPECT_EQ(film.codec, "V_VP9");
    EXPECT_DOUBLE_EQ(film.duration_ms, 600.0);
    ASSERT_EQ(film.packets.size(), std::size_t{kPictures});
    expectThePicturesOf(film);
  }
}

TEST_F(Films, AWebmIsIndexedSoThatOneCanJumpInIt) {
  write("long.webm", Effort::live, 240);
  const ReadWebm film(support::contentOf(folder_ / "long.webm"));
  EXPECT_EQ(film.packets.size(), 240u);
  EXPECT_GE(film.clusters.size(), 3u);
  EXPECT_EQ(film.cues, film.clusters);
  ASSERT_EQ(film.sought.size(), 3u);
  for (const auto& [id, position] : film.sought) EXPECT_EQ(film.found.at(id), position);
  expectThePicturesOf(film);
}

TEST_F(Films, AGifHoldsEveryPictureAndItsTime) {
  write("film.gif");
  const std::string bytes = support::contentOf(folder_ / "film.gif");
  int width = 0;
  int height = 0;
  int count = 0;
  int channels = 0;
  int* delays = nullptr;
  stbi_uc* pixels =
      stbi_load_gif_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &delays,
                                &width, &height, &count, &channels, 4);
  ASSERT_NE(pixels, nullptr);
  ASSERT_EQ(count, kPictures);
  for (int i = 0; i < count; ++i) {
    view::Image image(width, height);
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
      const stbi_uc* p = pixels + 4 * (static_cast<std::size_t>(i) * image.pixels.size() + k);
      image.pixels[k] = {p[0], p[1], p[2]};
    }
    expectThePicture(image, i);
    EXPECT_EQ(delays[i], 50);
  }
  std::free(pixels);
  std::free(delays);
}

TEST_F(Films, ABodyAtRestCostsAGifNothing) {
  const auto film = beginFilm(folder_ / "still.gif", {kSize, kFramesPerS});
  film->add(makePicture(3), 0.0);
  for (int i = 1; i < 100; ++i) film->add(makePicture(3), i / kFramesPerS);
  film->finish();
  write("moving.gif");
  EXPECT_LT(std::filesystem::file_size(folder_ / "still.gif"), 8000u) << "99 pictures of one pixel";
}

TEST_F(Films, WithoutAnEndLeaveNothing) {
  std::ofstream(folder_ / "kept.webm") << "before";
  for (const char* name : {"kept.webm", "new.gif"}) {
    const auto film = beginFilm(folder_ / name, {kSize, kFramesPerS});
    film->add(makePicture(0), 0.0);
  }
  EXPECT_EQ(support::contentOf(folder_ / "kept.webm"), "before");
  EXPECT_EQ(filesHere(), 1u);
}

TEST_F(Films, SayWhatTheyCannotBe) {
  EXPECT_EQ(filmError("film.avi", {kSize}), "a film must be named *.webm or *.gif");
  EXPECT_EQ(filmError("film.gif", {kSize, 60.0}), "a GIF shows at most 50 pictures a second; .webm shows more");
  EXPECT_EQ(filmError("film.webm", {{16384, 10}}), "a film's pictures are at most 16383 pixels wide and high");
  EXPECT_EQ(filmError("/dev/null/film.webm", {kSize}), "cannot be written: Not a directory");
  const auto film = beginFilm(folder_ / "film.webm", {kSize});
  EXPECT_THROW(film->add(view::Image(10, 10), 0.0), Error);
  EXPECT_THROW(film->finish(), Error) << "no picture";
}

}  // namespace
}  // namespace palpate::film
