// The narrow phase: from candidate triangle pairs to the contacts of their feature pairs.
//
// A feature pair is tested once, however many candidate triangle pairs contain it
// (feature_pairs.h). Its contact is then reported for ALL triangle pairs that contain it,
// candidates or not. A triangle pair with 0, 1 or 2 common vertices has 6 VF + 9 EE, 4 VF + 5 EE or
// 2 VF + 2 EE feature pairs without a common vertex (VF: vertex-face, EE: edge-edge). It has 6, 2
// or 0 edges that may pierce the other triangle; piercing is tested only at t=0.
//
// If the elementary test looks for features within a distance (L16), only triangle pairs without a
// common vertex count, because neighbours are within any distance above the lengths of their edges
// and heights. A feature pair that only neighbours contain is then not tested.
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
// The contacts come from feature pairs, so a triangle pair can be added up to 21 times. If all M
// triangles lie on each other there are M^2 / 2 pairs. To save memory, each pair is stored once:
// new contacts are merged into the sorted list when there are a quarter as many as in the list. A
// pair takes 70 bytes, 48 of them the result, and 118 bytes while the list grows.
//
// Memory in proportion to the length of the list is allocated only in functions that call the stop
// function. So a stop function that watches a limit of memory can keep this limit. Cost of n
// contacts in total: O(log n) for each.
class PairContacts {
 public:
  void add(const PairContact& contact);

  // Returns whether a few more contacts would make the list grow in add(), which calls no stop
  // function. If so, the caller should call make_room(), which calls one.
  bool is_nearly_full() const {
    constexpr std::size_t a_few = 64;
    return !all_.empty() && all_.capacity() - all_.size() < a_few;
  }
  // Makes room for a quarter more. Returns false if `stop` returned true; also then no contact is
  // lost.
  bool make_room(const StopFunction& stop);

  // Returns the pairs that were added since the last call of this function, each once.
  std::deque<TrianglePair> take_new_pairs();
  // Returns all pairs, ascending, each with its first contact. If several contacts of a pair have
  // the same first time, the contact with the least feature kind is returned, and among these the
  // contact with the least vertices. The list is empty afterwards.
  std::vector<PairContact> take();

  // Returns the stored contacts, in any order; some pairs are among them several times.
  std::span<const PairContact> held() const { return all_; }

  // Returns the memory that this object uses, in bytes.
  std::size_t bytes() const {
    return (all_.capacity() + late_.capacity()) * sizeof(PairContact) +
           new_.size() * sizeof(TrianglePair) + recent_.capacity() * sizeof(std::uint32_t);
  }

 private:
  void settle();
  void merge_late(std::size_t count);

  std::vector<PairContact> all_;
  // The first settled_ contacts of all_ are ascending, with each pair once; later contacts follow.
  std::size_t settled_ = 0;
  std::vector<PairContact> late_;  // working memory of settle()
  // The indices in all_ of the latest pairs, by a hash of the pair; 16 KB. At such an index there
  // can be another pair by now, so an index is only a guess.
  std::vector<std::uint32_t> recent_;
  std::deque<TrianglePair> new_;
};

class FeatureContacts {
 public:
  // The first constructor is for searches whose pair rule asks for pairs by types; `types` are the
  // types of the triangles, for which `representatives` were made. With the second constructor all
  // triangles have one type, and the rule asks for every pair. The references and views must
  // outlive this object. If `pace` was stopped, this object must not be used.
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, const Representatives& representatives,
                  const std::vector<TriangleType>& types);
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, PacedStop* pace = nullptr);
  ~FeatureContacts();
  FeatureContacts(const FeatureContacts&) = delete;
  FeatureContacts& operator=(const FeatureContacts&) = delete;

  // Sets the pairs of types that the pair rule asks for in the next search. REQUIRED before the
  // candidates of that search are added.
  void ask(const AskedTypes& relations) { pairs_.ask(relations); }

  // Sorts the contacts into those that count in `relation` and those that do not; null: every
  // contact counts. `relation` must outlive this object. REQUIRES that no candidate was added yet.
  void sort_by(const PairRelation* relation) { relation_ = relation; }

  // From now on, drops contacts later than the bound. REQUIRES that no lane is working.
  void leave_out_later_than(const TimeBound& bound) { bound_ = bound; }
  // Returns the least TimeEnclosure::hi of all contacts that count and that were found while a
  // bound was set; infinity if there is none. REQUIRES that no lane is working.
  double least_end() const;
  // From now on, the feature pairs that come within the separation plus `slack` in `motion` are
  // tested, over the whole step. `motion` has the same vertices as the step. The second constructor
  // calls this function; after the first constructor a call is REQUIRED before candidates are
  // added.
  void take_near_in(const SteppedMesh& motion, double slack, PacedStop* pace) {
    pairs_.fit(motion, pace, elementary_.separation() + slack);
  }

  // Proves pairs apart, so that they need not be added. Proves nothing if the elementary test has
  // no first_rungs() or tests for a separation. `take_near` is the caller's function that calls
  // take_near_in() for the whole step; it is called only if that is needed. An object of the first
  // constructor REQUIRES that ask() was called before.
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

  // Sets the number of lanes in which candidates are added (parallel/workers.h). At first there is
  // one lane.
  void make_lanes(std::size_t count);

  // Adds the feature pairs of a candidate pair to a lane, and tests the feature pairs of the lane
  // when there are enough of them. With `may_pierce` it also adds the edges that may pierce the
  // other triangle at t=0. Returns false if `stop` returned true. Calls for different lanes may run
  // in parallel.
  bool add_candidate(std::int32_t a, std::int32_t b, bool may_pierce, const StopFunction& stop = {},
                     std::size_t lane = 0);

  // Tests the feature pairs that are not tested yet. If `pace` has workers, they share the work.
  // Returns false if `stop` returned true; the contacts found before are kept.
  bool run(const StopFunction& stop, const PacedStop* pace = nullptr);

  // From now on, lists the added feature pairs, except edges that the first rungs show to pierce
  // nothing at t=0. Lane 0 uses the memory of `room` for its list. take_keys() returns all listed
  // feature pairs, in any order, or nullopt if there are more than `most`. REQUIRES that no
  // candidate was added yet.
  void list_keys(std::size_t most, std::vector<FeatureKey> room) {
    most_keys_ = most;
    lanes_[0]->listed = std::move(room);
  }
  std::optional<std::vector<FeatureKey>> take_keys();
  // Returns the grid of the motion of the last take_near_in().
  const FloatGrid& grid() const { return pairs_.grid(); }
  // Tests these feature pairs like the other run(), even if they are not near.
  bool run(std::span<const FeatureKey> keys, const StopFunction& stop, const PacedStop* pace);

  // Returns the triangle pairs in contact that were found since the last call, each once.
  std::deque<TrianglePair> take_new_pairs() { return contacts_.take_new_pairs(); }
  NarrowCounts counts() const;
  // Returns the time that the tests have taken, in milliseconds; with several lanes the mean of the
  // lanes.
  double test_time() const;

  // Returns the first contact of each triangle pair, ascending by pair, and forgets all contacts.
  // With Want::yes_no every time is {0, 0}.
  std::vector<PairContact> take() { return contacts_.take(); }

  // Returns whether some contact found within one component does not count; nullopt if `stop`
  // returned true. REQUIRES that run() has tested all candidates.
  std::optional<bool> found_ignored(const StopFunction& stop) const;
  // Appends to `counted` the contacts that count. `contacts` are the contacts that take() has
  // returned. With a relation of features it appends, for each triangle pair, the first contact
  // that counts. REQUIRES a relation. Returns false if `stop` returned true; some contacts may then
  // be missing.
  bool take_counted(const std::vector<PairContact>& contacts, const StopFunction& stop,
                    std::vector<PairContact>& counted);

 private:
  struct OneType;  // the types and representatives that the short constructor makes for itself
  FeatureContacts(const Topology& mesh, const SteppedMesh& motion, const ElementaryTest& elementary,
                  Want want, std::unique_ptr<OneType> own, PacedStop* pace);
  // The feature pairs that were added to one lane, and its contacts.
  struct Lane {
    std::vector<FeatureKey> untested, listed;
    // Working memory for the queries of one feature kind in the first rungs.
    std::vector<FeatureKey> keys, open;
    std::vector<QueryVertices> queries;
    std::vector<LaneRung> rungs;
    std::vector<PairContact> found;  // contacts that are not yet in contacts_
    // Contacts that are not yet in counted_; used only with a relation of features.
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
  // Drops the untested feature pairs that the first rungs decide.
  void settle_in_lanes(const QueryKernels& kernels, Lane& lane) const;
  void test(FeatureKey key, Lane& lane) const;
  void sort_features(FeatureKey key, std::size_t found_before, Lane& lane) const;
  void note_ends(std::size_t found_before, std::size_t counted_before, Lane& lane) const;
  bool counts(std::int32_t a, std::int32_t b) const;
  // Returns whether some triangle pair that contains the two features counts.
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
  std::size_t most_keys_ = 0;  // 0: feature pairs are not listed
  std::atomic<std::size_t> listed_ = 0;
  std::mutex handing_over_;
  PairContacts contacts_;
  const PairRelation* relation_ = nullptr;
  PairContacts counted_;  // used only if relation_ has level features
  std::optional<TimeBound> bound_;
};

}  // namespace assay::detector
