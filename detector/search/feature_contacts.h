// The narrow phase: from candidate triangle pairs to the contacts of their feature pairs.
//
// A feature pair is tested once, however many candidate triangle pairs share it (feature_pairs.h).
// Its contact is then reported for ALL triangle pairs that hold it, candidates or not. A triangle
// pair with 0, 1 or 2 common vertices has 6 VF + 9 EE, 4 VF + 5 EE or 2 VF + 2 EE feature pairs
// without a common vertex, and 6, 2 or 0 edges that may pierce the other triangle (looked at only
// at t=0).
//
// If the elementary test asks for features within a distance (L16), only triangle pairs without a
// common vertex count: neighbours are within every distance above their edges and heights. A
// feature pair that is held by neighbours alone is then not tested.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "detector/contact/elementary.h"
#include "detector/mesh/step_counts.h"
#include "detector/mesh/step_types.h"
#include "detector/mesh/topology.h"
#include "detector/search/feature_pairs.h"
#include "detector/search/pair_relation.h"

namespace assay::detector {

// The triangle pairs in contact in a step, each with its first contact.
//
// The contacts come from feature pairs, so one triangle pair may come up to 21 times. If all
// triangles lie upon each other there are M^2 / 2 pairs. To keep memory small, each pair is kept
// once: new contacts are merged into the sorted list when they number a quarter of the list. A pair
// takes 70 bytes, 48 of them the result, and 118 bytes while the list grows.
//
// Memory in proportion to the list's length is taken only where the stop function is asked
// meanwhile. So if the stop function watches a limit of memory, the limit is kept. Cost: O(log n)
// for each contact that comes, all in all.
class PairContacts {
 public:
  void add(const PairContact& contact);

  // Returns whether a few more contacts would make the list grow in add(), which asks no stop
  // function. The caller should then call make_room(), which asks one.
  bool is_nearly_full() const {
    constexpr std::size_t a_few = 64;
    return !all_.empty() && all_.capacity() - all_.size() < a_few;
  }
  // Makes room for a quarter more. Returns false if `stop` asked for an end; all contacts are kept
  // then, too.
  bool make_room(const StopFunction& stop);

  // Returns the pairs that came for the first time since the last call, each once.
  std::deque<TrianglePair> take_new_pairs();
  // Returns all pairs, ascending, each with its first contact. If several contacts of a pair have
  // the same first time, the one with the least feature kind is taken, then the one with the least
  // vertices. The list is empty afterwards.
  std::vector<PairContact> take();

  // Returns the contacts that are held, in any order; some pairs come several times.
  std::span<const PairContact> held() const { return all_; }

  // Returns the memory that is held, in bytes.
  std::size_t bytes() const {
    return (all_.capacity() + late_.capacity()) * sizeof(PairContact) +
           new_.size() * sizeof(TrianglePair) + recent_.capacity() * sizeof(std::uint32_t);
  }

 private:
  void settle();
  void merge_late(std::size_t count);

  std::vector<PairContact> all_;
  // The first settled_ contacts of all_ are ascending, with each pair once; the late ones follow.
  std::size_t settled_ = 0;
  std::vector<PairContact> late_;  // working memory of settle()
  // The places in all_ of the latest pairs, by a hash of the pair; 16 KB. A place may hold another
  // pair by now, so it is only a guess.
  std::vector<std::uint32_t> recent_;
  std::deque<TrianglePair> new_;
};

class FeatureContacts {
 public:
  // The first constructor is for searches that ask by `types` (by triangle, those of
  // `representatives`). Without types and representatives all triangles count as one type, and
  // every candidate is asked for. The references and views must outlive this object. If `pace` was
  // stopped, the object must not be used.
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, const Representatives& representatives,
                  const std::vector<TriangleType>& types);
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, PacedStop* pace = nullptr);
  ~FeatureContacts();
  FeatureContacts(const FeatureContacts&) = delete;
  FeatureContacts& operator=(const FeatureContacts&) = delete;

  // Sets the types that the next search asks for. Its candidates come next.
  void ask(const AskedTypes& relations) { pairs_.ask(relations); }

  // Sorts the contacts by this relation, which must outlive this object; null: everything counts.
  // REQUIRES that no candidate has come yet.
  void sort_by(const PairRelation* relation) { relation_ = relation; }

  // Drops, from now on, contacts later than this. REQUIRES that no lane works.
  void leave_out_later_than(const TimeBound& bound) { bound_ = bound; }
  // Returns the least upper end of the times of all contacts that count and were found under a
  // bound; infinity if there is none. REQUIRES that no lane works.
  double least_end() const;
  // From now on, takes the pairs of features that come within the separation plus the slack in
  // `motion`, which has the same vertices as the step. They are tested over the whole step. The
  // second constructor calls this; after the first one it is REQUIRED before candidates come.
  void take_near_in(const SteppedMesh& motion, double slack, PacedStop* pace) {
    pairs_.fit(motion, pace, elementary_.separation() + slack);
  }

  // Proves pairs apart, if contacts are looked for in exact arithmetic by the detector's own rungs.
  // Any other stage, and any other arithmetic, still gets every test. Pairs that are proved apart
  // need not be added. It calls take_near() when it needs the whole step in take_near_in().
  // REQUIRES ask(), if types are asked for.
  template <class TakeNear>
  void prove_apart(const WideTree& tree, PacedStop* pace, TakeNear take_near) {
    if (elementary_.first_rungs() && neighbours_count_)
      pairs_.prove_apart(motion_, tree, pace, take_near);
  }
  const Sheets* sheets() const { return pairs_.sheets(); }
  bool find_few() const { return pairs_.find_few(); }
  bool are_proved_apart(std::int32_t a, std::int32_t b) const {
    return pairs_.are_proved_apart(a, b);
  }

  // Sets how many lanes candidates come in (parallel/workers.h). Before this is called there is one
  // lane.
  void make_lanes(std::size_t count);

  // Adds the feature pairs of a candidate pair to a lane, and tests the pairs of the lane when
  // there are enough of them. With `may_pierce` it also adds the edges that may pierce the other
  // triangle at t=0. Returns false if `stop` asked for an end. Calls for different lanes may run in
  // parallel.
  bool add_candidate(std::int32_t a, std::int32_t b, bool may_pierce, const StopFunction& stop = {},
                     std::size_t lane = 0);

  // Tests the feature pairs that are left, with the workers of `pace` if it has some. Returns
  // false if `stop` asked for an end; the contacts found until then are kept.
  bool run(const StopFunction& stop, const PacedStop* pace = nullptr);

  // Lists, from now on, the feature pairs that are taken, except edges that are seen at once to
  // pierce nothing at t=0. One lane lists them in `room`. take_keys() gives them, in any order, or
  // nothing if there are more than `most`. REQUIRES that no candidate has come yet.
  void list_keys(std::size_t most, std::vector<FeatureKey> room) {
    most_keys_ = most;
    lanes_[0]->listed = std::move(room);
  }
  std::optional<std::vector<FeatureKey>> take_keys();
  // Returns the grid of the motion in which the feature pairs are near.
  const FloatGrid& grid() const { return pairs_.grid(); }
  // Tests these feature pairs, whether or not they are near, and otherwise does what run() does.
  bool run(std::span<const FeatureKey> keys, const StopFunction& stop, const PacedStop* pace);

  // Returns the triangle pairs in contact that were found since the last call, each once.
  std::deque<TrianglePair> take_new_pairs() { return contacts_.take_new_pairs(); }
  NarrowCounts counts() const;
  // Returns the time that the tests have taken, in milliseconds; with several lanes their mean.
  double test_time() const;

  // Hands out the first contact of each triangle pair, ascending by pair, and keeps none. With
  // Want::yes_no every time is {0, 0}.
  std::vector<PairContact> take() { return contacts_.take(); }

  // Returns whether some contact found within one component does not count; nothing if `stop` asked
  // for an end. REQUIRES that run() has tested all candidates.
  std::optional<bool> found_ignored(const StopFunction& stop) const;
  // Appends to `counted` the contacts that count. `contacts` are those that take() gave. With a
  // relation of features it appends the first contact of each pair that counts. REQUIRES a
  // relation. Returns false if `stop` asked for an end; some may then be left out.
  bool take_counted(const std::vector<PairContact>& contacts, const StopFunction& stop,
                    std::vector<PairContact>& counted);

 private:
  struct OneType;  // the types and representatives that the short constructor makes for itself
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, std::unique_ptr<OneType> own, PacedStop* pace);
  // The feature pairs that one lane has taken, and its contacts.
  struct Lane {
    std::vector<FeatureKey> untested, listed;
    // Room for the queries of one kind on their way through the first rungs.
    std::vector<FeatureKey> keys, open;
    std::vector<QueryVertices> queries;
    std::vector<LaneRung> rungs;
    std::vector<PairContact> found;  // not yet handed over to contacts_
    // Not yet handed over to counted_; used only with a relation of features.
    std::vector<PairContact> found_counted;
    bool found_ignored = false;
    double least_end = std::numeric_limits<double>::infinity();
    NarrowCounts counts;
    double test_time = 0;
  };
  bool run(Lane& lane, const StopFunction& stop);
  // Lists the untested feature pairs for whose kind lists(kind) is true.
  template <class Lists>
  void list(Lane& lane, Lists lists);
  // Drops the untested feature pairs that the first rungs settle.
  void settle_in_lanes(const QueryKernels& kernels, Lane& lane) const;
  void test(FeatureKey key, Lane& lane) const;
  void sort_features(FeatureKey key, std::size_t found_before, Lane& lane) const;
  void note_ends(std::size_t found_before, std::size_t counted_before, Lane& lane) const;
  bool counts(std::int32_t a, std::int32_t b) const;
  // Returns whether some triangle pair that holds the two features counts.
  bool some_pair_counts(FeatureKey key) const;
  bool hand_over(Lane& lane, const StopFunction& stop);
  static bool hand_over(std::vector<PairContact>& found, PairContacts& contacts,
                        const StopFunction& stop);
  QueryVertices vertices_of(FeatureKey key) const;
  FourPoints query(FeatureKey key) const;

  const Topology& mesh_;
  SteppedMesh motion_;
  const ElementaryTest& elementary_;
  Want want_;
  bool neighbours_count_;
  std::unique_ptr<OneType> own_;
  FeaturePairs pairs_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::size_t most_keys_ = 0;  // 0: they are not listed
  std::atomic<std::size_t> listed_ = 0;
  std::mutex handing_over_;
  PairContacts contacts_;
  const PairRelation* relation_ = nullptr;
  PairContacts counted_;  // used only if relation_ has level features
  std::optional<TimeBound> bound_;
};

}  // namespace assay::detector
