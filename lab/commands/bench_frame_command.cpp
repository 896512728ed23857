// `palpate study bench frame`: how long a picture takes, from the contact to the last pixel.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/kit/commands.h"
#include "cli/kit/number_option.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/frame_run.h"
#include "palpate/base/words.h"

namespace palpate::app {
namespace {

nlohmann::ordered_json jsonOf(const FrameFigures& f) {
  nlohmann::ordered_json json;
  json["triangles"] = f.triangles;
  json["bone_triangles"] = f.bone_triangles;
  json["renderer"] = f.renderer;
  json["deform_ms"] = f.deform_ms;
  json["upload_ms"] = f.upload_ms;
  json["draw_ms"] = f.draw_ms;
  json["frame_ms"] = f.frameMs();
  json["fps"] = f.fps;
  json["uploaded_vertices"] = f.uploaded_vertices;
  json["covered"] = f.covered;
  json["first_frame_ms"] = f.first_frame_ms;
  return json;
}

std::string textOf(const FrameFigures& f) {
  std::string text = fmt::format("triangles      {} of the skin, {} of bones\n", f.triangles, f.bone_triangles);
  text += fmt::format("drawn by       {}\n", f.renderer);
  text += fmt::format("deform         {:.3f} ms\n", f.deform_ms);
  text += fmt::format("upload         {:.3f} ms, {:.0f} vertices\n", f.upload_ms, f.uploaded_vertices);
  text += fmt::format("draw           {:.2f} ms, skin on {:.0f} % of the picture\n", f.draw_ms, 100.0 * f.covered);
  text += fmt::format("pictures       {:.1f} a second\n", f.fps);
  return text + fmt::format("first picture  {:.0f} ms after the world was built\n", f.first_frame_ms);
}

}  // namespace

void addBenchFrameCommand(CLI::App& parent) {
  struct Arguments {
    FrameRun run;
    std::string stereo{wordFor(view::StereoMode::mono)};
    bool no_labels = false;
    bool peers = false;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  FrameRun& run = arguments->run;
  CLI::App& command =
      *parent.add_subcommand("frame", "Time pictures without a window: deformation, upload and drawing");
  addNumber(command, "--triangles", run.triangles, between(1000, 4e6),
            "Triangles of the skin; 18,296 of bones come on top")
      ->capture_default_str();
  command.add_flag("--trunk", run.trunk, "On the closed trunk (an even number of triangles) instead of the torso");
  std::map<std::string, view::Shading> shadings{{"pbr", view::Shading::skin}};
  for (const auto& [word, shading] : WordsOf<view::Shading>::kAll) shadings.emplace(word, shading);
  command.add_option("--shading", run.shading, "gouraud, or skin (also called pbr)")
      ->transform(CLI::CheckedTransformer(shadings));
  command.add_option("--stereo", arguments->stereo, "Stereo mode: mono, sbs-half, sbs-full, anaglyph-dubois, ...")
      ->capture_default_str();
  addNumber(command, "--width", run.width, between(16, 8192, "pixels"), "Width of the picture")->capture_default_str();
  addNumber(command, "--height", run.height, between(16, 8192, "pixels"), "Height")->capture_default_str();
  addNumber(command, "--skin-opacity", run.skin_opacity, between(0.0, 1.0), "Below 1 the bones show through")
      ->capture_default_str();
  addNumber(command, "--seconds", run.seconds, between(0.0, 600.0, "s"),
            "How long to repeat; the best picture of each place counts")
      ->capture_default_str();
  command.add_flag("--close", run.close, "From near by: 100 mm of the body from the lower to the upper edge");
  command.add_flag("--cull,!--no-cull", run.cull, "Leave out skin that is outside the picture (default)");
  command.add_flag("--no-labels", arguments->no_labels, "Without scale, orientation and numbers");
  command.add_flag("--peers", arguments->peers, "As in the other benchmarks; no other library draws this picture");
  command.add_flag("--json", arguments->json, "Print one JSON object");
  command.callback([arguments] {
    arguments->run.stereo = view::stereoModeNamed(arguments->stereo);
    arguments->run.labels = !arguments->no_labels;
    const FrameFigures figures = measureFrames(arguments->run);
    nlohmann::ordered_json json = jsonOf(figures);
    std::string text = textOf(figures);
    if (arguments->peers) {
      json["peers"] = nlohmann::ordered_json::object();
      text += "peers          none: no other library draws this picture\n";
    }
    printReport(json, text, arguments->json);
  });
}

}  // namespace palpate::app
