#include <catch2/catch.hpp>

#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace manzana::gl {

TEST_CASE("a context without a window has OpenGL 4.5, and another one after it") {
  for (int i = 0; i < 2; ++i) {
    const HeadlessContext context;
    CHECK(!renderer_name().empty());
    GLint major = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    CHECK(major == 4);
  }
}

TEST_CASE("a shader that does not compile says which, and the driver's reason") {
  const HeadlessContext context;
  constexpr std::string_view kVersion = "#version 450 core\n";
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(make_program("broken", {kVersion, "void main() { gl_Position = nothing; }"}, {kVersion}),
                    Contains("broken.vert") && Contains("nothing"));
  CHECK_THROWS_WITH(make_program("unlinked", {kVersion, "void main() { gl_Position = vec4(0); }"},
                                 {kVersion, "in vec3 missing; out vec4 c; void main() { c = vec4(missing, 1); }"}),
                    Contains("unlinked"));
}

TEST_CASE("the error log hears what is wrong") {
  const HeadlessContext context;
  ErrorLog log;
  CHECK(log.messages().empty());
  glEnable(GL_TEXTURE_CUBE_MAP_POSITIVE_X);
  CHECK(!log.messages().empty());
}

TEST_CASE("the stream's items arrive, also after it has grown, and offsets are aligned") {
  const HeadlessContext context;
  StreamBuffer stream;
  for (std::uint32_t frame = 0; frame < 10; ++frame) {
    const std::size_t n = 100 + 1000 * (frame / 4);
    stream.begin(StreamBuffer::padded(1) + StreamBuffer::padded(n * sizeof(std::uint32_t)));
    stream.take<std::uint8_t>(1);
    const auto taken = stream.take<std::uint32_t>(n);
    for (std::size_t i = 0; i < n; ++i) taken.items[i] = frame * 100000 + static_cast<std::uint32_t>(i);
    CHECK(taken.offset % 256 == 0);
    std::vector<std::uint32_t> back(n);
    glGetNamedBufferSubData(stream.name(), taken.offset, static_cast<GLsizeiptr>(n * sizeof(std::uint32_t)),
                            back.data());
    CHECK(back.back() == frame * 100000 + n - 1);
    stream.end();
  }
}

TEST_CASE("a multisampled target resolves to its picture") {
  const HeadlessContext context;
  const Target target = make_target(8, 4, 4);
  bind(target);
  const std::array<float, 4> half{0.5F, 0.5F, 0.5F, 1};
  glEnable(GL_FRAMEBUFFER_SRGB);
  glClearNamedFramebufferfv(target.framebuffer.name(), GL_COLOR, 0, half.data());
  resolve(target);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.picture().name());
  std::array<unsigned char, 4> pixel{};
  glReadPixels(3, 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  CHECK(std::abs(pixel[0] - 188) <= 1);  // sRGB of one half
}

}  // namespace manzana::gl
