#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pleat {

/// Throws InputError naming the file when it cannot be read whole.
std::string read_file(const std::filesystem::path& path);

/// Writes beside the file first and renames, so that an interrupted run leaves no half of one.
/// Throws InputError naming the file.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes the folder and those above it; one that exists keeps what it holds. Throws InputError
/// naming it.
void make_folder(const std::filesystem::path& path);

}  // namespace pleat
