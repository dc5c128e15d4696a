#include "properties/worker/case_player.h"

#include "detector/assembly.h"

namespace assay::properties {

using detector::Detector;

CasePlayer::CasePlayer(const corpus::Case& c, const detector::Options& options, Detector detector)
    : case_(&c), script_(corpus::steps_of(c)), detector_(std::move(detector)) {
  for (std::size_t s = 0; s < script_.size(); ++s) {
    given_.push_back(given_view(corpus::view_of_step(c, s), options.culling));
  }
}

detector::Expected<CasePlayer> CasePlayer::make(const corpus::Case& c,
                                                const detector::Options& options,
                                                std::optional<detector::Stages> stages,
                                                const detector::StopFunction& stop) {
  detector::Options of_case = options;
  of_case.counted = corpus::counted_of(c);
  auto made = detector::assemble(c.triangles, c.frames.front(), of_case,
                                 stages ? *std::move(stages) : standard_stages(options), stop);
  if (!made) return std::move(made.error());
  return CasePlayer(c, options, std::move(made.value()));
}

detector::StepResult CasePlayer::play(std::size_t s, const detector::StopFunction& stop) {
  if (!script_[s].commit) return look(s, stop);
  return detector_.step(x_t0(s), x_t1(s), given_[s], stop);
}

detector::StepResult CasePlayer::look(std::size_t s, const detector::StopFunction& stop) {
  return detector_.evaluate(x_t0(s), x_t1(s), given_[s], stop);
}

}  // namespace assay::properties
