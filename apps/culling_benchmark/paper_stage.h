#pragma once
/// Draws what a structure has found, in one of three ways of getting geometry to the device. A context must be current.
///   Stage stage(640, 360);
///   CityModel model(arranged(rows, peer->order()));
///   stage.draw(model, answer.runs, fleet, seen, view, Residency::resent);   // up to the last GL call
///   glFinish();                                                            // up to the picture
/// The same triangles in the same way in each; only the sending differs. No faces are culled, as in the paper. In a
/// frame nothing is allocated once the stream has grown, nothing read back, and with everything resident there is one
/// multi-draw for the city and one for the cars.
#include "apps/culling_benchmark/paper_cars.h"
#include "apps/culling_benchmark/paper_geometry.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"

namespace manzana::paper {

/// What is sent to the device again in every frame: all geometry, as in the paper's main tests; the city, while the
/// cars' meshes stay there; nothing but commands and places.
enum class Residency : std::uint8_t { resent, cars_resident, resident };

/// A city in the order of one structure.
struct CityModel {
  explicit CityModel(Geometry own) : geometry(std::move(own)) {}
  void put_on_device();  ///< for Residency::resident; once is enough
  Geometry geometry;
  gl::Buffer corners, indices;
};

/// The meshes of all levels of the cars.
struct Fleet {
  explicit Fleet(std::span<const CarLevel> levels);
  Geometry geometry;  ///< a row a level
  gl::Buffer corners, indices;
};

class Stage {
 public:
  Stage(int width, int height);
  /// `cars`: may be without any, but of that fleet's levels.
  void draw(const CityModel& city, std::span<const culling::ObjectRun> runs, const Fleet& fleet, const SeenCars& cars,
            const culling::View& view, Residency residency);
  int height() const { return target_.height; }
  /// RGB bytes, rows from the top. Waits for the device; not for use in a frame.
  std::vector<unsigned char> read_pixels() const;

 private:
  struct Batch;
  void begin_frame(const culling::View& view);
  void draw_ground();
  void draw_city(const CityModel& city, std::span<const culling::ObjectRun> runs, bool resident);
  void draw_cars(const Fleet& fleet, const SeenCars& cars, bool resident);
  void submit(GLuint array, const Batch& batch);

  gl::Target target_;
  gl::Program program_;
  gl::VertexArray in_place_, placed_;
  gl::Buffer ground_;
  gl::StreamBuffer stream_;
};

/// What a frame needs of the stream.
std::size_t stream_bytes(const CityModel& city, std::span<const culling::ObjectRun> runs, const Fleet& fleet,
                         const SeenCars& cars, Residency residency);

/// Triangles of these runs.
std::uint64_t triangles(const Geometry& geometry, std::span<const culling::ObjectRun> runs);

}  // namespace manzana::paper
