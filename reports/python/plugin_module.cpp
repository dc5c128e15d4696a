// The module assay._plugin asks a plug-in steps, limits and queries, in a process of its own.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "corpus/cases/case_file.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/subject.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using properties::CaseRun;
using properties::Claim;
using properties::RunEnd;
using properties::Subject;

class Plugin {
 public:
  // `library` is a file or "python:MODULE:CLASS", and `worker` the program assay-worker.
  Plugin(const std::string& library, const std::string& worker, double seconds)
      : subject_(opened(library, worker, seconds)), process_(subject_.process()) {}

  std::string name() const { return subject_.description.name; }
  std::string version() const { return subject_.description.version; }

  // Returns an answer for each step of a case file, or None if the detector does not serve the
  // question: it has no such part, or another distance, or its contract would change the case.
  py::object answers(const std::string& case_text, double separation, bool asks_limits) {
    const auto c = corpus::parse_case(case_text, "case");
    if (!c) throw py::value_error(c.error().message);
    const bool is_query = properties::says_query(c.value());
    if (!serves(is_query, separation, asks_limits) || !is_taken_as_it_is(c.value()))
      return py::none();
    const auto run = [&] {
      const py::gil_scoped_release others_may_run;
      return process_.run(c.value(), subject_.detector.configurations)[0];
    }();
    if (run.end == RunEnd::not_run) throw std::runtime_error(run.explanation);
    if (run.end == RunEnd::refused || run.end == RunEnd::beyond_capacity) return py::none();
    py::list answers;
    for (std::size_t s = 0; s < corpus::steps_of(c.value()).size(); ++s)
      answers.append(answer_in(run, s, asks_limits, is_query));
    return answers;
  }

 private:
  static Subject opened(const std::string& library, const std::string& worker, double seconds) {
    properties::WorkerLimits limits;
    limits.seconds = seconds;
    auto subject = Subject::open(worker, library, properties::DetectorPart::by_library, limits);
    if (!subject) throw py::value_error(subject.error().message);
    return std::move(subject.value());
  }

  bool serves(bool is_query, double separation, bool asks_limits) const {
    const auto& detector = subject_.detector;
    const bool is_limiter =
        detector.claims.has(Claim::commit_free) || detector.claims.has(Claim::path_free);
    if (separation != detector.contract.separation || asks_limits != is_limiter) return false;
    if (!is_query) return !detector.of_queries;
    return detector.of_queries || detector.query_claims != properties::Claims();
  }

  bool is_taken_as_it_is(const corpus::Case& c) const {
    const auto told = contracted(c, subject_.detector.contract);
    return told && told->frames == c.frames && corpus::steps_of(*told) == corpus::steps_of(c);
  }

  // An answer as a results file has it (corpus/vectors/README.md).
  py::dict answer_in(const CaseRun& run, std::size_t s, bool asks_limits, bool is_query) const {
    py::dict answer;
    const auto say = [&](const char* word) {
      answer["answer"] = word;
      return answer;
    };
    if (run.end != RunEnd::completed) return say(run.end == RunEnd::crashed ? "crash" : "timeout");
    if (asks_limits) {
      if (s >= run.limits.size() || !run.limits[s] || run.limits[s]->share < 0) return say("error");
      answer["share"] = run.limits[s]->share;
      return say("share");
    }
    if (!error_of(run, s).empty()) return say("error");
    if (!run.has_answers) return say("unsupported");
    const auto& step = run.steps[s];
    if (step.answer != detector::Answer::collision) return say(name_of(step.answer));
    // The first time of a plug-in that states none is [0, 1].
    if (step.first != detector::TimeEnclosure{0, 1})
      answer["time"] = std::array{step.first.lo, step.first.hi};
    if (subject_.detector.contract.reports_pairs && !is_query) {
      std::vector<std::array<std::int32_t, 2>> pairs;
      for (const auto& [pair, time, feature] : step.pairs) pairs.push_back({pair.a, pair.b});
      answer["pairs"] = pairs;
    }
    return say("collision");
  }

  Subject subject_;
  properties::WorkerProcess process_;
};

}  // namespace
}  // namespace assay::python

PYBIND11_MODULE(_plugin, module) {
  using assay::python::Plugin;
  namespace py = pybind11;
  py::class_<Plugin>(module, "Plugin")
      .def(py::init<const std::string&, const std::string&, double>())
      .def_property_readonly("name", &Plugin::name)
      .def_property_readonly("version", &Plugin::version)
      .def("answers", &Plugin::answers);
}
