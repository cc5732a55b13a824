#pragma once

#include <array>

#include "core/base/simd.h"

namespace pleat {

/// Four vectors, each in a group of its own: x, y, z and one unused number.
template <class Quad>
using QuadVectors = std::array<Quad, 4>;

template <class Quad>
QuadVectors<Quad> operator+(const QuadVectors<Quad>& a, const QuadVectors<Quad>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
template <class Quad>
QuadVectors<Quad> operator-(const QuadVectors<Quad>& a, const QuadVectors<Quad>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

/// Each vector times its lane of `factors`.
template <class Quad>
QuadVectors<Quad> scaled(const QuadVectors<Quad>& a, Quad factors) {
  return {spread<0>(factors) * a[0], spread<1>(factors) * a[1], spread<2>(factors) * a[2],
          spread<3>(factors) * a[3]};
}

/// a_i.b_i in lane i.
template <class Quad>
Quad dots(const QuadVectors<Quad>& a, const QuadVectors<Quad>& b) {
  Quad x = a[0] * b[0], y = a[1] * b[1], z = a[2] * b[2], unused = a[3] * b[3];
  transpose(x, y, z, unused);
  return x + y + z;
}

/// The vectors from these numbers of an array on, and back.
template <class Quad, class Real>
QuadVectors<Quad> gather(const Real* from, const std::array<int, 4>& firsts) {
  return {Quad::load(from + firsts[0]), Quad::load(from + firsts[1]), Quad::load(from + firsts[2]),
          Quad::load(from + firsts[3])};
}
template <class Quad, class Real>
void scatter(const QuadVectors<Quad>& values, Real* to, const std::array<int, 4>& firsts) {
  for (std::size_t i = 0; i < 4; ++i) values[i].store(to + firsts[i]);
}

/// Component by component, and back.
template <class Quad>
Vec3Lanes<Quad> in_lanes(QuadVectors<Quad> a) {
  transpose(a[0], a[1], a[2], a[3]);
  return {a[0], a[1], a[2]};
}
template <class Quad>
QuadVectors<Quad> one_by_one(const Vec3Lanes<Quad>& a) {
  QuadVectors<Quad> vectors = {a.x, a.y, a.z, a.z};
  transpose(vectors[0], vectors[1], vectors[2], vectors[3]);
  return vectors;
}

}  // namespace pleat
