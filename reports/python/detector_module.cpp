// The module assay._detector holds the production detector and its elementary test, and no oracle.
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <limits>

#include "detector/contact/elementary.h"
#include "detector/detector.h"
#include "detector/parallel/processor_state.h"
#include "properties/judging/case_options.h"
#include "reports/python/arrays.h"
#include "reports/python/calls.h"

namespace assay::python {
namespace {

namespace py = pybind11;

using detector::Detector;
using detector::SavedState;

// A detector is used by one thread at a time. A call that finds another one under way is refused,
// because the answers of steps depend on their order.
class OneAtATime {
 public:
  explicit OneAtATime(std::atomic_flag& busy) : busy_(busy) {
    if (busy_.test_and_set())
      throw std::runtime_error("this detector is at work in another thread: one thread at a time");
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
  ~OneAtATime() { busy_.clear(); }

 private:
  std::atomic_flag& busy_;
};

// After a fork the threads of the parent process are not there. A call that would wait for them is
// refused.
void threads_in_this_process(std::uint32_t threads) {
  static std::atomic<pid_t> process = 0;  // the first process that used several
  if (threads == 1) return;
  pid_t first = 0;
  if (!process.compare_exchange_strong(first, ::getpid()) && first != ::getpid())
    throw std::runtime_error(
        "threads: this process was forked from one that had several; use 1, or spawn it");
}

class PythonDetector {
 public:
  // `options` are words by their names, as a case file states them. If `threads` is 0, all cores
  // are used.
  PythonDetector(const py::object& triangles, const py::object& positions, const py::dict& options,
                 std::uint32_t threads)
      : threads_(threads), detector_(made(triangles, positions, options, threads)) {}

  py::dict evaluate(const py::object& x_t0, const py::object& x_t1) {
    return answered(x_t0, x_t1, [this](const auto& from, const auto& to, const auto& stop) {
      return detector_.evaluate(from, to, {}, stop);
    });
  }

  py::dict step(const py::object& x_t0, const py::object& x_t1) {
    return answered(x_t0, x_t1, [this](const auto& from, const auto& to, const auto& stop) {
      return detector_.step(from, to, {}, stop);
    });
  }

  py::dict first_contact(const py::object& x_t0, const py::object& x_t1, double until) {
    return answered(x_t0, x_t1, [&](const auto& from, const auto& to, const auto& stop) {
      return detector_.first_contact(from, to, until, stop);
    });
  }

  py::tuple limit(const py::object& x_t0, const py::object& x_t1) {
    const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
    threads_in_this_process(threads_);
    const OneAtATime alone(busy_);
    auto limit = interruptible(
        [&](const auto& stop) { return detector_.limit(from.view(), to.view(), stop); });
    if (limit.problem) raise(*limit.problem);
    const auto& first = limit.first;
    py::object time = py::none();
    if (limit.answer == detector::Answer::collision) time = py::make_tuple(first.lo, first.hi);
    return py::make_tuple(limit.share, owning_array(std::move(limit.positions)), time,
                          limit.is_short);
  }

  void commit() {
    const OneAtATime alone(busy_);
    if (const auto problem = detector_.commit()) raise(*problem);
  }

  void reset() {
    const OneAtATime alone(busy_);
    detector_.reset();
  }

  SavedState state() {
    const OneAtATime alone(busy_);
    return detector_.state();
  }

  void restore(const SavedState& state) {
    const OneAtATime alone(busy_);
    if (const auto problem = detector_.restore(state)) raise(*problem);
  }

 private:
  static Detector made(const py::object& triangles, const py::object& positions,
                       const py::dict& options, std::uint32_t threads) {
    threads_in_this_process(threads);
    corpus::Case stated;
    for (const auto& [name, word] : options) {
      if (!py::isinstance<py::str>(word))
        throw py::type_error(py::str("{}: a word is wanted, not {!r}").format(name, word));
      stated.options[name.cast<std::string>()] = word.cast<std::string>();
    }
    auto chosen = properties::read_options(stated);
    if (!chosen) throw py::value_error(chosen.error().message);
    chosen.value().threads = threads;
    const TrianglesArgument mesh(triangles, "triangles");
    const PositionsArgument places(positions, "positions");
    auto detector = interruptible([&](const auto& stop) {
      return Detector::create(mesh.view(), places.view(), chosen.value(), stop);
    });
    if (!detector) raise(detector.error());
    return std::move(detector.value());
  }

  template <class Ask>
  py::dict answered(const py::object& x_t0, const py::object& x_t1, const Ask& ask) {
    const PositionsArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
    threads_in_this_process(threads_);
    const OneAtATime alone(busy_);
    auto result =
        interruptible([&](const auto& stop) { return ask(from.view(), to.view(), stop); });
    if (result.answer == detector::Answer::error) raise(*result.problem);
    return arrays_of(std::move(result));
  }

  std::uint32_t threads_;
  Detector detector_;
  std::atomic_flag busy_;
};

py::bytes bytes_of(const SavedState& state) {
  const auto bytes = state.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

SavedState state_of(const py::bytes& bytes) {
  const std::string_view text = bytes;
  auto state = SavedState::read({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  if (!state) raise(state.error());
  return std::move(state.value());
}

// The words of each option, as a dict of tuples.
py::dict words_of_options() {
  py::dict words;
  const detector::Options standard;
  for_each_choice(standard, [&](const char* option, auto value) {
    py::list list;
    for (const auto each : all_values<decltype(value)>) list.append(name_of(each));
    words[option] = py::tuple(list);
  });
  return words;
}

// After this many queries it is asked whether signals have come. They take about a millisecond.
constexpr std::size_t queries_of_a_piece = 1024;

// Whether it came to the end.
bool answer(const QueriesArgument& x_t0, const QueriesArgument& x_t1, int first_group, bool* hit,
            double* lo, double* hi, const detector::StopFunction& stop) {
  constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < x_t0.count(); ++k) {
    if (k % queries_of_a_piece == 0 && stop()) return false;
    detector::FourPoints query;
    query.first_group = first_group;
    for (std::size_t i = 0; i < QueriesArgument::points; ++i)
      query.points[i] = {x_t0.point(k, i), x_t1.point(k, i)};
    const auto result = detector::test_contact(query, detector::Want::first_time);
    hit[k] = result.contact;
    lo[k] = result.contact ? result.time.lo : no_time;
    hi[k] = result.contact ? result.time.hi : no_time;
  }
  return true;
}

py::tuple answers(const py::object& x_t0, const py::object& x_t1, int first_group) {
  const QueriesArgument from(x_t0, "x_t0"), to(x_t1, "x_t1");
  if (from.count() != to.count())
    throw py::value_error("x_t0 has " + std::to_string(from.count()) + " queries, x_t1 " +
                          std::to_string(to.count()));
  const auto count = static_cast<py::ssize_t>(from.count());
  py::array_t<bool> hit(count);
  py::array_t<double> lo(count), hi(count);
  bool* hits = hit.mutable_data();
  double *los = lo.mutable_data(), *his = hi.mutable_data();
  interruptible([&](const auto& stop) {
    const detector::ProcessorState state;
    return answer(from, to, first_group, hits, los, his, state.in_callers_state(stop));
  });
  return py::make_tuple(hit, lo, hi);
}

}  // namespace
}  // namespace assay::python

PYBIND11_MODULE(_detector, module) {
  using namespace assay::python;
  module.attr("VERSION") = ASSAY_VERSION;
  module.attr("OPTIONS") = words_of_options();
  py::class_<SavedState>(module, "State")
      .def("__bytes__", bytes_of)
      .def_static("from_bytes", state_of);
  py::class_<PythonDetector>(module, "Detector")
      .def(py::init<const py::object&, const py::object&, const py::dict&, std::uint32_t>())
      .def("evaluate", &PythonDetector::evaluate)
      .def("commit", &PythonDetector::commit)
      .def("step", &PythonDetector::step)
      .def("first_contact", &PythonDetector::first_contact)
      .def("limit", &PythonDetector::limit)
      .def("state", &PythonDetector::state)
      .def("restore", &PythonDetector::restore)
      .def("reset", &PythonDetector::reset);
  module.def("vertex_face",
             [](const py::object& x_t0, const py::object& x_t1) { return answers(x_t0, x_t1, 1); });
  module.def("edge_edge",
             [](const py::object& x_t0, const py::object& x_t1) { return answers(x_t0, x_t1, 2); });
}
