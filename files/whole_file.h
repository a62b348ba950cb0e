#pragma once
/// Files that are there whole or not at all: written beside, then renamed. And read whole, under a limit.
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace manzana::files {

/// Throws std::runtime_error ("FILE: what") when it cannot be written; nothing is left behind then.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

/// Makes the folder and those above it. Throws std::runtime_error ("FOLDER: what").
void make_folder(const std::filesystem::path& folder);

/// A regular file. Throws std::runtime_error without the file's name ("no such file", "larger than 256 MiB").
std::vector<unsigned char> read_whole(const std::filesystem::path& file, std::uint64_t most_bytes);

}  // namespace manzana::files
