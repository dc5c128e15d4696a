#include "reports/steps/pair_story.h"

#include <fmt/format.h>

#include <algorithm>

#include "detector/boundary/boundary_handler.h"
#include "detector/boxes/moving_box.h"
#include "oracle/distance/step_distance.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/pair_relation.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "properties/judging/trial.h"
#include "properties/numbering.h"
#include "properties/worker/case_run.h"
#include "reports/steps/step_text.h"

namespace assay::reports {
namespace {

using detector::doubt::dirty;
using detector::doubt::violated;
using properties::at;

const char* sign_text(detector::ViewSign sign) {
  constexpr const char* from_negative[] = {"V-", "V0", "V+"};
  return from_negative[static_cast<int>(sign) + 1];
}

class PairStory {
 public:
  PairStory(const corpus::Case& c, const detector::Detector& detector,
            const detector::TrianglePair& pair, double separation)
      : case_(c),
        detector_(detector),
        pair_(pair),
        separation_(separation),
        is_asked_(
            !leaves_out(properties::contract_of({.separation = separation}), c.triangles, pair)),
        counts_(is_asked_) {
    if (!c.counted) return;
    const auto features = oracle::mesh_features(c.triangles);
    const oracle::PairRelation relation(c.counted->pairs, features);
    bodies_meet_ = relation.bodies_meet(c.triangles(pair.a, 0), c.triangles(pair.b, 0));
    counts_ = is_asked_ && relation.counts_faces(pair.a, pair.b);
  }

  std::string of_step(const detector::StepResult& result, const detector::Positions& x_t0,
                      const detector::Positions& x_t1, const oracle::StepJudgement& truth) const {
    std::string out;
    const auto layers = separation_ > 0 ? std::nullopt : layers_at_start(result, x_t0);
    for (const auto t : {pair_.a, pair_.b}) out += triangle_text(t, result, layers);
    const detector::RoundedPositions points({x_t0, x_t1});
    const auto& triangles = detector_.topology().triangles;
    const auto by = points.grid().margin(separation_) / 2;  // as the detector's tree grows them
    const bool boxes_apart = apart(grown(points.box(triangles[at(pair_.a)]), by),
                                   grown(points.box(triangles[at(pair_.b)]), by));
    out += fmt::format("    {}; moving boxes{} {}\n", rule_text(result),
                       separation_ > 0 ? fmt::format(" grown by {}", separation_) : "",
                       boxes_apart ? "are apart: never tested" : "meet");
    if (!counts_) out += "    the pair does not count: it is reported by neither\n";
    out += fmt::format("    oracle: {}\n", oracle_text({x_t0, x_t1}, truth));
    const bool reported = std::any_of(result.pairs.begin(), result.pairs.end(),
                                      [&](const auto& contact) { return contact.pair == pair_; });
    return out + fmt::format("    detector: {}\n", reported ? "reported" : "not reported");
  }

 private:
  std::string oracle_text(const detector::SteppedMesh& motion,
                          const oracle::StepJudgement& truth) const {
    if (!counts_) return "not asked";
    const auto found = std::find_if(truth.pairs.begin(), truth.pairs.end(),
                                    [&](const auto& contact) { return contact.pair == pair_; });
    if (found != truth.pairs.end())
      return fmt::format("{} at t = {} ({})", met_text(separation_), time_text(found->time),
                         properties::name_of(found->feature.kind));
    const std::string never = "never " + met_text(separation_);
    if (separation_ == 0) return never;
    oracle::DistanceOptions options;
    options.counted = corpus::counted_of(case_);
    options.also_asked = [&](std::int32_t a, std::int32_t b) {
      return detector::TrianglePair{a, b} == pair_;
    };
    const auto least = oracle::least_distance(motion, case_.triangles, options);
    return fmt::format("{}; least distance {}", never, least.distance);
  }

  std::int32_t component(std::int32_t t) const {
    return detector_.topology().component_of_triangle[at(t)];
  }

  std::optional<oracle::LayerState> layers_at_start(const detector::StepResult& result,
                                                    const detector::Positions& x_t0) const {
    const auto& surface = detector_.surface();
    if (result.apexes.size() != surface.loops.size()) return std::nullopt;
    const auto& all = surface.all().triangles;
    const auto own = surface.mesh.triangles.size();
    detector::Triangles ghosts(static_cast<Eigen::Index>(all.size() - own), 3);
    for (std::size_t g = own; g < all.size(); ++g) {
      ghosts.row(static_cast<Eigen::Index>(g - own)) << all[g][0], all[g][1], all[g][2];
    }
    const oracle::Instant start(detector::with_apexes(x_t0, result.apexes, false));
    return oracle::layers_at(start, case_.triangles, ghosts);
  }

  std::string triangle_text(std::int32_t t, const detector::StepResult& result,
                            const std::optional<oracle::LayerState>& layers) const {
    std::string out = fmt::format("    triangle {}: component {}", t, component(t));
    if (!result.doubts.empty()) {
      out += fmt::format(", {}{}{}", sign_text(result.signs[at(t)]),
                         result.doubts[at(t)] & violated ? ", violated" : "",
                         result.doubts[at(t)] & dirty ? ", dirty" : "");
    }
    if (layers) {
      const auto& layer = layers->layer[at(t)];
      out += layer ? fmt::format(", layer ({}, {})", layer->inside, layer->outside)
                   : ", touched at the start";
      out += layers->clean[at(t)] ? ", clean by the oracle" : ", not clean by the oracle";
    }
    return out + "\n";
  }

  std::string rule_text(const detector::StepResult& result) const {
    if (!is_asked_) return "a common vertex: not asked with a separation";
    if (!bodies_meet_) return "bodies that do not meet: not searched (L19)";
    if (component(pair_.a) != component(pair_.b)) return "two components: always a candidate (L10)";
    if (result.doubts.empty()) return "no view sets: every pair is a candidate";
    const oracle::Candidates k(
        {result.signs.begin(), result.signs.begin() + case_.triangles.rows()}, result.doubts);
    return k.holds(pair_) ? "in K: a candidate (L3)"
                          : "not in K: tested only when the closure reaches it (L7)";
  }

  const corpus::Case& case_;
  const detector::Detector& detector_;
  detector::TrianglePair pair_;
  double separation_;
  bool is_asked_;  // not of two with a common vertex, if there is a separation
  bool counts_;    // nor where the case's relation says so
  bool bodies_meet_ = true;
};

}  // namespace

std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth) {
  auto made = properties::CasePlayer::make(c, options);
  if (!made) return fmt::format("  refused: {}\n", made.error().message);
  std::string out =
      fmt::format("  why {}, {}{}:\n", pair.a, pair.b,
                  properties::BodyNames(corpus::counted_of(c), c.triangles).text(pair));
  auto& player = made.value();
  const PairStory story(c, player.detector(), pair, options.separation);
  for (std::size_t s = 0; s < player.steps(); ++s) {
    out += fmt::format("   step {}:\n", s + 1) +
           story.of_step(player.play(s), player.x_t0(s), player.x_t1(s), truth[s]);
  }
  return out;
}

}  // namespace assay::reports
