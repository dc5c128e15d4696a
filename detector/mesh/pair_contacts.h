// The triangle pairs in contact in a step, each with its first contact.
//
// The contacts come from feature pairs, so one triangle pair may come up to 21 times. If all
// triangles lie upon each other there are M^2 / 2 pairs. To keep memory small, each pair is kept
// once: the contacts that came lately are merged into the sorted rest as soon as they are a
// quarter of it. A pair takes 70 bytes, 48 of them the result, and 118 bytes while the list grows.
//
// Memory in proportion to the list's length is taken only where the stop function is asked
// meanwhile. So if the stop function watches a limit of memory, the limit is kept. Cost: O(log n)
// for each contact that comes, all in all.
#pragma once

#include <deque>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class PairContacts {
 public:
  void add(const PairContact& contact) {
    if (all_.size() == all_.capacity()) make_room({});
    all_.push_back(contact);
  }

  // Whether a few more contacts would make the list grow in add(), where no stop function is
  // asked. Call make_room() first if so.
  bool is_nearly_full() const {
    constexpr std::size_t a_few = 64;
    return !all_.empty() && all_.capacity() - all_.size() < a_few;
  }
  // Makes room for a quarter more. False if `stop` asked for an end; all contacts are kept then,
  // too.
  bool make_room(const StopFunction& stop);

  // The pairs that came for the first time since the last call, each once.
  std::deque<TrianglePair> take_new_pairs();
  // All pairs, ascending, each with its first contact. If several contacts of a pair have the same
  // first time, the one with the least feature kind is taken, then the one with the least
  // vertices. The list is empty afterwards.
  std::vector<PairContact> take();

  // The memory that is held, in bytes.
  std::size_t bytes() const {
    return (all_.capacity() + late_.capacity()) * sizeof(PairContact) +
           new_.size() * sizeof(TrianglePair);
  }

 private:
  void settle();
  void merge_late(std::size_t count);

  std::vector<PairContact> all_;
  // The first settled_ contacts of all_ are ascending, with each pair once; the late ones follow.
  std::size_t settled_ = 0;
  std::vector<PairContact> late_;  // working memory of settle()
  std::deque<TrianglePair> new_;
};

}  // namespace assay::detector
