#pragma once
/// A city in a window of another program's. The host owns the window, the GL 4.5 context, the framebuffer, the camera
/// and the threads.
///   View view({.request_repaint = [&] { widget.update(); }});
///   view.show(Model::load("city.osm.pbf", {}));               // any thread
///   ...in the host's paint event, its context current, its framebuffer bound:
///   view.update({{{projection, view_matrix, ClipDepth::minus_one_to_one, {0, 0, width, height}}}}, seconds);
///   view.render(0);
///   ...before the context goes:  view.release();              // or, when it is gone: view.context_lost();
/// Threads: show() from any; all else from one at a time. Views share nothing that changes: each may have its thread
/// and context. render(), pick(), place() and release() call GL, nothing else does; what they find of state they put
/// back.
/// Errors: render() throws std::runtime_error when the device cannot do what is needed, std::invalid_argument for a
/// quality that there is none of. The city that was to come is dropped then, once; show() may try again.
#include <glm/mat4x4.hpp>

#include "culling/host_camera.h"
#include "manzana/model.h"
#include "scenegraph/draw/far_tree_maker.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/nodes.h"

namespace manzana {

/// What the host lends. Any of it may be missing.
struct Host {
  std::function<void(const std::string& line)> log =
      {};  ///< things to know, a line each; from the thread that they happen on
  /// Another picture would differ. From show(), from render(), and from tasks, but not between release() and the next
  /// update(). It must not call the view.
  std::function<void()> request_repaint = {};
  /// Runs a task once, on another thread of the host's, some time. What far trees need is made there: packs of species,
  /// a second's work each, groves of blocks, some milliseconds; and pictures that buildings wear are decoded. A task
  /// may outlast the view. Without: threads of the view's own, which are there while far trees lack something; none
  /// where drawing() has neither mosaics nor groves.
  draw::Run run = {};
  /// As eglGetProcAddress and glfwGetProcAddress are; without one EGL's. Asked once a process.
  void (*(*get_proc_address)(const char* name))() = nullptr;
};

struct ViewOptions {
  /// At most about so many bytes of the device; 0: no limit. What was not seen for longest gives way. Where even plants
  /// and pictures need more, the city is not shown, and the log says so.
  std::uint64_t gpu_bytes = 0;
  std::uint64_t upload_bytes_a_frame = 8 << 20;  ///< of one render()
  std::string quality = {};                      ///< fast, balanced, accurate, exact; empty: by the device
  bool linear_framebuffer = false;               ///< the host's encodes what is written, as GL_FRAMEBUFFER_SRGB does
};

/// clip = projection * view * p, p in the model's frame L. Perspective or orthographic, skewed, any depth.
struct HostCamera {
  glm::dmat4 projection{1}, view{1};
  culling::ClipDepth depth = culling::ClipDepth::minus_one_to_one;
  draw::PixelRect viewport;  ///< in the host's framebuffer
};

/// What the next pictures will show, and what is still missing. Not counted: what stands behind buildings.
struct Update {
  struct Seen {
    std::uint64_t blocks = 0, buildings = 0, surfaces = 0, trees = 0, cars = 0, nodes = 0;
  };
  std::vector<Seen> cameras;
  std::uint64_t bytes_to_upload = 0;  ///< of what is in sight; 0: all is there
  std::uint64_t far_trees_left = 0;   ///< packs and groves that are being made
  std::uint64_t pictures_left = 0;    ///< likewise what buildings wear, in mean colours until then
  std::uint64_t gpu_bytes = 0;        ///< held of the device
  bool shown = false;                 ///< the city is drawn; new ones start hidden
};

class View {
 public:
  explicit View(Host host = {}, const ViewOptions& options = {});
  /// Makes no GL call: what was not released is given up, and logged.
  ~View();
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// The city to draw; nullptr: none. What was shown stays until the new one is on the device.
  /// `nodes`: what the host has put into it, made for model->scene(). It may change them between frames, on the thread
  /// that updates, and asks for a repaint itself. Their meshes go up as they are seen.
  void show(std::shared_ptr<const Model> model, std::shared_ptr<const Nodes> nodes = {});

  /// Finds what each camera sees, `seconds` after the start of the traffic. No GL, no allocation from the second time
  /// on.
  const Update& update(std::span<const HostCamera> cameras, double seconds);

  /// Draws what camera `i` of the last update sees into the bound framebuffer, over what is there, by its depth.
  void render(std::size_t i);

  /// The last render() lacked nothing that was in sight, and nothing else was asked for since: what it drew is final,
  /// until something moves. No GL.
  bool complete() const;

  /// What stands in each pixel of a rectangle of camera i's viewport, rows from the bottom, into the host's memory:
  /// features, and nodes by their NodeId.
  void pick(std::size_t i, const draw::PixelRect& rect, std::span<FeatureId> ids);

  /// Where that is which stands in a pixel of camera i's viewport, in L, by the depth that was last rendered there.
  std::optional<Vec3d> place(std::size_t i, int x, int y);

  /// Only what is of one of these classes (scenegraph/classes.h) is found, counted, drawn and picked from now on.
  void show_only(culling::ClassMask classes);

  /// Buildings of the city in other colours, 0xRRGGBB, by whatever the host makes of them; none: their own. Asked for
  /// each building of what is shown, and of each city that comes after, in render(). Empty: all in their own again.
  ///   view.colour_by([](const Feature& f) { return f.attributes.find("heritage") ? Colour(0xd03020) : Colour(); });
  using Colour = std::optional<std::uint32_t>;
  void colour_by(std::function<Colour(const Feature&)> colour);

  /// How it is drawn from now on: layers, sun, error of trees, wind. Without sky unless asked.
  draw::DrawOptions& drawing();
  const draw::DrawOptions& drawing() const;

  void release() noexcept;  ///< with the context current: frees all of the device. It may be drawn again. A thread of
                            ///< the view's own ends first: a second, at most
  void context_lost() noexcept;  ///< the context is gone: nothing is asked of it. It may be drawn again in another

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace manzana
