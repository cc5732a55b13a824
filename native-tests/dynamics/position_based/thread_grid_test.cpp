#include "core/dynamics/position_based/thread_grid.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "core/base/random.h"
#include "core/dynamics/position_based/lanes/spring_order.h"

namespace pleat {
namespace {

/// Threads without a shape, whose vertices have any numbers.
struct Threads {
  ClothModel model;
  std::vector<int> numbers;

  explicit Threads(int n_vertices) : numbers(static_cast<std::size_t>(n_vertices)) {
    model.masses.setOnes(n_vertices);
    std::iota(numbers.begin(), numbers.end(), 0);
    Random random(7);
    for (std::size_t i = numbers.size(); i > 1; --i)
      std::swap(numbers[i - 1],
                numbers[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(i)))]);
  }

  VertexId vertex(int i) const { return VertexId(numbers[static_cast<std::size_t>(i)]); }

  void join(int i, int j, SpringKind kind) {
    Spring spring;
    spring.a = vertex(i);
    spring.b = vertex(j);
    spring.stiffness = 1;
    spring.rest_length = 1;
    spring.kind = kind;
    model.springs.push_back(spring);
  }
};

/// Warp from row to row and weft along rows, which close to rings.
Threads tube(int n_rows, int n_columns) {
  Threads tube(n_rows * n_columns);
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_columns; ++c) {
      const int i = r * n_columns + c;
      tube.join(i, r * n_columns + (c + 1) % n_columns, SpringKind::weft);
      if (r + 1 < n_rows) tube.join(i, i + n_columns, SpringKind::warp);
    }
  return tube;
}

}  // namespace

TEST_CASE("thread grid: a tube has its rows from the pins, and neighbours side by side",
          "[dynamics]") {
  constexpr int kRows = 5;
  constexpr int kColumns = 12;
  Threads cloth = tube(kRows, kColumns);
  const bool held_below = GENERATE(false, true);
  for (int c = 0; c < kColumns; ++c)
    cloth.model.pins.push_back(
        {cloth.vertex(held_below ? (kRows - 1) * kColumns + c : c), Vec3::Zero(), {}});
  const auto grid = thread_grid(cloth.model);
  REQUIRE(grid);
  const auto place = [&](int i) { return (*grid)[static_cast<std::size_t>(cloth.vertex(i))]; };
  for (int i = 0; i < kRows * kColumns; ++i) {
    const int row = i / kColumns;
    CHECK(place(i).row == (held_below ? kRows - 1 - row : row));
    CHECK(place(i).column == place(i % kColumns).column);
    const int apart = std::abs(place(i).column - place(row * kColumns + (i + 1) % kColumns).column);
    CHECK((apart == 1 || apart == kColumns - 1));
  }
}

TEST_CASE("thread grid: cloth that parts into legs is one", "[dynamics]") {
  // A ring of eight, below it two of five, each with one thread that begins there.
  constexpr int kRing = 8;
  Threads cloth(kRing + 10);
  for (int c = 0; c < kRing; ++c) cloth.join(c, (c + 1) % kRing, SpringKind::weft);
  for (int leg = 0; leg < 2; ++leg) {
    const int first = kRing + 5 * leg;
    for (int c = 0; c < 5; ++c) cloth.join(first + c, first + (c + 1) % 5, SpringKind::weft);
    for (int c = 0; c < 4; ++c) cloth.join(4 * leg + c, first + c, SpringKind::warp);
  }
  cloth.model.pins.push_back({cloth.vertex(0), Vec3::Zero(), {}});
  const auto grid = thread_grid(cloth.model);
  REQUIRE(grid);
  std::vector<int> columns;
  for (const GridPlace& place : *grid) columns.push_back(place.column);
  CHECK(*std::max_element(columns.begin(), columns.end()) == 9);
  for (int i = 0; i < kRing + 10; ++i)
    CHECK((*grid)[static_cast<std::size_t>(cloth.vertex(i))].row == (i < kRing ? 0 : 1));
}

TEST_CASE("thread grid: there is none where threads branch or shift, or without any",
          "[dynamics]") {
  Threads branching = tube(3, 6);
  branching.join(0, 7, SpringKind::warp);
  CHECK_FALSE(thread_grid(branching.model));
  Threads spiral(6);  // the weft goes on in the row below
  for (int i = 0; i < 5; ++i) spiral.join(i, i + 1, SpringKind::weft);
  for (int i = 0; i < 3; ++i) spiral.join(i, i + 3, SpringKind::warp);
  CHECK_FALSE(thread_grid(spiral.model));
  Threads none(4);
  none.join(0, 1, SpringKind::other);
  CHECK_FALSE(thread_grid(none.model));
}

TEST_CASE("spring order: lines run along the rows of a tube too, of no sheet", "[dynamics]") {
  const bool is_tube = GENERATE(true, false);
  constexpr int kRows = 6;
  constexpr int kColumns = 32;
  Threads cloth = tube(kRows, kColumns);
  if (!is_tube)
    std::erase_if(cloth.model.springs, [&](const Spring& spring) {
      for (int r = 0; r < kRows; ++r)
        if (spring.kind == SpringKind::weft && spring.b == cloth.vertex(r * kColumns)) return true;
      return false;
    });
  for (int c = 0; c < kColumns; ++c)
    cloth.model.pins.push_back({cloth.vertex(c), Vec3::Zero(), {}});
  std::vector<int> all(cloth.model.springs.size());
  std::iota(all.begin(), all.end(), 0);
  const LaneLayout layout = lane_layout(cloth.model);
  const SpringOrder order = order_springs(cloth.model, layout, all);
  const auto across = static_cast<std::size_t>(kColumns / 4);
  CHECK(order.lines.size() == (is_tube ? across + kRows : across));
}

}  // namespace pleat
