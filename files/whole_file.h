#pragma once
/// Files that are there whole or not at all: written beside, then renamed.
#include <filesystem>
#include <string_view>

namespace manzana::files {

/// Throws std::runtime_error ("FILE: what") when it cannot be written; nothing is left behind then.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

/// Makes the folder and those above it. Throws std::runtime_error ("FOLDER: what").
void make_folder(const std::filesystem::path& folder);

}  // namespace manzana::files
