#include "palpate/training/threshold_likelihood.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpate::training {

namespace {

void scaleToOne(std::vector<double>& values) {
  const double most = *std::max_element(values.begin(), values.end());
  for (double& value : values) value /= most;
}

}  // namespace

ThresholdLikelihood thresholdLikelihood(std::span<const Answer> answers, int choices) {
  Posterior posterior(choices);
  const std::vector<double> before = posterior.thresholdWeights();
  for (const Answer& answer : answers) posterior.add(answer);
  ThresholdLikelihood found{posterior.lnThresholds(), posterior.thresholdWeights()};
  for (std::size_t i = 0; i < before.size(); ++i) found.values[i] /= before[i];
  scaleToOne(found.values);
  return found;
}

ThresholdLikelihood changeLikelihood(const ThresholdLikelihood& before, const ThresholdLikelihood& after) {
  const std::size_t size = before.places.size();
  ThresholdLikelihood found;
  for (std::size_t lag = 0; lag < 2 * size - 1; ++lag) {  // after lies (lag - size + 1) cells over before
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t other = i + lag + 1;
      if (other >= size && other - size < size) sum += before.values[i] * after.values[other - size];
    }
    found.places.push_back(before.cell() * (static_cast<double>(lag) - static_cast<double>(size - 1)));
    found.values.push_back(sum);
  }
  scaleToOne(found.values);
  return found;
}

ThresholdLikelihood blurred(const ThresholdLikelihood& likelihood, double sd_ln) {
  ThresholdLikelihood found = likelihood;
  for (std::size_t to = 0; to < found.places.size(); ++to) {
    double all = 0.0;
    double sum = 0.0;
    for (std::size_t from = 0; from < found.places.size(); ++from) {
      const double far = (found.places[to] - found.places[from]) / sd_ln;
      const double share = std::exp(-0.5 * far * far);
      all += share;
      sum += share * likelihood.values[from];
    }
    found.values[to] = sum / all;
  }
  scaleToOne(found.values);
  return found;
}

}  // namespace palpate::training
