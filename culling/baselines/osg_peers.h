#pragma once
/// Rows of the peer table (culling/baselines/peer.h): OpenSceneGraph, where it was found when this was built.
/// A quadtree of osg::Group over the objects' centres, osg::Geode with drawables at its leaves; double matrices and
/// planes, float bounds, as the library is built by default. Small-feature and occluder culling are off, and nothing
/// computes near and far. The frustum's planes are handed to the culling set as they are: OSG would take them from a
/// projection matrix, which an infinite view does not have there.
#include "culling/baselines/peer.h"

namespace manzana::baselines {

#ifdef MANZANA_OSG
/// osgUtil::CullVisitor walks, and lists render leaves; reading them back is part of the query, sorting them is not.
std::unique_ptr<Peer> make_osg(const City& city);
/// The same tree walked by hand with osg::CullStack and its plane masks; what lies inside is taken as a run.
std::unique_ptr<Peer> make_osg_stack(const City& city);
inline constexpr bool kOsg = true;
#else
inline constexpr bool kOsg = false;
inline constexpr std::nullptr_t make_osg = nullptr, make_osg_stack = nullptr;
#endif

}  // namespace manzana::baselines
