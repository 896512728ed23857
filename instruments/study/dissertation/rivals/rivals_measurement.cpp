// Builds each method on each block, presses, and compares with the truth.
#include "dissertation/rivals/rivals_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "dissertation/rivals/finite_elements.h"
#include "dissertation/rivals/free_form.h"
#include "dissertation/rivals/mass_spring.h"
#include "lab/measured/pressed_skin.h"
#include "palpate/base/error.h"
#include "palpate/deform/deformer.h"

namespace palpate::study {

namespace {

constexpr double kJudgedMm = 40.0;

// Processor time per call: methods that take seconds meet whatever else the machine does.
template <class Work>
double processorMicroseconds(int calls, Work&& work) {
  const std::clock_t start = std::clock();
  for (int call = 0; call < calls; ++call) work();
  return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / calls;
}
// The measured half axis and ratio of P2 (Figure 5.3), on the spine.
constexpr double kPrintedHalfMajorMm = 149.0;
constexpr double kPrintedRatio = 1.05;

double processorMilliseconds(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void judge(RivalRow& row, const TissueBlock& block) {
  row.vertices = row.displacements.size();
  row.cells = block.cells();
  double normal2 = 0.0;
  double all2 = 0.0;
  int judged = 0;
  for (std::size_t v = 0; v < row.vertices; ++v) {
    row.rest.push_back(block.place(block.firstTopNode() + v));
    const Vec2 place = row.rest.back().head<2>();
    if (place.norm() > kJudgedMm) continue;
    const Vec3 off = row.displacements[v] - trueDisplacement(row.truth, place);
    normal2 += off.z() * off.z();
    all2 += off.squaredNorm();
    ++judged;
  }
  row.normal_error = std::sqrt(normal2 / judged) / row.truth.central_mm;
  row.error = std::sqrt(all2 / judged) / row.truth.central_mm;
}

double bytesOf(const deform::Skin& skin) {
  constexpr double kSurfaceStreams = 10.0;  // positions, normals, displacements, strain
  double links = 0.0;
  for (Index v = 0; v < skin.vertices; ++v) {
    links += static_cast<double>(skin.neighbours[v].size() + skin.triangles_of_vertex[v].size());
  }
  return skin.vertices * (deform::kRestStreams + kSurfaceStreams) * sizeof(float) +
         static_cast<double>(skin.triangles.size() * sizeof(Triangle)) + links * sizeof(Index);
}

RivalRow fsmdRow(Rival rival, const TissueBlock& block, const LayeredPress& truth, int runs) {
  RivalRow row{.rival = rival, .truth = truth};
  deform::FormSettings forms;
  if (rival == Rival::fsmd_printed) forms.region = deform::NormalRegion::shared;
  const mesh::TriangleMesh mesh = block.skin();
  const std::clock_t start = std::clock();
  const deform::Skin skin = deform::buildSkin(mesh);
  deform::Deformer deformer(skin, forms);
  deform::DeformedSurface surface(skin);
  row.once_ms = processorMilliseconds(start);
  const Press press{.depth_mm = truth.central_mm, .half_major_mm = kPrintedHalfMajorMm, .aspect = 1.0 / kPrintedRatio};
  const deform::Contact contact = contactOf(mesh, press, forms);
  row.press_us = processorMicroseconds(500 * runs, [&] { deformer.apply({&contact, 1}, surface); });
  for (Index v = 0; v < surface.vertices(); ++v) {
    row.displacements.push_back(surface.displacementAt(v).cast<double>());
  }
  row.bytes = bytesOf(skin);
  judge(row, block);
  return row;
}

RivalRow freeFormRow(const TissueBlock& block, const LayeredPress& truth, double lattice_mm, int runs) {
  RivalRow row{.rival = Rival::free_form, .truth = truth, .lattice_mm = lattice_mm};
  const std::clock_t start = std::clock();
  FreeForm form(block, lattice_mm);
  row.once_ms = processorMilliseconds(start);
  row.press_us = processorMicroseconds(50 * runs, [&] { row.displacements = form.press(truth.central_mm); });
  row.bytes = static_cast<double>(form.bytes());
  judge(row, block);
  return row;
}

RivalRow massSpringRow(const TissueBlock& block, const LayeredPress& truth) {
  RivalRow row{.rival = Rival::mass_spring, .truth = truth};
  const std::clock_t start = std::clock();
  MassSpring springs(block);
  row.once_ms = processorMilliseconds(start);
  PressedSurface pressed;
  row.press_us = processorMicroseconds(2, [&] { pressed = springs.press(truth.central_mm); });
  row.displacements = std::move(pressed.displacements);
  row.force_n = pressed.force_n;
  row.bytes = static_cast<double>(springs.bytes());
  judge(row, block);
  return row;
}

RivalRow elementsRow(Rival rival, FiniteElements& elements, double factor_ms, const TissueBlock& block,
                     const LayeredPress& truth, int runs) {
  RivalRow row{.rival = rival, .truth = truth, .once_ms = factor_ms};
  PressedSurface pressed;
  const auto press = [&] { pressed = elements.press(truth.central_mm); };
  const auto press_anew = [&] {
    elements.forgetAnswers();
    press();
  };
  const double anew_us = processorMicroseconds(2, press_anew);
  row.press_us = rival == Rival::elements ? anew_us : processorMicroseconds(50 * runs, press);
  row.bytes = static_cast<double>(elements.bytes());
  if (rival == Rival::elements_answers) {
    // Time for all vertices, from the time of those that this press needed.
    const double answers = static_cast<double>(elements.answers());
    row.once_ms += 1e-3 * anew_us / answers * static_cast<double>(block.nodesOfALevel());
    row.bytes = static_cast<double>(elements.bytesOfAllAnswers());
  }
  row.displacements = std::move(pressed.displacements);
  row.force_n = pressed.force_n;
  judge(row, block);
  return row;
}

void measureBlock(RivalsMeasurement& found, const std::string& tissue, int cells) {
  const RivalsPlan& plan = found.plan;
  const TissueBlock block(layeredPress(tissue, 10.0).layers, plan.side_mm, cells);
  const std::clock_t start = std::clock();
  FiniteElements elements(block);
  const double factor_ms = processorMilliseconds(start);
  for (const LayeredPress& truth : layeredPresses()) {
    if (truth.tissue != tissue) continue;
    for (const Rival rival : {Rival::fsmd, Rival::fsmd_printed}) {
      found.rows.push_back(fsmdRow(rival, block, truth, plan.runs));
    }
    for (const double lattice : plan.lattices) {
      found.rows.push_back(freeFormRow(block, truth, lattice, plan.runs));
    }
    found.rows.push_back(massSpringRow(block, truth));
    for (const Rival rival : {Rival::elements, Rival::elements_answers}) {
      found.rows.push_back(elementsRow(rival, elements, factor_ms, block, truth, plan.runs));
    }
  }
}

std::vector<std::string> tissues() {
  std::vector<std::string> names;
  for (const LayeredPress& press : layeredPresses()) {
    if (names.empty() || names.back() != press.tissue) names.push_back(press.tissue);
  }
  return names;
}

}  // namespace

const char* nameOf(Rival rival) {
  switch (rival) {
    case Rival::fsmd:
      return "FSMD";
    case Rival::fsmd_printed:
      return "FSMD, one measured ellipse";
    case Rival::free_form:
      return "free form";
    case Rival::mass_spring:
      return "mass-spring";
    case Rival::elements:
      return "linear elements";
    case Rival::elements_answers:
      return "elements, answers kept";
  }
  return "";
}

const char* keyOf(Rival rival) {
  switch (rival) {
    case Rival::fsmd:
      return "fsmd";
    case Rival::fsmd_printed:
      return "fsmd_printed";
    case Rival::free_form:
      return "free_form";
    case Rival::mass_spring:
      return "mass_spring";
    case Rival::elements:
      return "elements";
    case Rival::elements_answers:
      return "elements_answers";
  }
  return "";
}

RivalsPlan rivalsPlan(bool quick) {
  if (quick) return {.cells = {8, 12}, .common_cells = 12, .lattices = {8.0, 10.0, 16.0}, .runs = 3};
  return {.cells = {12, 16, 20, 24}, .common_cells = 20, .lattices = {6.0, 8.0, 10.0, 12.0, 16.0, 20.0}, .runs = 20};
}

RivalsMeasurement measureRivals(const RivalsPlan& plan, const Progress& progress) {
  RivalsMeasurement found{.plan = plan, .rows = {}};
  std::vector<std::pair<std::string, int>> blocks;
  for (const std::string& tissue : tissues()) {
    for (const int cells : plan.cells) {
      if (tissue == "back_mid" || cells == plan.common_cells) blocks.emplace_back(tissue, cells);
    }
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& [tissue, cells] = blocks[i];
    report(progress, fmt::format("{}, {} cells", tissue, cells),
           static_cast<double>(i) / static_cast<double>(blocks.size()));
    measureBlock(found, tissue, cells);
  }
  return found;
}

const RivalRow& findRivalRow(const RivalsMeasurement& found, Rival rival, const std::string& tissue, double depth_mm,
                             int cells) {
  for (const RivalRow& row : found.rows) {
    const bool lattice = rival != Rival::free_form || row.lattice_mm == found.plan.lattice_mm;
    if (row.rival == rival && row.truth.tissue == tissue && row.truth.depth_mm == depth_mm && row.cells == cells &&
        lattice) {
      return row;
    }
  }
  throw Error(fmt::format("study rivals: {} was not measured on {}", nameOf(rival), tissue));
}

}  // namespace palpate::study
