#include "culling/cull_parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "culling/query.h"

namespace manzana::culling {
namespace {

constexpr std::uint32_t kPiecesAThread = 8;  // subtrees differ in what they cost

void add(CullStats& sum, const CullStats& more) {
  sum.nodes += more.nodes;
  sum.blocks += more.blocks;
  sum.packets += more.packets;
}

template <class T>
void append(List<T>& to, std::span<const T> more) {
  to.end_at(std::copy(more.begin(), more.end(), to.end()));
}

/// Lives for the shared part of one query.
class Sharing {
 public:
  Sharing(const Query& query, std::span<Answer> answers, const Waiting& waiting, Crew& crew)
      : query_(query), answers_(answers), waiting_(waiting), crew_(crew) {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    crew.members.resize(std::max(crew.members.size(), threads));
    for (Crew::Member& member : crew.members) prepare(member);
    pieces_ = std::min(waiting.count(), static_cast<std::uint32_t>(threads) * kPiecesAThread);
  }

  CullStats run() {
    tbb::parallel_for(0U, pieces_, [this](std::uint32_t piece) { visit_piece(piece); });
    CullStats stats;
    for (const Crew::Member& member : crew_.members) {
      collect(member);
      add(stats, member.stats);
    }
    return stats;
  }

 private:
  void prepare(Crew::Member& member) const {
    member.stats = {};
    member.answers.resize(std::max(member.answers.size(), answers_.size()));
    for (Answer& answer : member.answers) {
      answer.reserve(query_.tree);
      Answer::Access::clear(answer);
    }
  }

  std::uint32_t begin_of(std::uint32_t piece) const {
    return waiting_.head + static_cast<std::uint32_t>(std::uint64_t{waiting_.count()} * piece / pieces_);
  }

  /// The caller's thread adds to the answers themselves.
  void visit_piece(std::uint32_t piece) const {
    Crew::Member& member = crew_.members[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
    const bool is_caller = std::this_thread::get_id() == caller_;
    const std::span<Answer> found = is_caller ? answers_ : std::span(member.answers).first(answers_.size());
    const std::uint32_t begin = begin_of(piece), end = begin_of(piece + 1);
    Waiting waiting{Answer::Access::queue(member.answers[0]), 0, end - begin};
    std::copy(waiting_.queue + begin, waiting_.queue + end, waiting.queue);
    add(member.stats, visit(query_, found, waiting, kAnyNumber));
  }

  void collect(const Crew::Member& member) const {
    for (std::size_t v = 0; v < answers_.size(); ++v) {
      append(Answer::Access::objects(answers_[v]), member.answers[v].objects());
      append(Answer::Access::blocks(answers_[v]), member.answers[v].blocks());
    }
  }

  const Query& query_;
  std::span<Answer> answers_;
  const Waiting& waiting_;
  Crew& crew_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::uint32_t pieces_ = 0;
};

}  // namespace

CullStats cull_parallel(const BqrTree& tree, const Planes& planes, Crew& crew, Answer& answer,
                        const CullOptions& options) {
  return cull_parallel(tree, std::span(&planes, 1), crew, std::span(&answer, 1), options);
}

CullStats cull_parallel(const BqrTree& tree, std::span<const Planes> views, Crew& crew, std::span<Answer> answers,
                        const CullOptions& options) {
  Waiting waiting;
  const Query query = start(tree, views, answers, options, waiting);
  if (tree.nodes.empty()) return {};
  CullStats stats = visit(query, answers, waiting, crew.shared_above);
  if (waiting.count() > 0) add(stats, Sharing(query, answers, waiting, crew).run());
  return stats;
}

}  // namespace manzana::culling
