// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/random_stream.h"

#include <cmath>
#include <numbers>

namespace ehm::tuner_design {
namespace {

double density(double x) {
  return std::exp(-0.5 * x * x);
}

Ziggurat made() {
  Ziggurat z;
  const double r = Ziggurat::tail_start;
  // area of a layer = that of the rectangle up to r and the tail: r f(r) + sqrt(pi/2) erfc(r/sqrt 2)
  const double area = r * density(r) + std::sqrt(0.5 * std::numbers::pi) * std::erfc(r / std::numbers::sqrt2);
  z.edge[0] = area / density(r);
  z.edge[1] = r;
  for (std::size_t i = 1; i + 1 < Ziggurat::layers; ++i) {
    // x_i (f(x_{i+1}) - f(x_i)) = area
    z.edge[i + 1] = std::sqrt(-2.0 * std::log(area / z.edge[i] + density(z.edge[i])));
  }
  z.edge[Ziggurat::layers] = 0.0;
  for (std::size_t i = 0; i <= Ziggurat::layers; ++i) z.density[i] = density(z.edge[i]);
  for (std::size_t i = 0; i < Ziggurat::layers; ++i) {
    z.unit[i] = z.edge[i] * 0x1p-53;
    z.inside[i] = static_cast<std::uint64_t>(z.edge[i + 1] / z.edge[i] * 0x1p53);
  }
  return z;
}

}  // namespace

const Ziggurat& Ziggurat::table() {
  static const Ziggurat ziggurat = made();
  return ziggurat;
}

double RandomStream::beside_the_layer(std::uint64_t draw) {
  const std::size_t layer = draw % Ziggurat::layers;
  if (layer == 0) return signed_by(draw, tail());
  const double x = static_cast<double>(draw >> 11) * ziggurat_->unit[layer];
  const double low = ziggurat_->density[layer], high = ziggurat_->density[layer + 1];
  if (low + uniform() * (high - low) < density(x)) return signed_by(draw, x);
  return normal();
}

double RandomStream::tail() {
  // Marsaglia: exponential steps beyond r, accepted with exp(-a^2/2)
  for (;;) {
    const double a = -std::log(uniform()) / Ziggurat::tail_start;
    const double b = -std::log(uniform());
    if (2.0 * b > a * a) return Ziggurat::tail_start + a;
  }
}

}  // namespace ehm::tuner_design
