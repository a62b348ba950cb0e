#pragma once
/// Draws what is visible: geometry resident on the GPU, one multi-draw-indirect for each kind of thing, no allocation,
/// no read-back and no call per object in a frame. Reversed infinite depth; the camera is double, the GPU sees floats
/// relative to it. A context must be current and stay the same one.
///   Renderer renderer(scene, plants, quality_for(gl::renderer_name()));
///   renderer.resize({1280, 720});
///   FrameCounts counts = renderer.draw(scene, sets, view, options);
///   renderer.present(0);                                             // to the window's framebuffer
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "culling/frustum.h"
#include "foliage/detail.h"
#include "foliage/grove.h"
#include "foliage/ldm_pack.h"
#include "scenegraph/draw/camera.h"
#include "scenegraph/scene.h"
#include "scenegraph/visible.h"

namespace manzana::draw {

/// How much speed is given for accuracy. By the renderer's name, never by measured time, so that two runs give equal
/// pictures. fast, balanced and accurate are points of the front that manzana-foliage-benchmark --trade measures
/// (quality.csv: errors within twice the limits, once, half of them); exact leaves nothing out.
struct Quality {
  std::string name = "balanced";
  int samples = 4;           ///< 1: no multisampling; at most what the device has
  double tree_error_px = 1;  ///< in cars and levels of buildings, too
  foliage::Law tree_law = foliage::Law::ours;
};
Quality quality_for(std::string_view renderer);  ///< balanced; of software renderers fast, with one sample
Quality quality_named(std::string_view name);    ///< throws std::invalid_argument, which names those that there are
std::vector<std::string> quality_names();        ///< from fast to exact

struct Layers {
  bool buildings = true, surfaces = true, trees = true, cars = true, sky = true, fog = true;
};

struct DrawOptions {
  Layers layers;
  Vec3d sun{0.45, -0.55, 0.70};  ///< towards the sun, in L; need not be of unit length; the lower, the redder
  double tree_error_px = 0;      ///< what is smaller may be wrong, in cars and buildings, too; 0: what the quality says
  double tree_vertices = 0;      ///< at most so many in all trees: the error grows until they suffice; 0: no limit
  std::optional<foliage::Law> tree_law = {};  ///< none: the quality's
  bool trees_by_node = false;    ///< each visible node dispatches its own extraction: same picture, for comparison
  bool mosaics = true;           ///< far trees as mosaics, of those plants that have a pack: packs_wanted()
  bool groves = true;            ///< blocks of very small trees as one, where there is a grove: groves_wanted()
  double wind = 0;               ///< strength, 0 to 1
  double seconds = 0;            ///< of the wind
  double fog_distance_m = 4000;  ///< where half of the light is the air's
  std::size_t upload_bytes = static_cast<std::size_t>(-1);  ///< of meshes and the ground's photo, in this frame;
                                                            ///< meshes that wait are hidden
  bool transparent = false;  ///< where nothing stands, without a sky, alpha is 0; else the horizon's colour
  /// Debug view: volumes of the tree for this frustum, drawn as lines over what is drawn for the view. nullptr: none.
  const culling::View* frozen = nullptr;
};

struct FrameCounts {
  std::uint64_t triangles = 0;  ///< submitted; of trees mosaics alone: the GPU chooses the others
  std::uint64_t points = 0;     ///< of groves
  std::uint64_t buildings = 0, surfaces = 0, trees = 0, cars = 0, nodes = 0;
  std::uint64_t commands = 0;            ///< of multi-draws
  std::uint64_t bytes_to_bring = 0;      ///< of meshes in sight and the ground's photo that wait for a later frame
  std::uint64_t bytes_without_room = 0;  ///< of meshes in sight
  double tree_error_px = 0;              ///< that was tolerated in trees, after the budget and what memory has room for
  foliage::Law tree_law = foliage::Law::ours;  ///< ours in place of what there was no room for
};

struct Size {
  int width = 0, height = 0;
};

/// Pixels, from the lower left corner.
struct PixelRect {
  int x = 0, y = 0, width = 1, height = 1;
};

/// How a picture is laid over a host's.
struct Overlay {
  PixelRect viewport;  ///< of the host's framebuffer
  /// The host's depth, 0 to 1, of one of ours, 1 to 0: scale * ours + offset.
  double depth_scale = 1, depth_offset = 0;
  bool nearer_is_less = false;  ///< of the host's
  bool linear = false;          ///< it encodes what is written (GL_FRAMEBUFFER_SRGB); else it is given sRGB values
};

/// Bytes of buffers and pictures, about.
struct DeviceMemory {
  std::size_t meshes = 0;             ///< the city's buffers
  std::size_t meshes_held = 0;        ///< of these, what is filled
  std::size_t meshes_seen = 0;        ///< of all that was in sight since the start, held or not
  std::size_t meshes_all = 0;         ///< of the whole city, were it held
  std::size_t meshes_missing = 0;     ///< in sight now, and without room
  std::size_t plants = 0, lists = 0;  ///< of trees
  std::size_t packs = 0, groves = 0;
  std::size_t photo = 0;     ///< of the ground
  std::size_t textures = 0;  ///< what buildings wear
  std::size_t nodes = 0, stream = 0, pictures = 0;
  std::size_t sum() const {
    return meshes + plants + lists + packs + groves + photo + textures + nodes + stream + pictures;
  }
};

inline constexpr std::uint32_t kOwnColour = ~0U;

/// A part of a block whose trees could be one (scenegraph/draw/groves.h), and the level of it (foliage/grove.h).
struct GroveWanted {
  std::uint32_t part, level;
  auto operator<=>(const GroveWanted&) const = default;
};

/// A picture of Scene::pictures, and the side of its square.
struct PictureWanted {
  std::uint32_t picture, side;
  auto operator<=>(const PictureWanted&) const = default;
};

class Renderer {
 public:
  /// `plants`: by TreeInstance::plant; those that no tree is may be empty. Meshes come when they are first in sight,
  /// and go when all would be more than about `gpu_bytes`; 0: no limit. Throws std::runtime_error when a shader does
  /// not compile (with its log) or the plants do not fit the device's buffers.
  Renderer(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const Quality& quality,
           std::size_t gpu_bytes = 0);
  /// Brings meshes of sets.to_bring(), as draw() does, ahead of it; returns how many bytes are left.
  std::size_t bring(const Scene& scene, const VisibleSets& sets, std::size_t most_bytes);
  bool holds_building(std::uint32_t row) const;  ///< its mesh is on the device, or a level's; no GL
  DeviceMemory memory() const;                   ///< no GL
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// The framebuffer of that size, at least 1 x 1, is drawn into from now on: of several screens each keeps its own.
  void resize(Size size, std::size_t screen = 0);
  /// Chooses levels and draws into the renderer's own framebuffer.
  /// `nodes`: what Nodes::find says of sets.nodes().
  FrameCounts draw(const Scene& scene, const VisibleSets& sets, const Camera& camera, const DrawOptions& options,
                   std::span<const SeenNode> nodes = {});
  FrameCounts draw(const Scene& scene, const VisibleSets& sets, const culling::View& view, const DrawOptions& options) {
    return draw(scene, sets, camera_of(view), options);
  }
  /// Plants without a pack whose trees were small in the last picture: foliage/far_pack.h makes packs, anywhere and any
  /// time (far_tree_maker.h); until then their trees are drawn as near ones are. False: it has one.
  std::span<const std::uint32_t> packs_wanted() const;
  bool add_pack(std::uint32_t plant, foliage::LdmPack pack);
  std::map<std::uint32_t, foliage::LdmPack> take_packs();  ///< all, by plant, before it goes: nothing is drawn any more
  /// Blocks whose trees were so small in the last picture that they could be one: make_grove() (groves.h) makes groves
  /// of their sites, anywhere and any time. add_grove() is an upload; groves out of sight make room.
  std::span<const GroveWanted> groves_wanted() const;
  std::shared_ptr<const std::vector<foliage::TreeSite>> sites() const;     ///< of all trees
  bool add_grove(const GroveWanted& wanted, const foliage::Grove& grove);  ///< false: no room
  /// Pictures that the last picture showed in their mean colours, or coarser than its pixels: picture_square() (import/
  /// picture_square.h) makes their squares, anywhere and any time (picture_maker.h). add_picture() is an upload; what
  /// is out of sight makes room. False: no room, or it is there.
  std::span<const PictureWanted> pictures_wanted() const;
  bool add_picture(const PictureWanted& wanted, const PictureSquare& square);
  /// What was drawn of trees, by the newest frame that the GPU has finished: the last one after glFinish.
  foliage::Shown trees_shown() const;
  void present(unsigned framebuffer);  ///< copies the picture there, same size, at (0, 0)
  /// Lays the picture over what the bound framebuffer shows, premultiplied, and its depth beside what is there: what is
  /// nearer stays. Leaves GL's state changed.
  void overlay(const Overlay& how);
  /// Of a pixel of that screen, after overlay(): 1 near, 0 where nothing stands. Waits for the GPU.
  double depth_at(std::size_t screen, int x, int y) const;
  /// Of each pixel of a rectangle of the picture the number of the tree's object (BqrTree) that is seen there, plus 1;
  /// 0 of none. Trees are picked by their crowns. Rows from the bottom. Waits for the GPU.
  std::vector<std::uint32_t> pick(const Scene& scene, const VisibleSets& sets, const Camera& camera,
                                  const PixelRect& rect, std::span<const SeenNode> nodes = {});
  /// Other colours, 0xRRGGBB, a row a building; kOwnColour: its own.
  void paint_buildings(const Scene& scene, std::span<const std::uint32_t> colours);
  /// Meshes of nodes that are not there yet, at most so many bytes, but at least one; returns how many are left.
  std::size_t bring(std::span<const SeenNode> nodes, std::size_t most_bytes);
  /// The picture as RGB bytes, rows from the top. Waits for the GPU; not for use in a frame.
  std::vector<unsigned char> read_pixels();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace manzana::draw
