#pragma once
/// Makes the pictures that a renderer asks for beside what is drawn, on a host's threads or its own.
///   PictureMaker pictures([&](const PictureWanted& w) { return picture_square(scene.pictures.encoded[w.picture],
///   w.side); });
///   ...each frame, the context current:
///   pictures.give(renderer, bytes_a_frame);                           // what has been made since
///   renderer.draw(...);
///   pictures.want(renderer);                                          // what was missing
/// GL is called by give() and give_all() alone. It may outlive the renderer.
#include "scenegraph/draw/background.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

class PictureMaker {
 public:
  /// Its side is that which is wanted. None: it cannot be read. Throws nothing; with `run` it owns what it uses.
  using Make = std::function<std::optional<PictureSquare>(const PictureWanted&)>;
  explicit PictureMaker(Make make, Run run = {}, std::function<void()> arrived = {})
      : squares_(std::move(make), std::move(run), std::move(arrived)) {}

  void want(const Renderer& renderer);
  /// One at least, then until so many bytes. True: the picture will be another.
  bool give(Renderer& renderer, std::size_t most_bytes);
  bool give_all(Renderer& renderer);  ///< waits for all that is wanted
  void drop() { squares_.drop(); }
  bool ready() const { return squares_.ready(); }
  std::size_t left() const { return squares_.left(); }

 private:
  Background<PictureWanted, PictureSquare> squares_;
};

}  // namespace manzana::draw
