#include <pybind11/stl.h>

#include "detector/mesh/mesh_checks.h"
#include "properties/judging/case_options.h"
#include "reports/check/check_run.h"
#include "reports/python/array_arguments.h"
#include "reports/python/input_problem.h"
#include "reports/python/interruption.h"
#include "reports/python/judge_binding.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using reports::CheckInput;
using reports::CheckQuestion;

// Reads an option if its word is given. A word that is not known is a ValueError.
template <class Parse, class Target>
void choose(const py::dict& given, const char* name, const Parse& parse, Target& target) {
  if (!given.contains(name) || given[name].is_none()) return;
  const auto value = parse(given[name].template cast<std::string>());
  if (!value) throw py::value_error(py::str("{}: unknown word {!r}").format(name, given[name]));
  target = *value;
}

template <class Target>
void take(const py::dict& given, const char* name, Target& target) {
  if (given.contains(name) && !given[name].is_none()) target = given[name].cast<Target>();
}

CheckQuestion question_of(const py::dict& given) {
  CheckQuestion question;
  choose(given, "culling", from_name<detector::Culling>, question.built_in.culling);
  choose(given, "start", from_name<detector::Start>, question.built_in.start);
  choose(given, "pairs", from_name<detector::Pairs>, question.built_in.pairs);
  choose(given, "arithmetic", from_name<detector::Arithmetic>, question.built_in.arithmetic);
  choose(given, "isolation", properties::isolation_mode_of, question.detector.isolation);
  choose(given, "memory", reports::memory_size, question.memory_limit);
  take(given, "detector", question.detector.library);
  take(given, "threads", question.threads);
  take(given, "jobs", question.jobs);
  if (given.contains("time") && !given["time"].is_none())
    question.time_limit = given["time"].cast<double>();
  take(given, "files", question.files);
  question.wants_report = true;
  return question;
}

CheckInput input_of(const py::object& triangles, const py::list& frames) {
  corpus::Case c;
  c.triangles = TrianglesArgument(triangles, "triangles").view();
  for (const auto& frame : frames) {
    const PositionsArgument x(py::reinterpret_borrow<py::object>(frame), "a frame");
    c.frames.emplace_back(x.view());
    if (const auto bad = detector::check_positions(x.view(), c.frames[0].rows())) raise(*bad);
  }
  if (c.frames.size() < 2) throw py::value_error("a step needs two frames or more");
  if (const auto bad = detector::check_triangles(c.triangles, c.frames[0].rows())) raise(*bad);
  return {"frames",
          reports::steps_of_case(std::make_shared<const corpus::Case>(std::move(c)), false)};
}

// Returns the report as JSON, what is printed, and the exit code.
py::tuple checked(CheckInput& input, const CheckQuestion& question, const std::string& worker,
                  const py::object& listener) {
  std::string text;
  Interruption interruption;
  const reports::CheckListener told{[&](const std::string& said) {
                                      text += said;
                                      if (listener.is_none()) return;
                                      const py::gil_scoped_acquire interpreter;
                                      listener(said);
                                    },
                                    interruption.stop_function()};
  const auto answer = [&] {
    const py::gil_scoped_release others_may_run;
    return reports::check_mesh(question, input, worker, told);
  }();
  interruption.raise();
  if (!answer) throw py::value_error(answer.error().message);
  return py::make_tuple(
      answer.value().report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
      text, answer.value().outcome.exit_code(false));
}

py::tuple check_arrays(const py::object& triangles, const py::list& frames, const py::dict& given,
                       const std::string& worker, const py::object& listener) {
  const auto question = question_of(given);
  auto input = input_of(triangles, frames);
  return checked(input, question, worker, listener);
}

// Checks a case file, or files of frames.
py::tuple check_files(const std::vector<std::string>& files, const py::dict& given,
                      const std::string& worker, const py::object& listener) {
  auto question = question_of(given);
  question.files = files;
  auto input = reports::read_check_input(files);
  if (!input) throw py::value_error(input.error().message);
  return checked(input.value(), question, worker, listener);
}

}  // namespace

void bind_check(py::module_& module) {
  module.def("check_arrays", check_arrays);
  module.def("check_files", check_files);
}

}  // namespace assay::python
