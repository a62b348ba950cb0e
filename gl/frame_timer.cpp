#include "gl/frame_timer.h"

namespace manzana::gl {

FrameTimer::FrameTimer() {
  for (Query& query : queries_) {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    query = Query(name);
  }
}

void FrameTimer::begin() {
  collect();
  timing_ = !pending_[next_];
  if (timing_) glBeginQuery(GL_TIME_ELAPSED, queries_[next_].name());
}

void FrameTimer::end() {
  if (!timing_) return;
  glEndQuery(GL_TIME_ELAPSED);
  pending_[next_] = true;
  next_ = (next_ + 1) % kSlots;
  timing_ = false;
}

void FrameTimer::collect() {
  for (std::size_t i = 0; i < kSlots; ++i) {
    const std::size_t slot = (next_ + i) % kSlots;  // oldest first
    if (!pending_[slot]) continue;
    GLuint there = GL_FALSE;
    glGetQueryObjectuiv(queries_[slot].name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (there == GL_FALSE) return;
    GLuint64 ns = 0;
    glGetQueryObjectui64v(queries_[slot].name(), GL_QUERY_RESULT, &ns);
    newest_ms_ = static_cast<double>(ns) * 1e-6;
    pending_[slot] = false;
  }
}

double FrameTimer::newest_ms() {
  collect();
  return newest_ms_;
}

}  // namespace manzana::gl
