#include "properties/search/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "properties/changes/changes.h"
#include "properties/judging/cause.h"
#include "properties/judging/contracted_case.h"
#include "properties/random.h"
#include "properties/search/degeneracy.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

Theme drawn_theme(Random& random, const SearchSpace& space) {
  using enum Theme;
  constexpr Theme without_views[] = {fresh, degeneracies},
                  with_views[] = {fresh,        fresh, fresh, degeneracies, degeneracies,
                                  degeneracies, pasts, views, views,        sheets};
  return space.gives_views ? one_of(random, with_views) : one_of(random, without_views);
}

bool is_move_of(Theme theme, const Move& move) {
  if (theme == Theme::pasts) return move.kind == MoveKind::past;
  if (theme == Theme::views) return move.kind == MoveKind::view;
  if (theme == Theme::sheets) return move.kind != MoveKind::features;
  return true;
}

void choose_moves(Random& random, const SearchSpace& space, Swarm& swarm) {
  const bool by_halves = swarm.theme == Theme::degeneracies || swarm.theme == Theme::sheets;
  const std::size_t least = by_halves ? 4 : 1;
  while (swarm.moves.size() < least) {
    swarm.moves.clear();
    for (const Move& move : moves()) {
      if (!is_move_of(swarm.theme, move) || (by_halves && random.one_in(2))) continue;
      if (space.gives_views || move.kind != MoveKind::view)
        swarm.moves.insert(swarm.moves.end(), static_cast<std::size_t>(move.weight), &move);
    }
  }
}

void choose_sizes(Random& random, const SearchSpace& space, Swarm& swarm) {
  constexpr std::size_t any_frames = 9;
  if (swarm.theme == Theme::fresh) {
    // Larger cases take three quarters of the time of trials, and find least in it. Without views a
    // pair of triangles shows most faults that a mesh shows.
    constexpr Eigen::Index sizes[] = {12, 24, 24, 40}, of_features[] = {4, 4, 8, 12, 24, 40};
    swarm.most_triangles = space.gives_views ? one_of(random, sizes) : one_of(random, of_features);
    swarm.most_frames = any_frames;
  } else if (swarm.theme == Theme::everything && space.gives_views) {
    swarm.most_triangles = 24;
    swarm.most_frames = any_frames;
    swarm.fresh_one_in = 2;
  } else if (is_of_culling(swarm.theme)) {
    constexpr Eigen::Index sizes[] = {8, 12, 24};
    swarm.most_triangles = one_of(random, sizes);
    swarm.most_frames = static_cast<std::size_t>(random.between(2, 5));
    swarm.fresh_one_in = random.between(2, 4);
    swarm.parents = swarm.theme == Theme::pasts ? Parents::alike : Parents::within_a_component;
  } else {
    constexpr Eigen::Index sizes[] = {4, 4, 8, 12, 24};
    swarm.most_triangles = one_of(random, sizes);
    swarm.most_frames = static_cast<std::size_t>(random.between(2, 5));
    swarm.fresh_one_in = random.between(2, 6);
  }
}

}  // namespace

Swarm::Swarm(const std::string& lane, const SearchSpace& space, std::uint64_t begin) {
  Random random(fmt::format("{}:swarm:{}", lane, begin));
  if (begin > 0) theme = drawn_theme(random, space);
  choose_moves(random, space, *this);
  while (sources.empty()) {
    for (const auto& source : space.sources) {
      if (theme == Theme::everything || random.one_in(2))
        sources.insert(sources.end(), static_cast<std::size_t>(source.weight), &source);
    }
  }
  choose_sizes(random, space, *this);
}
namespace {

// Returns how far the detector is off, in bits. Deviations that its contract allows count, too.
double error_bits(const CaseResults& results) {
  constexpr double alarm = 8, no_answer = 8, disagreement = 16, bits_of_a_double = 53;
  double bits = 0;
  for (std::size_t i = 0; i < results.verdicts.size(); ++i) {
    const auto& steps = results.verdicts[i].steps;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const StepDiff& diff = steps[s];
      if (diff.answered_collision) bits = std::max(bits, alarm);
      if (diff.answer == Answer::undecided) bits = std::max(bits, no_answer);
      if (diff.first) {
        const double off = std::abs(diff.first->detector.lo - diff.first->oracle.lo);
        if (off > 0) bits = std::max(bits, (bits_of_a_double + std::log2(off)) / 2);
      }
      const auto& others = results.verdicts[0].steps;
      if (s < others.size() && others[s].answer != diff.answer) bits = std::max(bits, disagreement);
    }
  }
  return bits;
}

// Returns, in a few letters, the way that a case took through the detector in its first
// configuration. It distinguishes cases of one cause that go different ways.
std::string ways_of(const CaseResults& results) {
  std::string ways;
  if (results.runs.empty()) return ways;
  for (const auto& step : results.runs[0].steps) {
    ways += step.answer == Answer::collision ? 'c' : 'f';
    if (step.view_positive > 0) ways += 'P';
    if (step.view_negative > 0) ways += 'N';
    if (step.view_zero > 0) ways += 'Z';
    if (step.violated > 0) ways += 'V';
    if (step.dirty > 0) ways += 'D';
  }
  return ways;
}

bool is_same(const Case& a, const Case& b) {
  return a.triangles.rows() == b.triangles.rows() &&
         a.frames.front().rows() == b.frames.front().rows() && a.triangles == b.triangles &&
         a.frames == b.frames && a.script == b.script && a.view.has_value() == b.view.has_value() &&
         (!a.view || (a.view->q0 == b.view->q0 && a.view->q1 == b.view->q1));
}

struct Entry {
  Candidate child;
  std::string cause, cell;
  double score = 0;
  bool is_within_a_component = false;
  double alike = 0;  // the pairs that meet first (seen_alike)
};

std::string word_of_hardest(const Gap& gap) {
  const auto least = std::ranges::min_element(gap.share);
  return name_of(static_cast<Hardness>(least - gap.share.begin()));
}

std::optional<Entry> entry_of(const CaseResults& one, const SearchSpace& space, Random& random) {
  const auto& c = one.c;
  const auto focus = focus_of(c, one.truth, space.contract, random);
  if (!focus) return std::nullopt;
  const double separation = space.contract.separation;
  const Gap gap = gap_of(query_at(c, *focus), focus->time, separation);
  Entry entry{{c, focus}, "no contact", "", nearness(gap) + error_bits(one)};
  if (focus->contact) {
    const auto step = steps_of(c)[focus->step];
    const SteppedMesh motion{start_of(c, step), end_of(c, step)};
    entry.cause = cause_of(c.triangles, motion, *focus->contact, separation > 0, says_query(c));
  }
  if (space.gives_views && focus->contact && !says_query(c)) {
    entry.is_within_a_component = is_within_a_component(c, *focus);
    if (entry.is_within_a_component) entry.alike = seen_alike(c, *focus);
  }
  constexpr double bits_of_sight = 24, steps_of_sight = 8;
  entry.score += bits_of_sight * entry.alike;
  entry.cell = fmt::format("{}; {}; {}; {}; {}; {}", entry.cause, focus->first_group,
                           word_of_hardest(gap), ways_of(one), entry.is_within_a_component,
                           std::floor(steps_of_sight * entry.alike));
  return entry;
}

// The best case of each cell. A cell is a cause, a kind of features, the hardest property, the way
// of the detector (ways_of), and how a culling sees the case.
class Archive {
 public:
  // Offers a case. The later of two equally good cases stays, so that the search drifts.
  void offer(Entry&& one) {
    causes_.insert(one.cause);
    const auto [place, is_new] = cells_.try_emplace(one.cell, cases_.size());
    if (is_new) {
      if (one.is_within_a_component) within_.push_back(cases_.size());
      if (one.alike == 1) alike_.push_back(cases_.size());
      cases_.push_back(std::move(one));
    } else if (one.score >= cases_[place->second].score) {
      cases_[place->second] = std::move(one);
    }
  }
  // Draws a case of this kind; null if there is none.
  const Candidate* draw(Random& random, Parents parents = Parents::any) const {
    if (parents == Parents::any) return cases_.empty() ? nullptr : &one_of(random, cases_).child;
    // Cases that are alike are rare, so half of the draws choose among them.
    const bool is_alike = parents == Parents::alike || (!alike_.empty() && random.one_in(2));
    const auto& places = is_alike ? alike_ : within_;
    return places.empty() ? nullptr : &cases_[one_of(random, places)].child;
  }
  std::set<std::string> take_causes() { return std::move(causes_); }

 private:
  std::map<std::string, std::size_t> cells_;
  std::vector<Entry> cases_;
  std::vector<std::size_t> within_, alike_;  // places of such cases
  std::set<std::string> causes_;
};

struct LaneSearch {
  const SearchLane& lane_;
  const SearchSpace& space_;
  Swarm swarm_{lane_.id, space_, 0};
  Archive archive_ = {};
  std::set<std::pair<std::size_t, std::string>> signatures_ = {};
  std::uint64_t draws_ = 0;
  std::uint64_t of_swarm_ = 0;  // cases that were asked in this swarm
  bool renew_ = false;
  std::uint64_t idle_ = 0;  // swarms in a row from which the contract took no case
  LaneResult result_ = {};

  LaneResult run(const ExamineCases& examine, const std::function<bool()>& stop) {
    while (result_.cases < lane_.cases) {
      if (stop && stop()) return std::move(result_);
      constexpr std::uint64_t together = 8, cases_of_a_swarm = 32, most_idle = 20;
      if (renew_ || of_swarm_ >= cases_of_a_swarm) {
        swarm_ = Swarm(lane_.id, space_, draws_);
        of_swarm_ = 0;
      }
      std::vector<Case> batch;
      const auto count = std::min(together, lane_.cases - result_.cases);
      while (batch.size() < count) {
        auto one = next_case();
        if (!one) break;
        batch.push_back(std::move(*one));
      }
      idle_ = batch.empty() ? idle_ + 1 : 0;
      // A swarm that led to too few cases is replaced.
      renew_ = batch.size() < count;
      of_swarm_ += batch.size();
      if (idle_ > most_idle) break;  // the contract takes none
      for (const auto& one : examine(std::move(batch))) take(one);
    }
    result_.complete = true;
    result_.causes = archive_.take_causes();
    return std::move(result_);
  }

 private:
  // Returns a case that the contract takes; nothing if many attempts in a row led to none. Each
  // attempt draws by its own number.
  std::optional<Case> next_case() {
    constexpr int most_attempts = 200;
    for (int attempts = 0; attempts < most_attempts; ++attempts) {
      const auto id = fmt::format("{}:{}", lane_.id, ++draws_);
      Random random(id);
      Case raw = draw(random, id);
      raw.id = id;
      if (raw.frames.size() < 2 || !is_finite(raw)) continue;  // moves may overflow
      if (raw.triangles.rows() > swarm_.most_triangles || raw.frames.size() > swarm_.most_frames)
        continue;
      if (auto contracted_case = contract_case(raw, space_.contract)) return contracted_case;
    }
    return std::nullopt;
  }

  Case draw(Random& random, const std::string& id) const {
    const Candidate* parent =
        random.one_in(swarm_.fresh_one_in) ? nullptr : archive_.draw(random, swarm_.parents);
    return parent ? mutate(random, *parent) : fresh(random, id);
  }

  Case fresh(Random& random, const std::string& id) const {
    const bool is_on_a_ray = is_of_culling(swarm_.theme) && random.one_in(2);
    const bool is_nested = is_on_a_ray && random.one_in(2);
    Candidate child;
    child.c = one_of(random, swarm_.sources)
                  ->draw(random, id, swarm_.most_triangles / (is_nested ? 2 : 1));
    if (child.c.frames.size() < 2) return child.c;
    child.c = space_.bring(std::move(child.c));
    const MoveContext context{space_.contract};
    if (is_nested) nest(random, child, context);
    if (is_on_a_ray) {
      pass_by_ray(random, child, context);
      return child.c;
    }
    // Under such a contract most fresh cases that are taken are in no contact.
    const bool leaves_contacts_out = space_.contract.start != StartRule::any;
    if (!random.one_in(leaves_contacts_out ? 2 : 4)) return child.c;
    child.focus = focus_of(child.c, {}, space_.contract, random);
    moves()[0].make(random, child, context);
    if (space_.contract.has_range() && random.one_in(3)) moves()[1].make(random, child, context);
    return child.c;
  }

  Case mutate(Random& random, const Candidate& parent) const {
    Candidate child = parent;
    child.c.expected = {};
    const MoveContext context{space_.contract, archive_.draw(random)};
    do {
      const Move& move = *one_of(random, swarm_.moves);
      if (move.kind == MoveKind::features || !says_query(child.c))
        move.make(random, child, context);
    } while (random.one_in(2) && is_finite(child.c));
    if (is_same(child.c, parent.c)) child.c.frames.clear();
    return child.c;
  }

  void take(const CaseResults& results) {
    const Case& c = results.c;
    ++result_.cases;
    bool is_defect = false;
    for (std::size_t i = 0; i < results.verdicts.size(); ++i) {
      const auto& failure = results.verdicts[i].failure;
      if (!failure) continue;
      is_defect = true;
      if (signatures_.emplace(i, failure->signature()).second)
        result_.finds.push_back({c, i, *failure, results.runs[i], result_.cases});
    }
    result_.defects += is_defect ? 1 : 0;
    // Cases without a verdict would let later cases depend on the speed of the machine.
    const auto is_open = [](const Verdict& trial) {
      return trial.outcome == Outcome::undecided || trial.outcome == Outcome::error;
    };
    if (std::ranges::any_of(results.verdicts, is_open)) {
      ++result_.open;
      return;
    }
    Random random(c.id + ":focus");
    if (auto one = entry_of(results, space_, random)) archive_.offer(std::move(*one));
  }
};

}  // namespace

LaneResult search(const SearchLane& lane, const SearchSpace& space, const ExamineCases& examine,
                  const std::function<bool()>& stop) {
  return LaneSearch{lane, space}.run(examine, stop);
}

}  // namespace assay::properties
