#include "core/dynamics/position_based/levels/gathered_vertices.h"

namespace pleat {
namespace {

constexpr std::array<int, 4> kFour = {0, 4, 8, 12};

/// The lanes of four slots at a time, turned.
template <class Pointer>
void gather_slots(const std::array<Pointer, 3>& from, std::vector<float>& to) {
  for (std::size_t i = 0; i < to.size(); i += 16) {
    const std::size_t slot = i / 4;
    QuadVectors<Float4> vectors = {Float4::load(from[0] + slot), Float4::load(from[1] + slot),
                                   Float4::load(from[2] + slot), Float4::all(0)};
    transpose(vectors[0], vectors[1], vectors[2], vectors[3]);
    scatter(vectors, &to[i], kFour);
  }
}

}  // namespace

void GatheredVertices::begin(const LaneView& view) {
  view_ = view;
  has_begins_ = has_moves_ = false;
}

float* GatheredVertices::moves() {
  if (!has_moves_) gather_slots(view_.moves, moves_);
  has_moves_ = true;
  return moves_.data();
}

const float* GatheredVertices::begins() {
  if (!has_begins_) gather_slots(view_.begins, begins_);
  has_begins_ = true;
  return begins_.data();
}

const LaneView& GatheredVertices::lanes() {
  lanes_to_read();
  has_moves_ = false;
  return view_;
}

const LaneView& GatheredVertices::lanes_to_read() {
  if (has_moves_)
    for (std::size_t i = 0; i < moves_.size(); i += 16)
      store(in_lanes(gather<Float4>(&moves_[i], kFour)), view_.moves, static_cast<int>(i / 4));
  return view_;
}

}  // namespace pleat
