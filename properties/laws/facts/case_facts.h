// What the laws ask of one case in one configuration: the detector's results, and beside them the
// oracle's view of the same steps. Each fact is computed when it is first asked for, once.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/detector.h"
#include "detector/step/stages.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/step.h"
#include "oracle/view/candidates.h"
#include "properties/laws/facts/certified_patches.h"
#include "properties/laws/facts/view_range.h"
#include "properties/numbering.h"

namespace assay::properties {

// How a law makes a detector of its own, to run a changed case; empty where results come from a
// detector that cannot be made here (a plug-in): the laws that need it are then not met.
using StagesOf = std::function<detector::Stages(const detector::Options&)>;

class CaseFacts {
 public:
  // REQUIRES valid input, one result and one judgement for each step of the case, and the surface
  // of the detector that gave the results. All of them outlive this object.
  CaseFacts(const corpus::Case& source, const detector::Options& options,
            std::span<const detector::StepResult> results,
            std::span<const oracle::StepJudgement> judgements, const detector::Surface& surface,
            StagesOf stages_of = detector::standard_stages);
  ~CaseFacts();

  // The case and its steps.
  const corpus::Case& source() const { return source_; }
  const detector::Options& options() const { return options_; }
  const detector::Surface& surface() const { return surface_; }
  const StagesOf& stages_of() const { return stages_of_; }
  std::size_t steps() const { return script_.size(); }
  const corpus::CaseStep& script(std::size_t s) const { return script_[s]; }
  const detector::Positions& x_t0(std::size_t s) const { return start_of(source_, script_[s]); }
  const detector::Positions& x_t1(std::size_t s) const { return end_of(source_, script_[s]); }
  const detector::StepResult& result(std::size_t s) const { return results_[s]; }
  const oracle::StepJudgement& judgement(std::size_t s) const { return judgements_[s]; }
  std::int32_t component_of(std::int32_t triangle) const {
    return surface_.mesh.component_of_triangle[static_cast<std::size_t>(triangle)];
  }

  // The committed step whose end step s starts from; nothing at a new start.
  const std::optional<std::size_t>& known_from(std::size_t s) const { return known_from_[s]; }
  // The detector answered step s and tells its view sets.
  bool has_views(std::size_t s) const;
  bool has_ghosts(std::size_t component) const;
  // Whether a verified start is so by view alone (L5), as under view-auto, and not by layers (L9).
  bool starts_by_view_alone() const;
  // The oracle has finished.
  bool is_judged(std::size_t s) const { return judgements_[s].complete; }
  // Premise of L3 to L8: outside Vv everything is clean at the start. A new start that the caller
  // vouched for (start clean) is checked by the oracle's layers; anything else is the detector's
  // own business, and is judged by L8 and L9.
  bool is_trusted(std::size_t s);

  // By the oracle, from the primitives and apexes in the result. REQUIRES has_views(s).
  const std::vector<detector::ViewSign>& signs(std::size_t s);  // mesh, then ghosts
  const std::vector<std::uint8_t>& touched(std::size_t s);      // L11, by ghosts of the component
  const oracle::Candidates& candidates(std::size_t s);          // K
  std::optional<int> winding_at_start(std::size_t s, std::size_t component);  // of q0, in S
  // L5 over the step: all of the component and its ghosts positive, winding number 1 at t=0.
  bool is_free_by_view(std::size_t s, std::size_t component);
  const oracle::LayerState& layers_at_start(std::size_t s);
  const oracle::LayerState& layers_at_end(std::size_t s);
  // 1: in contact with another triangle of its component. REQUIRES is_judged(s).
  const std::vector<std::uint8_t>& own_contacts(std::size_t s);

  bool same_component(const detector::TrianglePair& pair) const {
    return component_of(pair.a) == component_of(pair.b);
  }
  bool in_doubt(std::size_t s, std::int32_t triangle) const {
    return results_[s].doubts[static_cast<std::size_t>(triangle)] != 0;
  }

  // In doubles; false where there are no views.
  const ValueRange& view_range(std::size_t s);
  bool is_close(std::size_t s);

  // The traditional scheme that stages_of() makes, on the mesh of this case; null where it makes
  // none. It does not depend on the culling that gave the results.
  TraditionalScheme* traditional_scheme();
  // By its tests. REQUIRES traditional_scheme().
  const CertifiedPatches& certified_patches(std::size_t s);

  // Rows: vertices of the mesh, then apexes at the step's start or end.
  detector::Positions all_t0(std::size_t s) const;
  detector::Positions all_t1(std::size_t s) const;
  const detector::Triangles& ghosts() const { return ghosts_; }

 private:
  struct StepFacts;
  const oracle::LayerState& layers_of(const detector::Positions& all);

  const corpus::Case& source_;
  detector::Options options_;
  std::span<const detector::StepResult> results_;
  std::span<const oracle::StepJudgement> judgements_;
  const detector::Surface& surface_;
  StagesOf stages_of_;
  std::vector<corpus::CaseStep> script_;
  std::vector<std::optional<std::size_t>> known_from_;
  detector::Triangles ghosts_;
  std::vector<StepFacts> facts_;
  std::optional<std::unique_ptr<TraditionalScheme>> traditional_scheme_;
  // By places: the end of a step is the start of the next one.
  std::vector<std::pair<detector::Positions, std::unique_ptr<oracle::LayerState>>> layers_;
};

}  // namespace assay::properties
