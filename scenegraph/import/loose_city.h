#pragma once
/// A city on its way to a scene, before it has a tree: blocks in any order, and what is in them. Made from features
/// (build_scene.cpp), or from a scene that is there already, so that several become one.
///   LooseCity city = loosened(a, a.frame);             // each in the frame of the first
///   join(city, loosened(b, a.frame));
///   Imported all = assemble(std::move(city));
#include "scenegraph/import/import.h"
#include "scenegraph/import/layers.h"

namespace manzana {

/// Rows of `attributes` and numbers of `blocks` are what the objects name.
struct LooseCity {
  LocalFrame frame;
  std::vector<BlockFrame> blocks;
  std::vector<MeshObject> buildings, surfaces;
  std::vector<TreeObject> trees;
  Traffic traffic;
  Attributes attributes;
  Pictures pictures;
  std::string attribution;
  std::vector<Issue> issues;
};

/// The tree, and everything in its order. The report lacks what it says of fallback blocks, and the time.
Imported assemble(LooseCity city);

/// The same city in another frame, with what is known of it besides. Meshes are copied. What neighbours hide of trees
/// and a photo are not kept: they are to be found again.
LooseCity loosened(const Imported& city, const LocalFrame& frame);

/// The other's blocks and rows follow; both are of one frame.
void join(LooseCity& into, LooseCity more);

}  // namespace manzana
