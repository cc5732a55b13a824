#pragma once

#include <array>
#include <optional>

#include "core/base/vec.h"
#include "core/contact/surface_pair.h"

namespace pleat {

/// Straight ways of a pair over a part of a substep: differences of the second side's vertices from
/// the first's [m], as pair_differences orders them.
struct PairWay {
  std::array<Vec3, 4> begins, ends;  ///< `count` of each
  int count = 0;                     ///< 3 of a vertex and a face, 4 of two edges
};

/// begin, end  places of all vertices when the part begins and ends [m]
PairWay pair_way(const SurfacePair& pair, const PositionsView& begin, const PositionsView& end);

/// True where the second side surely lies ahead of the first along the normal at both ends of the
/// way, whatever was rounded, and so all along it.
///
/// n  of any length that leaves products with differences between 1e-300 and overflow; else, and
///    where anything is not finite, nothing is sure
///
/// Source: docs/methods/contact.md.
bool separates(const Vec3& n, const PairWay& way);

/// The most parts of a way that have a normal each: the bound of rounding holds for so many.
constexpr int kMostParts = 8;

/// A normal that separates at the end of a way on which the sides never meet; nothing where it was
/// not found with a normal for each of so many equal parts. It errs to one side: sides that meet
/// never have one, others may lack one. Its largest component is 1.
///
/// hint        tried first: an old normal, of any length, or zero
/// most_parts  1, 2, 4 or 8
///
/// Source: docs/methods/contact.md.
std::optional<Vec3> separator(const PairWay& way, const Vec3& hint, int most_parts = kMostParts);

}  // namespace pleat
