#include "apps/culling_benchmark/paper_stage.h"

#include <algorithm>
#include <cstring>

#include "apps/culling_benchmark/paper_colour.h"
#include "culling_benchmark_parts_shaders.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "scenegraph/draw/camera.h"

namespace manzana::paper {
namespace {

using culling::ObjectRun;
using gl::DrawCommand;
using gl::StreamBuffer;

enum Attribute : GLuint { kPosition, kColour, kPlace, kForward, kTint };
enum Binding : GLuint { kCorners, kInstances };

void attribute(GLuint array, Attribute which, Binding binding, GLint size, GLenum type, std::size_t offset) {
  glEnableVertexArrayAttrib(array, which);
  glVertexArrayAttribBinding(array, which, binding);
  glVertexArrayAttribFormat(array, which, size, type, type == GL_UNSIGNED_BYTE, static_cast<GLuint>(offset));
}

gl::VertexArray make_array(bool instances) {
  gl::VertexArray array = gl::make_vertex_array();
  const GLuint name = array.name();
  attribute(name, kPosition, kCorners, 3, GL_FLOAT, offsetof(Corner, position));
  attribute(name, kColour, kCorners, 4, GL_UNSIGNED_BYTE, offsetof(Corner, colour));
  if (instances) {
    attribute(name, kPlace, kInstances, 3, GL_FLOAT, offsetof(CarInstance, position));
    attribute(name, kForward, kInstances, 2, GL_FLOAT, offsetof(CarInstance, forward));
    attribute(name, kTint, kInstances, 4, GL_UNSIGNED_BYTE, offsetof(CarInstance, tint));
    glVertexArrayBindingDivisor(name, kInstances, 1);
  }
  return array;
}

/// Two triangles, far beyond every city, a little under it.
gl::Buffer make_ground() {
  constexpr float kFar = 20'000, kUnder = -0.2F;
  const std::uint32_t colour = pack(kGround);
  const std::array<Corner, 4> strip{Corner{{-kFar, -kFar, kUnder}, colour}, Corner{{kFar, -kFar, kUnder}, colour},
                                    Corner{{-kFar, kFar, kUnder}, colour}, Corner{{kFar, kFar, kUnder}, colour}};
  return gl::make_buffer(std::as_bytes(std::span(strip)));
}

GLuint indices_of(const Geometry& geometry, const ObjectRun& run) {
  return geometry.first_index[run.last] - geometry.first_index[run.first];
}
GLuint corners_of(const Geometry& geometry, const ObjectRun& run) {
  return geometry.first_corner[run.last] - geometry.first_corner[run.first];
}

/// Geometry on its way to the device: copies runs of a Geometry into the stream, one after the other.
class Sender {
 public:
  Sender(StreamBuffer& stream, std::size_t corners, std::size_t indices)
      : corners_(stream.take<Corner>(corners)), indices_(stream.take<std::uint32_t>(indices)) {}

  /// The command that draws the copy.
  DrawCommand send(const Geometry& from, const ObjectRun& run) {
    const GLuint corners = corners_of(from, run), indices = indices_of(from, run);
    const GLuint first = from.first_corner[run.first];
    std::memcpy(corners_.items + corners_sent_, from.corners.data() + first, corners * sizeof(Corner));
    std::memcpy(indices_.items + indices_sent_, from.indices.data() + from.first_index[run.first],
                indices * sizeof(std::uint32_t));
    const DrawCommand command{indices, 1, first_index() + indices_sent_,
                              static_cast<GLint>(corners_sent_) - static_cast<GLint>(first), 0};
    corners_sent_ += corners;
    indices_sent_ += indices;
    return command;
  }

  GLintptr corners_offset() const { return corners_.offset; }

 private:
  GLuint first_index() const { return static_cast<GLuint>(indices_.offset / GLintptr{sizeof(std::uint32_t)}); }

  StreamBuffer::Taken<Corner> corners_;
  StreamBuffer::Taken<std::uint32_t> indices_;
  GLuint corners_sent_ = 0, indices_sent_ = 0;
};

struct Size {
  std::size_t corners = 0, indices = 0;
};

Size size_of(const Geometry& geometry, std::span<const ObjectRun> runs) {
  Size size;
  for (const ObjectRun& run : runs) {
    size.corners += corners_of(geometry, run);
    size.indices += indices_of(geometry, run);
  }
  return size;
}

std::size_t stream_bytes(const Size& size) {
  return StreamBuffer::padded(size.corners * sizeof(Corner)) +
         StreamBuffer::padded(size.indices * sizeof(std::uint32_t));
}

ObjectRun level_run(std::size_t level) {
  return {static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(level + 1)};
}

/// A mesh a car.
Size size_of(const Fleet& fleet, const SeenCars& cars) {
  Size size;
  for (std::size_t i = 0; i < cars.count.size(); ++i) {
    size.corners += std::size_t{cars.count[i]} * corners_of(fleet.geometry, level_run(i));
    size.indices += std::size_t{cars.count[i]} * indices_of(fleet.geometry, level_run(i));
  }
  return size;
}

}  // namespace

/// A multi-draw: where its corners, indices and commands lie.
struct Stage::Batch {
  GLuint corners, indices;  ///< buffers
  GLintptr corners_offset;
  GLintptr commands_offset;
  std::size_t commands;
};

void CityModel::put_on_device() {
  if (corners.name() != 0) return;
  corners = gl::make_buffer(std::as_bytes(std::span(geometry.corners)));
  indices = gl::make_buffer(std::as_bytes(std::span(geometry.indices)));
}

Fleet::Fleet(std::span<const CarLevel> levels) {
  for (const CarLevel& level : levels) append(geometry, make_car(level.triangles));
  corners = gl::make_buffer(std::as_bytes(std::span(geometry.corners)));
  indices = gl::make_buffer(std::as_bytes(std::span(geometry.indices)));
}

std::size_t stream_bytes(const CityModel& city, std::span<const ObjectRun> runs, const Fleet& fleet,
                         const SeenCars& cars, Residency residency) {
  const std::size_t cars_seen = cars.instances.size(), car_commands = std::max(cars_seen, cars.count.size());
  return (residency == Residency::resident ? 0 : stream_bytes(size_of(city.geometry, runs))) +
         (residency == Residency::resent ? stream_bytes(size_of(fleet, cars)) : 0) +
         StreamBuffer::padded(cars_seen * sizeof(CarInstance)) +
         StreamBuffer::padded(car_commands * sizeof(DrawCommand)) +
         StreamBuffer::padded(runs.size() * sizeof(DrawCommand));
}

std::uint64_t triangles(const Geometry& geometry, std::span<const ObjectRun> runs) {
  return size_of(geometry, runs).indices / 3;
}

Stage::Stage(int width, int height)
    : target_(gl::make_target(width, height, 1)),
      program_(gl::make_program("paper", {shaders::paper_vert}, {shaders::paper_frag})),
      in_place_(make_array(false)),
      placed_(make_array(true)),
      ground_(make_ground()) {}

void Stage::draw(const CityModel& city, std::span<const ObjectRun> runs, const Fleet& fleet, const SeenCars& cars,
                 const culling::View& view, Residency residency) {
  stream_.begin(stream_bytes(city, runs, fleet, cars, residency));
  begin_frame(view);
  draw_city(city, runs, residency == Residency::resident);
  if (!cars.instances.empty()) draw_cars(fleet, cars, residency != Residency::resent);
  draw_ground();
  stream_.end();
}

void Stage::begin_frame(const culling::View& view) {
  const Vec4 sky(kSky, 1);
  const float farthest = 0;
  gl::bind(target_);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearNamedFramebufferfv(target_.framebuffer.name(), GL_COLOR, 0, &sky.x);
  glClearNamedFramebufferfv(target_.framebuffer.name(), GL_DEPTH, 0, &farthest);
  glUseProgram(program_.name());
  const Mat4 matrix(draw::camera_of(view).view_projection);
  const Vec3 eye(view.eye);
  glUniformMatrix4fv(0, 1, GL_FALSE, &matrix[0].x);
  glUniform3fv(1, 1, &eye.x);
  glVertexAttrib3f(kPlace, 0, 0, 0);
  glVertexAttrib2f(kForward, 0, 1);
  glVertexAttrib4f(kTint, 1, 1, 1, 1);
}

void Stage::submit(GLuint array, const Batch& batch) {
  glVertexArrayVertexBuffer(array, kCorners, batch.corners, batch.corners_offset, sizeof(Corner));
  glVertexArrayElementBuffer(array, batch.indices);
  glBindVertexArray(array);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, stream_.name());
  const void* commands = reinterpret_cast<const void*>(batch.commands_offset);
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, commands, static_cast<GLsizei>(batch.commands), 0);
}

void Stage::draw_city(const CityModel& city, std::span<const ObjectRun> runs, bool resident) {
  const Geometry& geometry = city.geometry;
  const auto commands = stream_.take<DrawCommand>(runs.size());
  if (resident) {
    std::transform(runs.begin(), runs.end(), commands.items, [&](const ObjectRun& run) {
      return DrawCommand{indices_of(geometry, run), 1, geometry.first_index[run.first], 0, 0};
    });
    return submit(in_place_.name(), {city.corners.name(), city.indices.name(), 0, commands.offset, runs.size()});
  }
  const Size size = size_of(geometry, runs);
  Sender sender(stream_, size.corners, size.indices);
  std::transform(runs.begin(), runs.end(), commands.items,
                 [&](const ObjectRun& run) { return sender.send(geometry, run); });
  submit(in_place_.name(), {stream_.name(), stream_.name(), sender.corners_offset(), commands.offset, runs.size()});
}

void Stage::draw_cars(const Fleet& fleet, const SeenCars& cars, bool resident) {
  const auto instances = stream_.take<CarInstance>(cars.instances.size());
  std::copy(cars.instances.begin(), cars.instances.end(), instances.items);
  glVertexArrayVertexBuffer(placed_.name(), kInstances, stream_.name(), instances.offset, sizeof(CarInstance));
  const auto commands = stream_.take<DrawCommand>(std::max(cars.instances.size(), cars.count.size()));
  GLuint car = 0;
  if (resident) {
    for (std::size_t level = 0; level < cars.count.size(); car += cars.count[level++])
      commands.items[level] = {indices_of(fleet.geometry, level_run(level)), cars.count[level],
                               fleet.geometry.first_index[level], 0, car};
    return submit(placed_.name(), {fleet.corners.name(), fleet.indices.name(), 0, commands.offset, cars.count.size()});
  }
  const Size size = size_of(fleet, cars);
  Sender sender(stream_, size.corners, size.indices);
  for (std::size_t level = 0; level < cars.count.size(); ++level) {
    for (const GLuint end = car + cars.count[level]; car < end; ++car) {
      commands.items[car] = sender.send(fleet.geometry, level_run(level));
      commands.items[car].base_instance = car;
    }
  }
  submit(placed_.name(), {stream_.name(), stream_.name(), sender.corners_offset(), commands.offset, car});
}

void Stage::draw_ground() {
  glVertexArrayVertexBuffer(in_place_.name(), kCorners, ground_.name(), 0, sizeof(Corner));
  glBindVertexArray(in_place_.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

std::vector<unsigned char> Stage::read_pixels() const {
  const std::size_t row = 3 * static_cast<std::size_t>(target_.width);
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(target_.height)), flipped;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.framebuffer.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, target_.width, target_.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t y = pixels.size(); y > 0; y -= row)
    flipped.insert(flipped.end(), pixels.begin() + static_cast<std::ptrdiff_t>(y - row),
                   pixels.begin() + static_cast<std::ptrdiff_t>(y));
  return flipped;
}

}  // namespace manzana::paper
