#pragma once
/// A building or whatever a host puts into a city (scenegraph/nodes.h), from a glTF file (.gltf, .glb).
///   const NodeId house = add_model(nodes, read_model("house.glb"), {.placement = upright(frame, place)});
/// Its nodes keep their names, their places below each other, and the meshes that they share. Materials count by their
/// base colour, textures by their mean. What the file may name lies in its folder or below.
#include <filesystem>
#include <span>

#include "scenegraph/nodes.h"

namespace manzana {

/// Parents before children; NewNode::parent is an index into this list, plus 1.
using ModelFile = std::vector<NewNode>;

/// Throws std::runtime_error ("FILE: what is wrong") for what cannot be drawn as it stands.
ModelFile read_model(const std::filesystem::path& file);
/// The same from memory, without any file access. `name` stands in messages.
ModelFile read_model(std::span<const unsigned char> bytes, const std::string& name);

/// Below a new node `as`, which is returned.
NodeId add_model(Nodes& nodes, const ModelFile& model, NewNode as);

}  // namespace manzana
