// SPDX-License-Identifier: Apache-2.0
#pragma once
// Random numbers of one engine: a stream of its own for each (seed, index), the same on every machine and on any number
// of threads.
//
// bits    xoshiro256++ 1.0, 256 bits of state, period 2^256 - 1 (Blackman & Vigna, ACM TOMS 47 (2021) 36)
// seeding SplitMix64 from mix(mix(seed) + index) (Steele, Lea & Flood, OOPSLA 2014), as Blackman & Vigna advise
// normal  ziggurat of 256 layers: layer and sign from the low 9 bits, position from the high 53, which do not overlap
//         (Marsaglia & Tsang, J. Stat. Software 5 (2000) 8; independent bits: Doornik, 2005). 98.5 % of the deviates
//         cost one draw, one table look-up and one product.
// Errors: none.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace ehm::tuner_design {

/// Layers of equal area under f(x) = exp(-x^2/2), from the widest, whose area holds the tail beyond `tail_start`.
struct Ziggurat {
  static constexpr int layers = 256;
  static constexpr double tail_start = 3.6541528853610088;  ///< Marsaglia & Tsang, for 256 layers
  std::array<double, layers + 1> edge{};                    ///< x_i, falling to 0; x_0 is area/f(tail_start)
  std::array<double, layers + 1> density{};                 ///< f(x_i)
  std::array<double, layers> unit{};                        ///< x_i 2^-53
  std::array<std::uint64_t, layers> inside{};               ///< positions below it lie under the curve without a look

  static const Ziggurat& table();
};

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t index) {
    std::uint64_t state = mixed(mixed(seed) + index);
    for (std::uint64_t& word : state_) word = mixed(state += golden);
  }

  /// The bare generator; not all zero.
  explicit RandomStream(const std::array<std::uint64_t, 4>& state) : state_(state) {}

  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// In (0, 1), multiples of 2^-53 off by half of it.
  double uniform() { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; }

  /// Standard normal deviate.
  double normal() {
    const std::uint64_t draw = bits();
    const std::size_t layer = draw % Ziggurat::layers;
    const std::uint64_t position = draw >> 11;
    if (position < ziggurat_->inside[layer])
      return signed_by(draw, static_cast<double>(position) * ziggurat_->unit[layer]);
    return beside_the_layer(draw);
  }

 private:
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;

  /// The output function of SplitMix64, a bijection.
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
  }
  /// Bit 8 of the draw is the sign.
  static double signed_by(std::uint64_t draw, double magnitude) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | (draw & 0x100) << 55);
  }
  /// In the wedge between layer and curve, in the tail, or another draw.
  double beside_the_layer(std::uint64_t draw);
  double tail();

  const Ziggurat* ziggurat_ = &Ziggurat::table();
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace ehm::tuner_design
