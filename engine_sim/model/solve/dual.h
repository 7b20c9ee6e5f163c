// SPDX-License-Identifier: Apache-2.0
#pragma once
// Forward-mode dual numbers of fixed width: x = v + sum_i d_i eps_i with eps_i eps_j = 0, so that f(x) carries f(v) and
// the exact gradient f'(v) d. Newton's method gets its Jacobian from one evaluation, without a step size.
// A component that is written as a template over its scalar runs in double and in Dual<N> alike.
// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed., chapter 3 (forward mode).
// Errors: none; a division by zero or a root of a negative value gives the same non-finite value as in double.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace ehm::engine_sim {

template <std::size_t N>
struct Dual {
  double v = 0.0;             ///< value
  std::array<double, N> d{};  ///< derivative with respect to each of the N independent variables

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: a constant is a dual number of zero derivative
  /// The independent variable number `index`.
  static Dual variable(double value, std::size_t index) {
    Dual x(value);
    x.d[index] = 1.0;
    return x;
  }
};

/// f(x), given the value f and its derivative fx.
template <std::size_t N>
Dual<N> chain(double f, double fx, const Dual<N>& x) {
  Dual<N> y(f);
  for (std::size_t i = 0; i < N; ++i) y.d[i] = fx * x.d[i];
  return y;
}
inline double chain(double f, double /*fx*/, double /*x*/) {
  return f;
}

/// f(x, y), given the value f and both partial derivatives.
template <std::size_t N>
Dual<N> chain(double f, double fx, const Dual<N>& x, double fy, const Dual<N>& y) {
  Dual<N> z(f);
  for (std::size_t i = 0; i < N; ++i) z.d[i] = fx * x.d[i] + fy * y.d[i];
  return z;
}
inline double chain(double f, double /*fx*/, double /*x*/, double /*fy*/, double /*y*/) {
  return f;
}

/// The plain value of either kind of scalar.
inline double value(double x) {
  return x;
}
template <std::size_t N>
double value(const Dual<N>& x) {
  return x.v;
}

/// x as a T: x itself, or its plain value.
template <class T, class S>
T carried(const S& x) {
  if constexpr (std::is_same_v<T, S>) {
    return x;
  } else {
    return value(x);
  }
}

/// Whether x is zero with all its derivatives.
inline bool vanishes(double x) {
  return x == 0.0;
}
template <std::size_t N>
bool vanishes(const Dual<N>& x) {
  return x.v == 0.0 && std::all_of(x.d.begin(), x.d.end(), [](double d) { return d == 0.0; });
}

template <std::size_t N>
Dual<N> operator-(const Dual<N>& a) {
  return chain(-a.v, -1.0, a);
}
template <std::size_t N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  return chain(a.v + b.v, 1.0, a, 1.0, b);
}
template <std::size_t N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  return chain(a.v - b.v, 1.0, a, -1.0, b);
}
template <std::size_t N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return chain(a.v * b.v, b.v, a, a.v, b);
}
template <std::size_t N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  const double q = a.v / b.v;
  return chain(q, 1.0 / b.v, a, -q / b.v, b);
}

// Mixed forms spare the loop over zero derivatives.
template <std::size_t N>
Dual<N> operator+(const Dual<N>& a, double b) {
  Dual<N> y = a;
  y.v += b;
  return y;
}
template <std::size_t N>
Dual<N> operator+(double a, const Dual<N>& b) {
  return b + a;
}
template <std::size_t N>
Dual<N> operator-(const Dual<N>& a, double b) {
  return a + (-b);
}
template <std::size_t N>
Dual<N> operator-(double a, const Dual<N>& b) {
  return chain(a - b.v, -1.0, b);
}
template <std::size_t N>
Dual<N> operator*(const Dual<N>& a, double b) {
  return chain(a.v * b, b, a);
}
template <std::size_t N>
Dual<N> operator*(double a, const Dual<N>& b) {
  return chain(a * b.v, a, b);
}
template <std::size_t N>
Dual<N> operator/(const Dual<N>& a, double b) {
  return chain(a.v / b, 1.0 / b, a);
}
template <std::size_t N>
Dual<N> operator/(double a, const Dual<N>& b) {
  const double q = a / b.v;
  return chain(q, -q / b.v, b);
}

template <std::size_t N>
Dual<N> sqrt(const Dual<N>& x) {
  const double root = std::sqrt(x.v);
  return chain(root, 0.5 / root, x);
}
template <std::size_t N>
Dual<N> log(const Dual<N>& x) {
  return chain(std::log(x.v), 1.0 / x.v, x);
}
template <std::size_t N>
Dual<N> exp(const Dual<N>& x) {
  const double e = std::exp(x.v);
  return chain(e, e, x);
}
template <std::size_t N>
Dual<N> pow(const Dual<N>& x, double exponent) {
  const double p = std::pow(x.v, exponent);
  return chain(p, exponent * p / x.v, x);
}

}  // namespace ehm::engine_sim
