#pragma once
/// The buffers of an answer, for those who fill it.
#include "culling/cull.h"

namespace manzana::culling {

struct Answer::Access {
  static List<ObjectRun>& objects(Answer& a) { return a.objects_; }
  static List<ObjectRun>& sorted(Answer& a) { return a.sorted_; }
  static List<LeafRun>& blocks(Answer& a) { return a.blocks_; }
  static Visit* queue(Answer& a) { return a.queue_.begin(); }
  static void clear(Answer& a) {
    a.objects_.end_at(a.objects_.begin());
    a.blocks_.end_at(a.blocks_.begin());
  }
};

}  // namespace manzana::culling
