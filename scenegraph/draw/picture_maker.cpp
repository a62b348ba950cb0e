#include "scenegraph/draw/picture_maker.h"

namespace manzana::draw {
namespace {

std::size_t bytes_of(const PictureSquare& square) {
  return square.front().texels.size() * sizeof(GroundPhoto::Texel) / 3 * 4;
}

}  // namespace

void PictureMaker::want(const Renderer& renderer) {
  for (const PictureWanted& wanted : renderer.pictures_wanted()) squares_.want(wanted);
}

bool PictureMaker::give(Renderer& renderer, std::size_t most_bytes) {
  bool given = false;
  for (std::size_t bytes = 0; bytes < most_bytes;) {
    const auto made = squares_.take();
    if (!made) break;
    given = renderer.add_picture(made->key, made->value) || given;
    bytes += bytes_of(made->value);
  }
  return given;
}

bool PictureMaker::give_all(Renderer& renderer) {
  bool given = false;
  while (const auto made = squares_.wait_and_take()) given = renderer.add_picture(made->key, made->value) || given;
  return given;
}

}  // namespace manzana::draw
