// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/engine_average.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "deploy/runtime/long_work/parallel_for.h"

namespace ehm::tuner_design {
namespace {

constexpr std::size_t most_blocks = 1024;

/// Mean and sum of squared deviations of a block.
struct Moments {
  Eigen::ArrayXd mean, squares;
  std::size_t count = 0;

  explicit Moments(Eigen::Index size) : mean(Eigen::ArrayXd::Zero(size)), squares(mean) {}

  void add(const Eigen::VectorXd& numbers) {
    ++count;
    const Eigen::ArrayXd off = numbers.array() - mean;
    mean += off / static_cast<double>(count);
    squares += off * (numbers.array() - mean);
  }
  void merge(const Moments& other) {
    if (other.count == 0) return;
    const double a = static_cast<double>(count), b = static_cast<double>(other.count);
    const Eigen::ArrayXd off = other.mean - mean;
    mean += off * (b / (a + b));
    squares += other.squares + off.square() * (a * b / (a + b));
    count += other.count;
  }
};

}  // namespace

EngineAverage average_over_engines(std::size_t engines, Eigen::Index size, unsigned threads, const EngineWork& work,
                                   const std::function<void(std::size_t)>& done) {
  const std::size_t block_size = (engines + most_blocks - 1) / most_blocks;
  const std::size_t blocks = (engines + block_size - 1) / block_size;
  std::vector<Moments> moments(blocks, Moments(size));
  long_work::parallel_for(
      blocks, threads,
      [&](std::size_t block) {
        Eigen::VectorXd numbers(size);
        for (std::size_t i = block * block_size; i < std::min(engines, (block + 1) * block_size); ++i) {
          if (work(i, numbers)) moments[block].add(numbers);
        }
      },
      [&](std::size_t blocks_done) { done(std::min(engines, blocks_done * block_size)); });

  Moments all(size);
  for (const Moments& block : moments) all.merge(block);
  EngineAverage average;
  average.engines = all.count;
  average.left_out = engines - all.count;
  if (all.count < 2 || 100 * average.left_out > engines) {
    throw std::runtime_error("Monte Carlo: " + std::to_string(average.left_out) + " of " + std::to_string(engines) +
                             " engines have no steady point");
  }
  const double n = static_cast<double>(all.count);
  average.mean = all.mean;
  average.standard_error = (all.squares / (n * (n - 1.0))).sqrt();
  return average;
}

}  // namespace ehm::tuner_design
