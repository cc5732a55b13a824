#pragma once

#include <span>
#include <string_view>

namespace pleat {

/// The known word that is most likely meant; empty when none is near. Nearest is by the fewest
/// letters to insert, delete or replace, with at most a third of the letters wrong; a word that is
/// the start of a known one ("width") is nearest to that ("width_m").
std::string_view nearest_word(std::string_view word, std::span<const char* const> known);

}  // namespace pleat
