// `palpate tissue library`: the solved stacks that a body's places are blended from; and how they are solved again,
// with the drags that photographs are fitted by.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/kit/number_option.h"
#include "cli/kit/output_place.h"
#include "cli/kit/progress_line.h"
#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/output_file.h"
#include "palpate/elements/drag_solver.h"
#include "palpate/elements/finger_solver.h"
#include "palpate/elements/stack_solver.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/solved_drag.h"
#include "solve/commands/commands.h"

namespace palpate::app {

namespace {

using tissue::LayeredNode;

struct LibraryArguments {
  std::string output;
  double fat_mm = 8.0;
  double finger_mm = tissue::kFingertipMm;
  bool solve = false;
  bool fingers = false;
  bool drag = false;
  bool field = false;
  bool json = false;
};

const std::vector<double> kThicknessesMm = {9, 12, 16, 22, 30, 40, 50, 62};
const std::vector<double> kFatShares = {0.1, 0.25, 0.45, 0.7};
const std::vector<double> kDepthsMm = {0.5, 1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12};
/// The sphere stays this far from the bone, as a share of the thickness.
constexpr double kClosestToBone = 0.1;

std::string numberRow(const std::vector<double>& numbers) { return fmt::format("{:.6g}\n", fmt::join(numbers, ", ")); }

/// A table as cmake/PalpateNumbers.cmake reads it.
std::string numberTable(std::string_view type_and_name, std::string_view rows) {
  return fmt::format("\n{}\n{}", type_and_name, rows);
}

std::vector<double> depthsOver(double thickness_mm) {
  std::vector<double> depths = kDepthsMm;
  std::erase_if(depths, [&](double depth) { return depth > (1.0 - kClosestToBone) * thickness_mm; });
  return depths;
}

LayeredNode solvedNode(double thickness_mm, double share, const Progress& progress) {
  const tissue::LayerStack stack = tissue::libraryStack(thickness_mm, share);
  elements::StackSettings settings;
  settings.press.depths_mm = depthsOver(thickness_mm);
  const elements::PressSolution solution = elements::solveStack(stack, settings, progress).press;
  if (solution.table.shapes.empty())
    throw Error(fmt::format("{} mm with {} of fat: {}", thickness_mm, share, solution.stopped_by));
  if (!solution.stopped_by.empty())
    say(fmt::format("{} mm with {} of fat: solved to {:.2f} mm: {}\n", thickness_mm, share, solution.converged_to_mm,
                    solution.stopped_by));
  return tissue::nodeOf(solution.table);
}

/// Visits the stacks, thickness by thickness, share by share; `part` is the progress of one.
void forEachStack(const Progress& progress, const char* stage,
                  const std::function<void(double thickness_mm, double share, const Progress& part)>& visit) {
  const auto count = static_cast<double>(kThicknessesMm.size() * kFatShares.size());
  double done = 0.0;
  for (const double thickness : kThicknessesMm) {
    for (const double share : kFatShares) {
      const Progress part = [&](std::string_view, double of_stack) {
        report(progress, stage, (done + of_stack) / count);
      };
      report(part, stage, 0.0);
      visit(thickness, share, part);
      done += 1.0;
    }
  }
}

std::string libraryText(const Progress& progress) {
  std::string rows;
  forEachStack(progress, "solving the library", [&](double thickness, double share, const Progress& part) {
    rows += numberRow(tissue::libraryNumbers(solvedNode(thickness, share, part)));
  });
  return "# Made by `palpate tissue library --solve`; layered_library.cpp says what stands where.\n" +
         numberTable("double[] kThicknessesMm", numberRow(kThicknessesMm)) +
         numberTable("double[] kFatShares", numberRow(kFatShares)) + numberTable("double[] kNodes", rows);
}

/// The forces of other fingers as the shipped file has them: how many of the depths were reached, and the force there.
std::string fingersText(const Progress& progress) {
  std::vector<double> radii;
  std::string rows;
  forEachStack(progress, "solving the fingers", [&](double thickness, double share, const Progress&) {
    elements::PressSettings press;
    press.depths_mm = depthsOver(thickness);
    radii.clear();
    for (const tissue::FingerForces& finger : elements::solveFingers(tissue::libraryStack(thickness, share), press)) {
      std::vector<double> numbers = {0.0};
      for (std::size_t d = 0; d < finger.depths_mm.size() && finger.depths_mm[d] == kDepthsMm[d]; ++d) {
        numbers.push_back(finger.force_n[d]);
      }
      numbers.front() = static_cast<double>(numbers.size() - 1);
      rows += numberRow(numbers);
      radii.push_back(finger.radius_mm);
    }
  });
  return "# Made by `palpate tissue library --solve --fingers`; layered_library.cpp says what stands where.\n" +
         numberTable("double[] kFingerRadiiMm", numberRow(radii)) +
         numberTable("double[] kFingerDepthsMm", numberRow(kDepthsMm)) + numberTable("double[] kFingerForces", rows);
}

/// Shares of the drag at the table's distances, 4 digits.
std::string dragCurve(const std::function<double(double mm)>& moved) {
  std::vector<double> shares;
  for (std::size_t i = 0; i < tissue::kSolvedKnots; ++i)
    shares.push_back(std::round(1e4 * moved(tissue::solvedKnotMm(i))) * 1e-4 + 0.0);
  return fmt::format("{:.4g}\n", fmt::join(shares, ", "));
}

std::string dragText(const Progress& progress) {
  std::string rows;
  for (std::size_t i = 0; i < tissue::kSolvedStacks.size(); ++i) {
    report(progress, "dragging layers", static_cast<double>(i) / static_cast<double>(tissue::kSolvedStacks.size()));
    const tissue::SolvedStack& s = tissue::kSolvedStacks[i];
    const elements::DragField field = elements::solveDragField(
        {.layers = {{"skin", 2.0, s.skin_kpa}, {"fat", s.fat_mm, 10.0}, {"muscle", s.muscle_mm, 27.0}}},
        {.patch_radius_mm = tissue::kSolvedPatchMm});
    rows += dragCurve([&](double mm) { return field.movedAt({mm, 0.0}).x(); });
    rows += dragCurve([&](double mm) { return field.movedAt({0.0, mm}).x(); });
  }
  return "# Made by `palpate tissue library --solve --drag`: along the drag and across it, stack by stack "
         "(solved_drag.h).\n" +
         numberTable("Curve[] kCurves", rows);
}

/// Fourth roots of a row in steps of a 4,095th of the greatest, two characters each (library_fields.cpp reads them).
std::string packedRow(std::span<const float> roots, double scale) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr double kSteps = 4095.0;
  std::string text;
  for (const float root : roots) {
    const auto step = static_cast<std::size_t>(std::lround(kSteps * std::clamp(double{root} / scale, 0.0, 1.0)));
    text += kDigits[step / kDigits.size()];
    text += kDigits[step % kDigits.size()];
  }
  return text;
}

std::string formatPackedRows(const tissue::PressField& field) {
  const std::size_t size = field.radii_mm.size() * field.depths_mm.size();
  std::string text;
  for (std::size_t row = 0; row < field.rows_mm.size(); ++row) {
    const auto shear = std::span(field.shear).subspan(row * size, size);
    const auto volume = std::span(field.volume).subspan(row * size, size);
    const float most_shear = *std::ranges::max_element(shear);
    const float most_volume = *std::ranges::max_element(volume);
    text += fmt::format("{:.9g}, {}, {:.6g}, {:.6g}, \"{}\", \"{}\"\n", field.rows_mm[row], field.row_layers[row],
                        most_shear, most_volume, packedRow(shear, most_shear), packedRow(volume, most_volume));
  }
  return text;
}

/// The fields of the stacks as the shipped file has them, from meshes twice as fine as those of the forces.
std::string fieldsText(const Progress& progress) {
  constexpr double kFineness = 2.0;
  const std::vector<double> all_depths = elements::fieldDepths(kDepthsMm.back());
  std::vector<double> radii;
  std::string sizes;
  std::string patterns;
  std::string rows;
  forEachStack(progress, "solving the fields", [&](double thickness, double share, const Progress&) {
    elements::PressSettings press;
    press.fineness = kFineness;
    press.field_depths_mm = elements::fieldDepths((1.0 - kClosestToBone) * thickness);
    std::erase_if(press.field_depths_mm, [](double depth) { return depth > kDepthsMm.back(); });
    press.depths_mm = {press.field_depths_mm.back()};
    const elements::PressSolution solution = elements::solvePress(tissue::libraryStack(thickness, share), press);
    if (!solution.table.field) throw Error(fmt::format("{} mm: {}", thickness, solution.stopped_by));
    const tissue::PressField& field = *solution.table.field;
    radii = field.radii_mm;
    sizes += fmt::format("{}, {}\n", field.rows_mm.size(), field.depths_mm.size());
    for (const tissue::PressurePattern& pattern : field.patterns) {
      patterns += fmt::format("{:.4g}, {:.3g}\n", pattern.contact_radius_mm, pattern.exponent);
    }
    rows += formatPackedRows(field);
  });
  return "# Made by `palpate tissue library --solve --field`; library_fields.cpp says what stands where.\n" +
         numberTable("double[] kFieldRadiiMm", numberRow(radii)) +
         numberTable("double[] kFieldDepthsMm", numberRow(all_depths)) +
         numberTable("# rows, presses\nShippedField[] kFields", sizes) +
         numberTable("# contact_radius_mm, exponent\nPressurePattern[] kFieldPatterns", patterns) +
         numberTable("# depth_mm, layer, shear_scale, volume_scale, shear, volume\nShippedRow[] kFieldRows", rows);
}

void solveLibrary(const LibraryArguments& arguments) {
  if (arguments.output.empty()) throw Error(arguments.drag ? "--drag needs -o FILE" : "--solve needs -o FILE");
  OutputFile file(arguments.output);
  ProgressLine progress;
  const auto text = arguments.drag      ? dragText
                    : arguments.field   ? fieldsText
                    : arguments.fingers ? fingersText
                                        : libraryText;
  file.write(text(progress.callback()));
  file.commit();
  progress.clear();
  fmt::print("-> {} ({} stacks)\n", arguments.output,
             arguments.drag ? tissue::kSolvedStacks.size() : kThicknessesMm.size() * kFatShares.size());
}

void listLibrary(const LibraryArguments& arguments) {
  const tissue::LayeredTissue tissue(tissue::libraryNodes(arguments.fat_mm));
  Json json;
  json["fat_mm"] = arguments.fat_mm;
  json["finger_radius_mm"] = arguments.finger_mm;
  json["places"] = Json::array();
  std::string text = fmt::format(
      "skin 2 mm, 150 kPa; fat of {:.4g} mm, 10 kPa, less over shallow bone; muscle 27 kPa; a finger of {:.4g} mm\n",
      arguments.fat_mm, arguments.finger_mm);
  text += "  thickness   fat   force in N at 2, 5, 8 and 10 mm      secant at 8 mm   k_t / k_n\n";
  for (const double thickness : tissue::libraryThicknesses()) {
    const double fat = tissue::libraryFatShare(thickness, arguments.fat_mm) *
                       (thickness - tissue::libraryStack(thickness, 0.5).layers.front().thickness_mm);
    const auto force = [&](double depth) { return depth * tissue.secantAt(thickness, depth, arguments.finger_mm); };
    const double secant = tissue.secantAt(thickness, tissue::kReferenceDepthMm, arguments.finger_mm);
    text += fmt::format("{:8.4g} mm {:5.1f} {:8.2f}{:8.2f}{:8.2f}{:8.2f} {:12.3f} N/mm {:10.2f}\n", thickness, fat,
                        force(2), force(5), force(8), force(10), secant, tissue.tangentialAt(thickness));
    json["places"].push_back({{"thickness_mm", thickness},
                              {"fat_mm", fat},
                              {"force_n", {{"2", force(2)}, {"5", force(5)}, {"8", force(8)}, {"10", force(10)}}},
                              {"secant_n_per_mm", secant},
                              {"tangential_over_normal", tissue.tangentialAt(thickness)}});
  }
  fmt::print("{}", arguments.json ? jsonDump(json, 2) + "\n" : text);
}

}  // namespace

void addTissueLibraryCommand(Command& parent) {
  const auto [command, a] = addCommand<LibraryArguments>(
      parent, "library", "The solved stacks that a body's places are blended from",
      [](const LibraryArguments& given) { given.solve ? solveLibrary(given) : listLibrary(given); });
  addSetting(command, "--fat-mm", a.fat_mm, between(0.5, 60.0, "mm"), "Thickness of the fat between skin and muscle");
  addSetting(command, "--finger-radius-mm", a.finger_mm, between(1.0, 24.0, "mm"), "Radius of the pressing finger");
  Option& solve =
      *command.add_flag("--solve", a.solve, "Solve all stacks again (minutes) and write the shipped numbers");
  Option& fingers =
      *command
           .add_flag("--fingers", a.fingers,
                     "With --solve: write the forces of fingers of other radii, which have their own file")
           ->needs(&solve);
  command
      .add_flag("--drag", a.drag,
                "With --solve: write the drags that `palpate measure` fits to photographs, instead of the body's")
      ->needs(&solve)
      ->excludes(&fingers);
  command
      .add_flag("--field", a.field,
                "With --solve: write the strain energy under each press, which lumps need and which has its own file "
                "(5 minutes)")
      ->needs(&solve)
      ->excludes(&fingers);
  namesFileToWrite(command.add_option("-o,--out", a.output, "With --solve: file to write"));
  command.add_flag("--json", a.json, "Print one JSON object");
}

}  // namespace palpate::app
