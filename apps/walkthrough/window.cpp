#include "apps/walkthrough/window.h"

// GLFW must not bring a GL header of its own beside glad's.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <glad/gl.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/walkthrough/camera_controller.h"
#include "apps/walkthrough/caption.h"
#include "apps/walkthrough/frame.h"
#include "apps/walkthrough/overlay.h"
#include "apps/walkthrough/recorder.h"
#include "gl/context.h"

namespace manzana::walkthrough {
namespace {

constexpr double kHelpSeconds = 8, kMessageSeconds = 5;
constexpr double kRadiansAPixel = 0.0022;
constexpr double kLongestStep = 0.1;  // seconds: after a stall the camera must not leap

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

GLFWwindow* open_window(draw::Size size) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the renderer has its own framebuffer
  GLFWwindow* window = glfwCreateWindow(size.width, size.height, "Manzana", nullptr, nullptr);
  if (window == nullptr) throw std::runtime_error("no window with OpenGL 4.5: " + glfw_error());
  glfwMakeContextCurrent(window);
  return window;
}

draw::Size framebuffer_size(GLFWwindow* window) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  return {std::max(width, 1), std::max(height, 1)};  // 0 x 0 while it is minimised
}

/// The window and Dear ImGui in it. The context lives as long.
struct WindowHandle {
  explicit WindowHandle(draw::Size size) : window(open_window(size)) {
    gl::load_functions(glfwGetProcAddress);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  }
  ~WindowHandle() {
    if (backends) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
    }
    ImGui::DestroyContext();
    glfwDestroyWindow(window);
  }
  WindowHandle(const WindowHandle&) = delete;
  WindowHandle& operator=(const WindowHandle&) = delete;
  /// After our own callbacks are set: ImGui's call them.
  void start_backends() {
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 450");
    backends = true;
  }
  GLFWwindow* window;
  bool backends = false;
};

/// Everything that keys and frames change.
struct Session {
  GLFWwindow* window;
  const Options& options;
  const CameraPath& path;
  Stage stage;
  Camera camera{};
  PanelState panel{};
  Recorder recorder{};
  std::optional<culling::View> frozen{};
  bool help = false, show_panel = false, caught = false, told_missing = false;
  double now = 0, wheel = 0;
  Vec2d cursor{0, 0};
  std::string message{};
  double message_until = 0;
};

void say(Session& session, std::string text) {
  session.message = std::move(text);
  session.message_until = session.now + kMessageSeconds;
}

void catch_mouse(Session& session, bool caught) {
  session.caught = caught;
  glfwSetInputMode(session.window, GLFW_CURSOR, caught ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  glfwGetCursorPos(session.window, &session.cursor.x, &session.cursor.y);
  auto& flags = ImGui::GetIO().ConfigFlags;
  flags = caught ? flags | ImGuiConfigFlags_NoMouse : flags & ~ImGuiConfigFlags_NoMouse;
}

culling::View current_view(const Session& session) {
  const LocalFrame& frame = session.stage.scene.frame;
  return view_of(frame, pose_of(session.camera, frame), session.stage.aspect());
}

void toggle_freeze(Session& session) {
  session.frozen = session.frozen ? std::nullopt : std::optional(current_view(session));
  session.stage.options.frozen = session.frozen ? &*session.frozen : nullptr;
  say(session, session.frozen ? "frozen: fly off and look at what is drawn" : "culling follows the camera again");
}

void toggle_structure(Session& session) {
  Structure& structure = session.stage.structure;
  structure = structure == Structure::bqr ? Structure::none : Structure::bqr;
  say(session, std::string("structure: ") + name_of(structure));
}

void take_screenshot(Session& session) {
  Picture picture{session.stage.size, session.stage.renderer.read_pixels()};
  draw_caption(picture, session.stage.scene.attribution);
  const auto file = free_name(".", "manzana-", ".png");
  write_png(file, picture);
  say(session, "screenshot: " + std::filesystem::absolute(file).lexically_normal().string());
}

void toggle_recording(Session& session) {
  if (!session.recorder.on()) {
    session.recorder.start(session.now);
    return say(session, "recording a path: F6 stops");
  }
  say(session, "path: " + std::filesystem::absolute(session.recorder.stop(session.options.out)).string());
}

void escape(Session& session) {
  if (!session.caught) glfwSetWindowShouldClose(session.window, GLFW_TRUE);
  catch_mouse(session, false);
}

void press(Session& session, int key) {
  const std::uint64_t tick = ticks(session.now);
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return escape(session);
    case GLFW_KEY_F:
    case GLFW_KEY_TAB:
      return toggle_fly(session.camera);
    case GLFW_KEY_G:
      return toggle_drive(session.camera, session.stage.scene, tick);
    case GLFW_KEY_P:
      return toggle_path(session.camera, session.path);
    case GLFW_KEY_F1:
      session.help = !session.help;
      return;
    case GLFW_KEY_F2:
      session.show_panel = !session.show_panel;
      return catch_mouse(session, !session.show_panel);
    case GLFW_KEY_F3:
      return toggle_freeze(session);
    case GLFW_KEY_F5:
      return toggle_structure(session);
    case GLFW_KEY_F6:
      return toggle_recording(session);
    case GLFW_KEY_F12:
      return take_screenshot(session);
    default:
      return;
  }
}

Session& session_of(GLFWwindow* window) { return *static_cast<Session*>(glfwGetWindowUserPointer(window)); }

/// No exception may pass through GLFW, which is C: a file that cannot be written is a message.
void on_key(GLFWwindow* window, int key, int, int action, int) {
  Session& session = session_of(window);
  if (action != GLFW_PRESS || ImGui::GetIO().WantTextInput) return;
  try {
    press(session, key);
  } catch (const std::exception& error) {
    say(session, error.what());
  }
}

void on_scroll(GLFWwindow* window, double, double y) {
  if (session_of(window).caught) session_of(window).wheel += y;
}

void on_button(GLFWwindow* window, int, int action, int) {
  if (action == GLFW_PRESS && !ImGui::GetIO().WantCaptureMouse) catch_mouse(session_of(window), true);
}

Steering read_steering(Session& session) {
  const auto down = [&](int key) { return glfwGetKey(session.window, key) == GLFW_PRESS; };
  const auto axis = [&](int plus, int plus2, int minus, int minus2) {
    return static_cast<double>(down(plus) || down(plus2)) - static_cast<double>(down(minus) || down(minus2));
  };
  Steering steering;
  steering.move = {axis(GLFW_KEY_D, GLFW_KEY_RIGHT, GLFW_KEY_A, GLFW_KEY_LEFT),
                   axis(GLFW_KEY_W, GLFW_KEY_UP, GLFW_KEY_S, GLFW_KEY_DOWN),
                   axis(GLFW_KEY_E, GLFW_KEY_SPACE, GLFW_KEY_Q, GLFW_KEY_C)};
  steering.run = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
  steering.wheel = std::exchange(session.wheel, 0);
  Vec2d cursor;
  glfwGetCursorPos(session.window, &cursor.x, &cursor.y);
  const Vec2d moved = cursor - std::exchange(session.cursor, cursor);
  if (session.caught) steering.turn = Vec2d(moved.x, -moved.y) * kRadiansAPixel;
  return steering;
}

void draw_overlay(Session& session) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  const bool vsync = session.panel.vsync;
  if (session.show_panel) draw_panel(session.panel, session.stage, session.camera);
  if (vsync != session.panel.vsync) glfwSwapInterval(session.panel.vsync ? 1 : 0);
  if (session.help || session.now < kHelpSeconds) draw_key_help();
  draw_attribution(session.stage.scene.attribution);
  if (session.now < session.message_until) draw_message(session.message);
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const bool srgb = glIsEnabled(GL_FRAMEBUFFER_SRGB) == GL_TRUE;  // ImGui's colours are encoded already
  glDisable(GL_FRAMEBUFFER_SRGB);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (srgb) glEnable(GL_FRAMEBUFFER_SRGB);
}

/// One frame: input -> camera -> cull, cars, draw -> present.
void show_frame(Session& session) {
  glfwPollEvents();
  const double now = glfwGetTime(), passed = now - std::exchange(session.now, now);
  session.stage.resize(framebuffer_size(session.window));
  session.stage.wait = session.show_panel;  // only who reads the times pays for exact ones
  steer(session.camera, session.stage.scene, session.path, read_steering(session), std::min(passed, kLongestStep),
        ticks(now));
  session.recorder.take(now, pose_of(session.camera, session.stage.scene.frame));
  const FrameRow row = draw_frame(session.stage, current_view(session), now);
  session.stage.renderer.present(0);
  take_in(session.panel, row, passed);
  if (row.trees_missing > 0 && !std::exchange(session.told_missing, true)) say(session, kTreesMissing);
  if (row.meshes_missing > 0 && !std::exchange(session.told_missing, true)) say(session, kMeshesMissing);
  draw_overlay(session);
  glfwSwapBuffers(session.window);
}

void set_callbacks(Session& session) {
  glfwSetWindowUserPointer(session.window, &session);
  glfwSetKeyCallback(session.window, on_key);
  glfwSetScrollCallback(session.window, on_scroll);
  glfwSetMouseButtonCallback(session.window, on_button);
}

}  // namespace

Display::Display(bool unwanted) : open_(!unwanted && glfwInit() == GLFW_TRUE) {}
Display::~Display() {
  if (open_) glfwTerminate();
}

void run_window(const Options& options, const Imported& city, std::span<const foliage::PreparedPlant> plants,
                const CameraPath& path) {
  WindowHandle handle(options.size);
  const auto quality =
      options.quality.empty() ? draw::quality_for(gl::renderer_name()) : draw::quality_named(options.quality);
  Session session{handle.window, options, path,
                  Stage(city.scene, plants, quality, framebuffer_size(handle.window), gpu_bytes(options))};
  apply(options, session.stage);
  if (options.packs) make_far_trees(session.stage, plants);
  stand_at(session.camera, city.scene.frame, pose_at(path, path.begin()));
  set_callbacks(session);
  handle.start_backends();
  catch_mouse(session, true);
  glfwSwapInterval(1);
  glfwSetTime(0);
  while (glfwWindowShouldClose(handle.window) == GLFW_FALSE) show_frame(session);
}

}  // namespace manzana::walkthrough
