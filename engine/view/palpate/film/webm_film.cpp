// WebM through libvpx: VP9 of constant quality. Compressed pictures stay in memory until the end, because the index
// comes before the pictures and an OutputFile only grows.
#include <fmt/format.h>
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "palpate/film/film.h"
#include "palpate/film/webm_container.h"

namespace palpate::film {

namespace {

constexpr std::size_t kMaxCompressedBytes = std::size_t{1} << 30;
constexpr int kQuality = 22;         ///< 0 (no loss) to 63: no visible loss
constexpr unsigned kKeyEvery = 100;  ///< pictures; how near to a moment a player can jump
constexpr int kCarefulSpeed = 4;     ///< libvpx's speed, 0 to 9
constexpr int kLiveSpeed = 8;
constexpr unsigned kThreads = 2;  ///< for the encoder itself; the others are for drawing

struct Planes {
  vpx_image_t& image;
  std::uint8_t* row(int plane, int y) const { return image.planes[plane] + std::ptrdiff_t{y} * image.stride[plane]; }
};

std::uint8_t rounded(double value) { return static_cast<std::uint8_t>(value + 0.5); }

// BT.709 in its limited range.

std::uint8_t luma(const view::Pixel& p) { return rounded(16.0 + 0.18259 * p[0] + 0.61423 * p[1] + 0.06201 * p[2]); }

/// The mean of the pixels that share a sample of colour: two by two, fewer at an odd edge.
view::Pixel meanAt(const view::Image& picture, int x, int y) {
  const int right = std::min(x + 1, picture.width - 1);
  const int below = std::min(y + 1, picture.height - 1);
  view::Pixel mean;
  for (std::size_t c = 0; c < mean.size(); ++c) {
    const int sum =
        picture.at(x, y)[c] + picture.at(right, y)[c] + picture.at(x, below)[c] + picture.at(right, below)[c];
    mean[c] = static_cast<std::uint8_t>((sum + 2) / 4);
  }
  return mean;
}

void fill(const Planes& planes, const view::Image& picture) {
  for (int y = 0; y < picture.height; ++y) {
    std::uint8_t* light = planes.row(VPX_PLANE_Y, y);
    for (int x = 0; x < picture.width; ++x) light[x] = luma(picture.at(x, y));
  }
  for (int y = 0; y < picture.height; y += 2) {
    std::uint8_t* blue = planes.row(VPX_PLANE_U, y / 2);
    std::uint8_t* red = planes.row(VPX_PLANE_V, y / 2);
    for (int x = 0; x < picture.width; x += 2) {
      const view::Pixel p = meanAt(picture, x, y);
      blue[x / 2] = rounded(128.0 - 0.10064 * p[0] - 0.33857 * p[1] + 0.43922 * p[2]);
      red[x / 2] = rounded(128.0 + 0.43922 * p[0] - 0.39894 * p[1] - 0.04027 * p[2]);
    }
  }
}

struct FreeImage {
  void operator()(vpx_image_t* image) const { vpx_img_free(image); }
};

class WebmFilm final : public Film {
 public:
  WebmFilm(std::filesystem::path file, const FilmFormat& format) : Film(std::move(file), format) {
    image_.reset(vpx_img_alloc(nullptr, VPX_IMG_FMT_I420, static_cast<unsigned>(format.size.width),
                               static_cast<unsigned>(format.size.height), 16));
    if (!image_) fail("there is not enough memory for its pictures");
    vpx_codec_enc_cfg_t settings;
    check(vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &settings, 0));
    settings.g_w = static_cast<unsigned>(format.size.width);
    settings.g_h = static_cast<unsigned>(format.size.height);
    settings.g_timebase = {1, 1000};
    settings.g_threads = kThreads;
    settings.rc_end_usage = VPX_Q;
    settings.kf_max_dist = kKeyEvery;
    if (isLive()) settings.g_lag_in_frames = 0;
    check(vpx_codec_enc_init(&codec_, vpx_codec_vp9_cx(), &settings, 0));
    begun_ = true;
    control(VP8E_SET_CPUUSED, isLive() ? kLiveSpeed : kCarefulSpeed);
    control(VP8E_SET_CQ_LEVEL, kQuality);
    control(VP9E_SET_ROW_MT, 1);
    control(VP9E_SET_COLOR_SPACE, VPX_CS_BT_709);
  }
  ~WebmFilm() override {
    if (begun_) vpx_codec_destroy(&codec_);
  }

 protected:
  void compress(const view::Image& picture, const Shown& shown) override {
    fill({*image_}, picture);
    feed(image_.get(), shown);
    length_ms_ = shown.until_ms;
    if (container_.bytes() > kMaxCompressedBytes) fail("a film holds at most 1 GiB");
  }

  void end() override {
    while (feed(nullptr, {length_ms_, length_ms_ + 1})) {
    }
    for (const std::string& piece : container_.pieces(format_.size, length_ms_)) output_.write(piece);
  }

 private:
  bool isLive() const { return format_.effort == Effort::live; }
  template <class Value>
  void control(vp8e_enc_control_id which, Value value) {
    check(vpx_codec_control_(&codec_, which, value));
  }
  void check(vpx_codec_err_t result) const {
    if (result != VPX_CODEC_OK) fail(fmt::format("libvpx cannot write it: {}", vpx_codec_err_to_string(result)));
  }

  /// Whether the encoder returned data. It holds some pictures back to look ahead; without an image it releases them.
  bool feed(const vpx_image_t* image, const Shown& shown) {
    check(vpx_codec_encode(&codec_, image, shown.from_ms, static_cast<unsigned long>(shown.until_ms - shown.from_ms), 0,
                           isLive() ? VPX_DL_REALTIME : VPX_DL_GOOD_QUALITY));
    bool came = false;
    vpx_codec_iter_t at = nullptr;
    while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&codec_, &at)) {
      if (packet->kind != VPX_CODEC_CX_FRAME_PKT) continue;
      const auto& frame = packet->data.frame;
      container_.add({static_cast<const char*>(frame.buf), frame.sz}, frame.pts, (frame.flags & VPX_FRAME_IS_KEY) != 0);
      came = true;
    }
    return came;
  }

  std::unique_ptr<vpx_image_t, FreeImage> image_;
  vpx_codec_ctx_t codec_{};
  bool begun_ = false;
  WebmContainer container_;
  std::int64_t length_ms_ = 0;
};

}  // namespace

std::unique_ptr<Film> beginWebm(const std::filesystem::path& file, const FilmFormat& format) {
  return std::make_unique<WebmFilm>(file, format);
}

}  // namespace palpate::film
