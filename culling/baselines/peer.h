#pragma once
/// The structures that the BqR-Tree is measured against, behind one small interface; nothing here is installed.
///   for (const PeerInfo& info : peers()) if (info.available) { auto peer = info.make(city); ... }
///   peer->query(make_frustum(view), answer);                   // each frame; this is what is timed
///   std::vector<std::uint32_t> ids = taken(*peer, answer);     // rows of City::boxes, for the checks
#include <memory>
#include <string_view>

#include "culling/baselines/city.h"
#include "culling/bqr_tree.h"
#include "culling/frustum.h"

namespace manzana::baselines {

/// What a peer decides about: single objects, or whole blocks (or pages of blocks) with all their objects.
enum class Grain : std::uint8_t { object, block };

/// Runs of positions in the peer's own order. Peers that find objects one by one may list runs of length one.
/// The caller keeps it from frame to frame, so that no query allocates once it has grown.
struct Answer {
  std::vector<culling::ObjectRun> runs;
};

class Peer {
 public:
  virtual ~Peer() = default;
  /// Clears `answer`, then fills it with every object (or block) that may be seen. The frustum is relative to its eye,
  /// in double; bringing it into the peer's own form is part of the query.
  virtual void query(const culling::FrustumD& frustum, Answer& answer) = 0;
  /// position -> row of City::boxes; empty: positions are rows.
  virtual std::span<const std::uint32_t> order() const { return {}; }
  /// Of the structure with all bounds that it reads, not of the objects themselves.
  virtual std::size_t bytes() const = 0;
};

struct PeerInfo {
  std::string_view slug;  ///< as on the command line and in the tables
  std::string_view what;  ///< one line for --list
  Grain grain = Grain::object;
  bool available = true;  ///< false: its library was not found when this was built
  std::unique_ptr<Peer> (*make)(const City&) = nullptr;
};

/// In the order of the tables; bqr first.
std::span<const PeerInfo> peers();
/// nullptr: no such slug.
const PeerInfo* find_peer(std::string_view slug);

/// Rows of City::boxes that an answer holds, ascending.
std::vector<std::uint32_t> taken(const Peer& peer, const Answer& answer);

}  // namespace manzana::baselines
