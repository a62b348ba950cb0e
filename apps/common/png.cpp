#include "apps/common/png.h"

#include <stb/stb_image_write.h>

#include <cassert>
#include <stdexcept>
#include <string>

#include "files/whole_file.h"

namespace manzana::apps {
namespace {

void append(void* bytes, void* data, int size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

void write_png(const std::filesystem::path& file, int width, int height, std::span<const unsigned char> rgb) {
  assert(rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  std::string bytes;
  if (stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), width * 3) == 0)
    throw std::runtime_error(file.string() + ": the picture cannot be packed");
  files::write_whole(file, bytes);
}

}  // namespace manzana::apps
