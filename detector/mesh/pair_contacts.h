// The triangle pairs in contact in a step, each with its first contact.
//
// They come from feature pairs: a triangle pair comes up to 21 times, and what lies upon each other
// makes M^2 / 2 pairs. So what came lately is sorted in among the rest as soon as it is a quarter
// of it, and a pair is kept once: 70 bytes a pair, 48 of them the result; 118 while the list grows.
// Nothing takes memory by the list's length but where the stop function is asked meanwhile, so a
// limit of memory that it keeps is kept. O(log n) for each that comes, all in all.
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

  // Whether a few more would make the list grow, unasked.
  bool is_nearly_full() const {
    constexpr std::size_t a_few = 64;
    return !all_.empty() && all_.capacity() - all_.size() < a_few;
  }
  // Makes room for a quarter more. False where `stop` asked for an end: nothing is lost.
  bool make_room(const StopFunction& stop);

  // Pairs that have come since this was last asked, each once.
  std::deque<TrianglePair> take_new_pairs();
  // Ascending by pair; of the contacts of a pair the first in time, at one time the one of the
  // least feature kind, then of the least vertices. Nothing is left behind.
  std::vector<PairContact> take();

  // What is held, in bytes.
  std::size_t bytes() const {
    return (all_.capacity() + late_.capacity()) * sizeof(PairContact) +
           new_.size() * sizeof(TrianglePair);
  }

 private:
  void settle();
  void merge_late(std::size_t count);

  std::vector<PairContact> all_;
  std::size_t settled_ = 0;        // so many are ascending, each pair once
  std::vector<PairContact> late_;  // worked in while it settles
  std::deque<TrianglePair> new_;
};

}  // namespace assay::detector
