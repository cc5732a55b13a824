#include "core/base/simd.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

namespace pleat {
namespace {

using Bytes = std::array<unsigned char, sizeof(float)>;

Bytes bytes_of(float number) {
  if (number != number) return {0xff};  // the bits of what is not a number are nobody's promise
  Bytes bytes;
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/// True if `operation` makes the same of four lanes as of each alone, to the bit.
template <class Operation>
bool agree(const std::array<float, 4>& a, const std::array<float, 4>& b,
           const Operation& operation) {
  std::array<float, 4> four;
  operation(Float4::load(a.data()), Float4::load(b.data())).store(four.data());
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const Float1 one = operation(Float1{a[lane]}, Float1{b[lane]});
    if (bytes_of(four[lane]) != bytes_of(one.value)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("simd: four lanes compute as one does, zeros, infinities and NaN too", "[base]") {
  constexpr float kHuge = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::array<float, 9> numbers = {0.0f,   -0.0f, 1.5f,   -3.1f, kHuge,
                                        -kHuge, kNaN,  1e-40f, 3e38f};
  for (const float x : numbers)
    for (const float y : numbers) {
      CAPTURE(x, y);
      const std::array<float, 4> a = {x, y, 0.0f, -0.0f};
      const std::array<float, 4> b = {y, x, x, y};
      CHECK(agree(a, b, [](auto p, auto q) { return p + q; }));
      CHECK(agree(a, b, [](auto p, auto q) { return p - q; }));
      CHECK(agree(a, b, [](auto p, auto q) { return p * q; }));
      CHECK(agree(a, b, [](auto p, auto q) { return p / q; }));
      CHECK(agree(a, b, [](auto p, auto) { return sqrt(p); }));
      CHECK(agree(a, b, [](auto p, auto q) { return max(p, q); }));
      CHECK(agree(a, b, [](auto p, auto q) { return min(p, q); }));
      CHECK(agree(a, b, [](auto p, auto) { return max(p, decltype(p)::all(0)); }));
      CHECK(agree(a, b, [](auto p, auto) { return min(p, decltype(p)::all(0)); }));
      CHECK(agree(a, b, [](auto p, auto q) { return where_positive(p, q); }));
      CHECK(positive_lanes(Float4::load(b.data())) == (y > 0 ? 9 : 0) + (x > 0 ? 6 : 0));
    }
}

TEST_CASE("simd: columns become rows, and a lane is spread over all", "[base]") {
  std::array<float, 16> matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = static_cast<float>(i);
  std::array<Float4, 4> columns;
  for (std::size_t i = 0; i < 4; ++i) columns[i] = Float4::load(&matrix[4 * i]);
  transpose(columns[0], columns[1], columns[2], columns[3]);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      CHECK(columns[static_cast<std::size_t>(row)].value[column] == 4 * column + row);
  const Float4 spread_out = spread<2>(columns[1]);
  for (int lane = 0; lane < 4; ++lane) CHECK(spread_out.value[lane] == 9);
}

}  // namespace pleat
