// A test of a simulated trainee, who is nothing but a psychometric function: which changes a method asks for, and what
// is answered.
//
//   method, trainee, seed ─ askedTest ─► answers ─► posterior after every trial ─► training_measurement.h
//
// The product's own methods are asked through it (training/block.h); the methods it was chosen against are here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/training/posterior.h"
#include "palpate/training/psychometric.h"

namespace palpate::study {

enum class AskedBy {
  marginal_psi,
  marginal_psi_vhb,  ///< the seven levels only
  quest,             ///< at the posterior's mean
  joint_psi,         ///< most informative about threshold, slope and lapse rate together
  two_down,
  three_down,
  weighted,  ///< up by three steps, down by one: 75 %
  constant,  ///< the seven levels by turns
  mastery,   ///< the Virtual Haptic Back, up and down
};

std::string nameOf(AskedBy method);

struct AskedTest {
  std::vector<training::Answer> answers;
  std::vector<double> reversals;  ///< two_down: the changes at which it turned
  double level = 0.0;             ///< mastery: the smallest that was mastered; 0: none
  double first_failed = 0.0;      ///< mastery: the smallest mastered when a level was failed first; 0: none
};

/// `trials` of them; the trainee's guess sets the number of places.
AskedTest askedTest(AskedBy method, const training::Psychometric& trainee, int trials, std::uint64_t seed);

/// Among twelve places, lapse rate 2 %, slope 1.8; among two 1.24.
training::Psychometric usualTrainee(double threshold, int choices = 12);

/// Posterior after all answers.
training::Posterior posteriorAfter(const std::vector<training::Answer>& answers, int choices = 12);

/// Runs `work(i)` for every i below `count`, on two threads where there are two. Rethrows its exceptions.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& work);

/// Seed of run `i` of a cell: no two cells share answers.
std::uint64_t runSeed(std::uint64_t seed, std::uint64_t cell, std::size_t i);

}  // namespace palpate::study
