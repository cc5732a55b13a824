#pragma once

#include <initializer_list>
#include <set>
#include <string>

namespace pleat {

/// The files of the program and of its methods' pages in which one of the words stands, a header
/// and its source as one: "core/base/shapes". A word ends where a letter, a digit or _ would go on.
std::set<std::string> files_naming(std::initializer_list<std::string> words);

/// Prints "places WHAT NUMBER", which `./pleat bench setup` finds in the logs: how many files one
/// more of something takes.
void tell_places(const std::string& what, std::size_t number);

}  // namespace pleat
