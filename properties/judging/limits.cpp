#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/judging/agreement.h"
#include "properties/judging/cause.h"
#include "properties/worker/plugin/plugin_host.h"

namespace assay::properties {
namespace {

// The progress that is asked of a limiter that promises none.
constexpr double usual_progress = 0.9;
// A limiter stalls if the mesh stays although a vertex could move by so many units in its last
// place (L17).
constexpr double ulps_of_a_stall = 16;
// If the way is shorter than this, or the gap ahead is narrower, rounding may keep a limiter from
// its progress, and no claim is broken.
constexpr double ulps_of_a_way = 1024, ulps_of_a_gap = 64;
// Progress is owed only if so many equally spaced places, from the promised share on, are free.
constexpr int owed_places = 8;

template <class Real>
double unit_in_last_place(double x) {
  const auto a = static_cast<Real>(std::abs(x));
  return static_cast<double>(std::nextafter(a, std::numeric_limits<Real>::infinity())) -
         static_cast<double>(a);
}
// Returns a unit in the last place of x, in the coordinates of the limiter and its caller.
double ulp(double x, Coordinates coordinates) {
  return coordinates == Coordinates::float32 ? unit_in_last_place<float>(x)
                                             : unit_in_last_place<double>(x);
}

// Returns whether the share is below the time. A time between two adjacent doubles is above the
// lower one.
bool is_before(double share, const TimeEnclosure& time) {
  return time.lo == time.hi ? share < time.lo : share <= time.lo;
}

struct LimitComparison {
  const LimitAnswer& answer_;
  const JudgedStep& step_;
  const StepTruth& truth_;
  const Contract& contract_ = step_.contract;
  bool was_stopped_ = false;

  void judge(StepDiff& diff) {
    LimitDiff& limit = diff.limit.emplace();
    const Positions from = step_.motion.vertices_t0, to = step_.motion.vertices_t1;
    const auto& first = truth_.first;
    // The end of a displacement is where the caller's own numbers place it.
    const bool is_whole =
        answer_.positions == to || answer_.positions == round_to(to, contract_.coordinates);
    const bool stays = answer_.positions == from;
    limit.share = answer_.share;
    if (first) limit.ahead = first->time;
    const double possible = first ? first->time.lo : 1;
    // The way ends at the given positions, or an ulp farther, even if the share is larger.
    limit.way =
        answer_.share >= 0 && !stays ? std::min(answer_.share, share_gone(1)) : share_gone(0);
    limit.is_cut = !first && !is_whole;
    if (answer_.positions == to) {
      limit.hit = first;
    } else if (!stays) {
      limit.hit = first_on_the_way_to(answer_.positions);
    }
    const double progress = contract_.progress > 0 ? contract_.progress : usual_progress;
    if (stays && could_move(progress * possible, ulps_of_a_stall)) limit.stall = cause_of_stall();
    limit.too_far = answer_.share >= 0 && first && !is_before(answer_.share, first->time);
    // The sign of this is exact, except among the least doubles.
    const bool is_short = answer_.share >= 0 && std::fma(progress, possible, -limit.way) > 0;
    if (is_short && step_.claims.has(Claim::progress)) {
      limit.too_short = is_owed(progress * possible, possible);
      limit.is_excused = !limit.too_short;
    }
    weigh(step_.claims.only(claims_on_limits), diff);
    if (was_stopped_ && diff.outcome == Outcome::holds) {
      diff.partial = true;
      diff.outcome = Outcome::undecided;
    }
  }

 private:
  std::optional<PairContact> first_on_the_way_to(const Positions& place) {
    Contract of_way = contract_;
    of_way.margin = 0;  // coming within a slack is no contact
    const auto judgement =
        judge_under(of_way, {step_.motion.vertices_t0, place}, step_.triangles, step_.options);
    was_stopped_ |= !judgement.complete;
    return truth_of(judgement, of_way, step_.triangles).first;
  }

  // Returns whether rounding is no excuse for a way shorter than this share: there is room, and the
  // way is free to each of some places from this share on to the contact, equally spaced and
  // rounded as by the caller.
  bool is_owed(double share, double possible) {
    if (!has_room(share)) return false;
    for (int i = 0; i < owed_places && truth_.first; ++i) {
      const auto place = place_at(share + (possible - share) * i / owed_places);
      if (!place || first_on_the_way_to(*place) || was_stopped_) return false;
    }
    return true;
  }

  // Returns where this share makes the caller stop; nothing if a coordinate overflows.
  std::optional<Positions> place_at(double share) const {
    Contract of_rest = contract_;
    if (of_rest.limit_gives == LimitGives::positions) of_rest.limit_gives = LimitGives::start_plus;
    const Positions from = step_.motion.vertices_t0, to = step_.motion.vertices_t1;
    const auto stop = limit_answer({share, nullptr}, {}, of_rest, from, to, displacement(from, to));
    return stop ? std::optional(stop.value().positions) : std::nullopt;
  }

  // Returns the length of the caller's way, divided by the length of the whole step, both over all
  // vertices together. Each coordinate may have moved by `ulps` units in its last place more.
  double share_gone(double ulps) const {
    const Positions from = step_.motion.vertices_t0, to = step_.motion.vertices_t1;
    const Positions whole = to - from;
    Positions way = (answer_.positions - from).cwiseAbs();
    for (Eigen::Index i = 0; i < way.size() && ulps > 0; ++i) {
      const double larger = std::max(std::abs(from.data()[i]), std::abs(to.data()[i]));
      way.data()[i] += ulps * ulp(larger, contract_.coordinates);
    }
    const double unit = std::max(whole.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
    const double length = (whole / unit).norm();
    return length > 0 ? (way / unit).norm() / length : 1;
  }

  // Returns whether this share of the step moves some coordinate by so many units in its last
  // place.
  bool could_move(double share, double ulps) const {
    const Positions from = step_.motion.vertices_t0,
                    way = share * (step_.motion.vertices_t1 - from);
    for (Eigen::Index i = 0; i < from.size(); ++i) {
      if (std::abs(way.data()[i]) >= ulps * ulp(from.data()[i], contract_.coordinates)) return true;
    }
    return false;
  }

  bool has_room(double share) const {
    const Positions from = step_.motion.vertices_t0;
    const double largest =
        std::max(from.cwiseAbs().maxCoeff(), step_.motion.vertices_t1.cwiseAbs().maxCoeff());
    const double gap = contract_.separation + ulps_of_a_gap * ulp(largest, contract_.coordinates);
    return could_move(share, ulps_of_a_way) && std::isfinite(gap) &&
           !oracle::any_nearer_than(from, step_.triangles, gap,
                                    counted_under(contract_, step_.triangles,
                                                  {step_.options.counted, step_.options.tested}));
  }

  std::string cause_of_stall() const {
    if (!truth_.first) return "nothing is in the way";
    return cause_of(step_.triangles, step_.motion, *truth_.first, contract_.separation > 0);
  }
};

}  // namespace

void judge_limit(const std::optional<LimitAnswer>& answer, const JudgedStep& step, StepDiff& diff) {
  if (diff.outcome == Outcome::error) return;
  const StepTruth truth = step.truth();
  if (!diff.first_contact) diff.first_contact = truth.first;
  if (answer && truth.first && truth.first->time.hi == 0) {
    diff.starts_near |= !diff.has_answer && !diff.candidates;
    return;
  }
  if (answer && step.judgement.complete) {
    LimitComparison{*answer, step, truth}.judge(diff);
  } else if (diff.outcome == Outcome::holds) {
    diff.partial = true;
    diff.outcome = Outcome::undecided;
  }
}

}  // namespace assay::properties
