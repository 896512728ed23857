// Every method works on the three parts of the log-tensor, so that it always predicts an ellipse. A point goes with its
// mirror image: left in, the image would give away what was left out.
// Based on: Ji, dissertation 2008, 5.2 (GRI); Duchon (1977) for thin plates, see maps/thin_plate_spline.h.
#include "dissertation/interpolation/left_out.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/gaussian_interpolation.h"
#include "palpate/maps/polynomial_surface.h"
#include "palpate/maps/thin_plate_spline.h"

namespace palpate::study {

namespace {

using maps::LogTensor;

constexpr int kSubjects = 5;

// d becomes 180 - d.
LogTensor mirrored(const LogTensor& tensor) { return {tensor[0], tensor[1], -tensor[2]}; }

Vec2 placeOf(int point) { return maps::dissertationKeyPoints().at(static_cast<std::size_t>(point - 1)).position_mm; }

// P4 and P5 are next to the spine; P6 and P7 are their images.
void addWithMirror(int point, const LogTensor& tensor, TensorSet& set) {
  const Vec2 place = placeOf(point);
  set.push_back({place, tensor, point, false});
  if (place.x() != 0.0) set.push_back({{-place.x(), place.y()}, mirrored(tensor), point, true});
}

LogTensor meanTensor(const TensorSet& keys) {
  LogTensor sum = LogTensor::Zero();
  for (const PlacedTensor& key : keys) sum += key.tensor;
  return keys.empty() ? sum : LogTensor(sum / static_cast<double>(keys.size()));
}

TensorField griField(const TensorSet& keys, const LogTensor& base, double effect_radius_mm) {
  return [=](const Vec2& place) {
    maps::GaussianBlend<LogTensor> blend(base);
    for (const PlacedTensor& key : keys) {
      blend.add(maps::effectLevel((place - key.place_mm).norm(), effect_radius_mm), key.tensor);
    }
    return blend.result();
  };
}

std::vector<double> partOf(const TensorSet& keys, int part) {
  std::vector<double> values;
  for (const PlacedTensor& key : keys) values.push_back(key.tensor[part]);
  return values;
}

std::vector<Vec2> placesOf(const TensorSet& keys) {
  std::vector<Vec2> places;
  for (const PlacedTensor& key : keys) places.push_back(key.place_mm);
  return places;
}

// A surface through each of the tensor's three parts.
template <class Surface, class... Settings>
TensorField surfaceField(const TensorSet& keys, Settings... settings) {
  const std::vector<Vec2> places = placesOf(keys);
  const auto fit = [&](int part) {
    return std::make_shared<const Surface>(places, partOf(keys, part), settings...);  // shared: fields are copied
  };
  const std::array parts{fit(0), fit(1), fit(2)};
  return
      [parts](const Vec2& place) { return LogTensor(parts[0]->at(place), parts[1]->at(place), parts[2]->at(place)); };
}

TensorField makeField(const TensorSet& keys, Interpolator interpolator, double effect_radius_mm) {
  switch (interpolator) {
    case Interpolator::mean:
      return [mean = meanTensor(keys)](const Vec2&) { return mean; };
    case Interpolator::gri:
      return griField(keys, {std::log(maps::EllipseMapSettings{}.basic_radius_mm), 0.0, 0.0}, effect_radius_mm);
    case Interpolator::gri_mean:
      return griField(keys, meanTensor(keys), effect_radius_mm);
    case Interpolator::thin_plate:
      return surfaceField<maps::ThinPlateSpline>(keys);
    case Interpolator::plane:
      return surfaceField<maps::PolynomialSurface>(keys, std::size_t{1});
    case Interpolator::quadratic:
      return surfaceField<maps::PolynomialSurface>(keys, std::size_t{2});
  }
  return {};
}

TensorSet without(const TensorSet& set, int point) {
  TensorSet rest;
  std::copy_if(set.begin(), set.end(), std::back_inserter(rest),
               [point](const PlacedTensor& key) { return key.point != point; });
  return rest;
}

}  // namespace

TensorSet meanSet(maps::ForceDirection force) {
  TensorSet set;
  const auto keys = maps::dissertationKeyPoints({force, maps::Averaging::plain});
  for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
    addWithMirror(point, maps::logTensor(keys.at(static_cast<std::size_t>(point - 1)).ellipse), set);
  }
  return set;
}

std::vector<TensorSet> subjectSets(maps::ForceDirection force) {
  std::vector<TensorSet> sets;
  for (int subject = 1; subject <= kSubjects; ++subject) {
    TensorSet set;
    for (const maps::MeasuredEllipse& row : maps::appendixC()) {
      if (row.force != force || row.subject != subject) continue;
      addWithMirror(row.point,
                    maps::logTensor(maps::ellipseFromFullAxesCm(row.major_cm, row.minor_cm, row.direction_deg)), set);
    }
    if (!set.empty()) sets.push_back(set);
  }
  return sets;
}

std::optional<TensorField> fieldThrough(const TensorSet& keys, Interpolator interpolator, double effect_radius_mm) {
  try {
    return makeField(keys, interpolator, effect_radius_mm);
  } catch (const Error&) {  // too few keys, or too much in line
    return std::nullopt;
  }
}

double boundaryRmsMm(const LogTensor& a, const LogTensor& b) {
  constexpr int kDirections = 72;
  const maps::Ellipse first = maps::ellipseOf(a);
  const maps::Ellipse second = maps::ellipseOf(b);
  double squares = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    const Vec2 unit(std::cos(angle), std::sin(angle));
    const double difference = 1.0 / maps::locationRatio(first, unit) - 1.0 / maps::locationRatio(second, unit);
    squares += difference * difference / kDirections;
  }
  return std::sqrt(squares);
}

LeftOutErrors leftOutErrors(const std::vector<TensorSet>& sets, Interpolator interpolator, double effect_radius_mm) {
  LeftOutErrors errors;
  for (const TensorSet& set : sets) {
    for (const PlacedTensor& truth : set) {
      if (truth.mirrored) continue;
      const auto field = fieldThrough(without(set, truth.point), interpolator, effect_radius_mm);
      if (!field) {
        ++errors.undetermined;
        continue;
      }
      const LogTensor predicted = (*field)(truth.place_mm);
      const double boundary = boundaryRmsMm(predicted, truth.tensor);
      const double size = maps::ellipseOf(predicted).half_major_mm - maps::ellipseOf(truth.tensor).half_major_mm;
      errors.rms_mm += boundary * boundary;
      errors.size_rms_mm += size * size;
      errors.most_mm = std::max(errors.most_mm, boundary);
      errors.each_mm.push_back(boundary);
      ++errors.predicted;
    }
  }
  const double n = std::max(1, errors.predicted);
  errors.rms_mm = std::sqrt(errors.rms_mm / n);
  errors.size_rms_mm = std::sqrt(errors.size_rms_mm / n);
  return errors;
}

double subjectScatterMm(const std::vector<TensorSet>& subjects) {
  double squares = 0.0;
  int compared = 0;
  for (const TensorSet& own : subjects) {
    for (const PlacedTensor& measured : own) {
      if (measured.mirrored) continue;
      TensorSet others;
      for (const TensorSet& other : subjects) {
        if (&other == &own) continue;
        std::copy_if(other.begin(), other.end(), std::back_inserter(others),
                     [&](const PlacedTensor& key) { return key.point == measured.point && !key.mirrored; });
      }
      const double distance = boundaryRmsMm(measured.tensor, meanTensor(others));
      squares += distance * distance;
      ++compared;
    }
  }
  return std::sqrt(squares / std::max(1, compared));
}

}  // namespace palpate::study
