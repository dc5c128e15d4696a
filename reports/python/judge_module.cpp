// The module assay._judge gives Python the oracle, `check`, the readers of frames, and plug-ins
// that a script asks directly.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "corpus/cases/case_file.h"
#include "corpus/formats/sequences.h"
#include "detector/mesh/mesh_checks.h"
#include "oracle/distance/step_distance.h"
#include "properties/campaign/gates/findings.h"
#include "properties/judging/case_options.h"
#include "properties/judging/exam.h"
#include "properties/judging/subject.h"
#include "properties/worker/plugin/query_case.h"
#include "reports/check/check_run.h"
#include "reports/page/run_json.h"
#include "reports/python/calls.h"

namespace assay::python {
namespace {

namespace py = pybind11;

// Refuses input that the detector would refuse, by the same names.
void demand_good_input(const detector::TrianglesView& triangles,
                       const detector::PositionsView& x_t0, const detector::PositionsView& x_t1) {
  if (const auto bad = detector::check_triangles(triangles, x_t0.rows())) raise(*bad);
  for (const auto& [name, x] : {std::pair{"x_t0: ", &x_t0}, {"x_t1: ", &x_t1}})
    if (const auto bad = detector::check_positions(*x, x_t0.rows()))
      raise({bad->error, name + bad->message});
}

// Asks the oracle. With a distance, the sum of two doubles, it is asked for pairs that come within
// the distance, and not for contacts.
py::dict judge(const py::object& triangles, const py::object& x_t0, const py::object& x_t1,
               const std::optional<std::pair<double, double>>& within, int jobs) {
  const TrianglesArgument mesh(triangles, "triangles");
  const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  demand_good_input(mesh.view(), from.view(), to.view());
  const auto judgement = interruptible([&](const auto& stop) {
    const detector::SteppedMesh motion{from.view(), to.view()};
    const oracle::JudgeOptions options{jobs, stop};
    return within ? oracle::judge_distance(motion, mesh.view(), {within->first, within->second},
                                           {options})
                  : oracle::judge_step(motion, mesh.view(), options);
  });
  py::dict fields = arrays_of(judgement.answer, judgement.first, judgement.pairs);
  fields["feature_candidates"] = judgement.feature_candidates;
  return fields;
}

// Returns the distance, and the pair, its first time within it and its features; or None where no
// two triangles count.
py::object least_distance(const py::object& triangles, const py::object& x_t0,
                          const py::object& x_t1, int jobs) {
  const TrianglesArgument mesh(triangles, "triangles");
  const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  demand_good_input(mesh.view(), from.view(), to.view());
  const auto least = interruptible([&](const auto& stop) {
    return oracle::least_distance({from.view(), to.view()}, mesh.view(),
                                  {oracle::JudgeOptions{jobs, stop}});
  });
  if (!least.where) return py::none();
  const auto& [pair, time, feature] = *least.where;
  py::list vertices;
  for (const auto v : feature.vertices)
    if (v >= 0) vertices.append(v);
  return py::make_tuple(least.distance, py::make_tuple(pair.a, pair.b),
                        py::make_tuple(time.lo, time.hi), detector::name_of(feature.kind),
                        py::tuple(vertices));
}

using reports::CheckInput;
using reports::CheckQuestion;

// Reads an option if its word is given. A word that is not known is a ValueError.
template <class Parse, class Target>
void choose(const py::dict& args, const char* name, const Parse& parse, Target& target) {
  if (!args.contains(name) || args[name].is_none()) return;
  const auto value = parse(args[name].template cast<std::string>());
  if (!value) throw py::value_error(py::str("{}: unknown word {!r}").format(name, args[name]));
  target = *value;
}

template <class Target>
void take(const py::dict& args, const char* name, Target& target) {
  if (args.contains(name) && !args[name].is_none()) target = args[name].cast<Target>();
}

CheckQuestion question_of(const py::dict& args) {
  CheckQuestion question;
  choose(args, "culling", from_name<detector::Culling>, question.built_in.culling);
  choose(args, "start", from_name<detector::Start>, question.built_in.start);
  choose(args, "pairs", from_name<detector::Pairs>, question.built_in.pairs);
  choose(args, "arithmetic", from_name<detector::Arithmetic>, question.built_in.arithmetic);
  choose(args, "isolation", from_name<properties::Isolation>, question.detector.isolation);
  choose(args, "memory", reports::memory_size, question.memory_limit);
  take(args, "detector", question.detector.library);
  take(args, "threads", question.threads);
  take(args, "jobs", question.jobs);
  take(args, "time", question.time_limit);
  take(args, "files", question.files);
  std::optional<double> separation;
  take(args, "separation", separation);
  if (separation) question.distance = {*separation, {}};
  question.wants_report = true;
  return question;
}

// Returns which pairs count; nothing if all do.
std::optional<corpus::CaseRelation> relation_of(const py::dict& args, const corpus::Case& c) {
  corpus::CaseRelation relation;
  take(args, "bodies", relation.pairs.body);
  take(args, "apart", relation.pairs.apart);
  take(args, "rings", relation.pairs.rings);
  take(args, "rest_distance", relation.pairs.rest_distance);
  if (relation.pairs.body.empty() && relation.pairs.count_all()) return std::nullopt;
  if (relation.pairs.rest_distance > 0) relation.pairs.rest = corpus::points_of(c.frames[0]);
  if (const auto bad =
          detector::check_counted_pairs(relation.pairs, c.triangles, c.frames[0].rows()))
    raise(*bad);
  return relation;
}

CheckInput input_of(const py::object& triangles, const py::list& frames, const py::dict& args) {
  corpus::Case c;
  c.triangles = TrianglesArgument(triangles, "triangles").view();
  for (const auto& frame : frames) {
    const auto name = "frame " + std::to_string(c.frames.size());
    const PositionsArgument x(py::reinterpret_borrow<py::object>(frame), name.c_str());
    c.frames.emplace_back(x.view());
    if (const auto bad = detector::check_positions(x.view(), c.frames[0].rows()))
      raise({bad->error, name + ": " + bad->message});
  }
  if (c.frames.empty()) throw py::value_error("at least one frame is needed");
  if (const auto bad = detector::check_triangles(c.triangles, c.frames[0].rows())) raise(*bad);
  c.counted = relation_of(args, c);
  std::vector<std::int32_t> body(static_cast<std::size_t>(c.frames[0].rows()), 0);
  if (c.counted && !c.counted->pairs.body.empty()) body = c.counted->pairs.body;
  corpus::DoubledCorners corners(c.triangles, body);
  for (const auto& x : c.frames) corners.add(x);
  bool weld = false;
  take(args, "weld", weld);
  if (weld) c.triangles = corners.welded(std::move(c.triangles));
  if (const auto bad = detector::check_triangles(c.triangles, c.frames[0].rows())) raise(*bad);
  corpus::InputText text;
  if (auto line = corners.remark(weld); !line.empty()) text.remarks = {std::move(line)};
  return {"frames", corpus::steps_of_case(std::make_shared<const corpus::Case>(std::move(c)), false,
                                          std::move(text))};
}

// Returns the report as JSON, the printed text, and the exit code.
py::tuple check_input(CheckInput& input, const CheckQuestion& question, const std::string& worker,
                      const py::object& listener) {
  std::string text;
  const auto tell = [&](const std::string& remark) {
    text += remark;
    if (listener.is_none()) return;
    const py::gil_scoped_acquire interpreter;
    listener(remark);
  };
  const auto answer = interruptible([&](const auto& stop) {
    return reports::check_mesh(question, input, worker, {tell, stop});
  });
  if (!answer) throw py::value_error(answer.error().message);
  return py::make_tuple(
      answer.value().report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
      text, answer.value().outcome.exit_code(false));
}

py::tuple check_arrays(const py::object& triangles, const py::list& frames, const py::dict& args,
                       const std::string& worker, const py::object& listener) {
  auto input = input_of(triangles, frames, args);
  return check_input(input, question_of(args), worker, listener);
}

// Checks a case file, or files of frames.
py::tuple check_files(const std::vector<std::string>& files, const py::dict& args,
                      const std::string& worker, const py::object& listener) {
  auto question = question_of(args);
  question.files = files;
  auto input = reports::read_check_input(files);
  if (!input) throw py::value_error(input.error().message);
  return check_input(input.value(), question, worker, listener);
}

py::tuple mesh_and_frames(detector::Triangles& triangles,
                          std::vector<detector::Positions>& frames) {
  py::list positions;
  for (auto& frame : frames) positions.append(owning_array(std::move(frame)));
  return py::make_tuple(owning_array(std::move(triangles)), positions);
}

// Returns the files in order, and the remarks on their order.
py::tuple in_order_of_numbers(const std::vector<std::string>& files) {
  const auto order = corpus::in_order_of_numbers({files.begin(), files.end()});
  const std::vector<std::string> paths(order.files.begin(), order.files.end());
  return py::make_tuple(paths, order.remarks);
}

// Returns the triangles, a list of the positions of each frame, and remarks.
py::tuple read_sequence(const std::vector<std::string>& files) {
  const std::vector<std::filesystem::path> paths(files.begin(), files.end());
  auto sequence = [&] {
    const py::gil_scoped_release others_may_run;
    return corpus::read_sequence(paths);
  }();
  if (!sequence) throw py::value_error(sequence.error().message);
  return mesh_and_frames(sequence.value().triangles, sequence.value().frames) +
         py::make_tuple(sequence.value().remarks);
}

// Returns the triangles and the positions of a case file.
py::tuple read_case(const std::string& file) {
  auto c = corpus::read_case(file);
  if (!c) throw py::value_error(c.error().message);
  return mesh_and_frames(c.value().triangles, c.value().frames);
}

// Returns, as JSON, the predicate that a certificate of the run in a folder would have.
std::string findings(const std::string& folder) {
  const auto result = properties::read_findings(folder);
  if (!result) throw py::value_error(result.error().message);
  const auto judgement =
      properties::judge(result.value(), properties::asked_of_a_run(result.value()));
  return reports::run_json(result.value(), judgement)["findings"].dump(
      -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

using properties::CaseRun;
using properties::Claim;
using properties::RunEnd;
using properties::Subject;

// Asks a plug-in steps, limits and queries, in a process of its own.
class Plugin {
 public:
  // Names the plug-in: `library` is a file or "python:MODULE:CLASS", and `worker` the program
  // assay-worker.
  Plugin(const std::string& library, const std::string& worker, double seconds)
      : subject_(open(library, worker, seconds)), process_(subject_.process()) {}

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
      return run_alone(process_, c.value(), subject_.detector.configurations.front());
    }();
    if (run.end == RunEnd::not_run) throw std::runtime_error(run.explanation);
    if (run.end == RunEnd::refused || run.end == RunEnd::beyond_capacity) return py::none();
    py::list answers;
    for (std::size_t s = 0; s < corpus::steps_of(c.value()).size(); ++s)
      answers.append(answer_in(run, s, asks_limits, is_query));
    return answers;
  }

 private:
  static Subject open(const std::string& library, const std::string& worker, double seconds) {
    properties::WorkerLimits limits;
    limits.seconds = seconds;
    auto subject = Subject::open(worker, library, properties::DetectorPart::by_library, limits);
    if (!subject) throw py::value_error(subject.error().message);
    return std::move(subject.value());
  }

  bool serves(bool is_query, double separation, bool asks_limits) const {
    const auto& detector = subject_.detector;
    const bool is_limiter = detector.claims.has_any({Claim::commit_free, Claim::path_free});
    if (separation != detector.contract.separation || asks_limits != is_limiter) return false;
    if (!is_query) return !detector.of_queries;
    return detector.of_queries || detector.query_claims != properties::Claims();
  }

  bool is_taken_as_it_is(const corpus::Case& c) const {
    const auto input = contract_case(c, subject_.detector.contract);
    return input && input->frames == c.frames && corpus::steps_of(*input) == corpus::steps_of(c);
  }

  // Returns an answer as a results file has it (corpus/vectors/README.md).
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
    if (subject_.detector.contract.reports_pairs() && !is_query) {
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

PYBIND11_MODULE(_judge, module) {
  using namespace assay::python;
  module.def("judge", judge);
  module.def("least_distance", least_distance);
  module.def("check_arrays", check_arrays);
  module.def("check_files", check_files);
  module.def("in_order_of_numbers", in_order_of_numbers);
  module.def("read_sequence", read_sequence);
  module.def("read_case", read_case);
  module.def("findings", findings);
  py::class_<Plugin>(module, "Plugin")
      .def(py::init<const std::string&, const std::string&, double>())
      .def_property_readonly("name", &Plugin::name)
      .def_property_readonly("version", &Plugin::version)
      .def("answers", &Plugin::answers);
}
