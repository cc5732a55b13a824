#pragma once

#include <span>

#include "core/reference/reference.h"

namespace pleat {

/// The shape at rest of a scene that has one in closed form, at every given time: what the scene
/// looks like once it has come to rest.
///
/// times  [s], positive, ascending: part of the id
///
/// - A sheet held by its whole upper edge alone, or by whole rows from there on with warp straight
///   down, hangs from its last held row (hanging_depth).
/// - Held by two rows or more with warp horizontal it is a cantilever (heavy_elastica) that begins
///   half a row before the last held one: bending elements have the width of a row, the first of
///   them is centred there, and the rows above cannot turn. The error of that is of second order;
///   to count the length from the last held row itself would be wrong at first order. Fitted
///   bending has its clamp between the two, a fifth of a row before the last held one, and is
///   compared with a strip that begins at that row: to first order. Stretch is left out.
/// - Particles in one chain of springs between two held ends, or below one, are at rest as chains
///   are (chain_between_supports, hanging_chain), exactly.
///
/// Throws InputError for any other scene, for one with air, solids or moving pins, for a sheet
/// whose springs resist shear where it hangs (its sides draw in, which the closed form lacks), and
/// for a cantilever beyond kMaxCantileverLoad.
Reference closed_form_reference(const Scene& scene, std::span<const double> times);

}  // namespace pleat
