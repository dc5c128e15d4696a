#include "detector/plugin/builtin.h"

#include <new>
#include <optional>

#include "detector/detector.h"

struct assay_handle {
  assay::detector::Detector detector;
  Eigen::Index vertex_count;
  assay::detector::StepResult result;
  std::vector<std::int32_t> pairs;
  std::vector<double> times;
};

namespace assay::detector {
namespace {

using PositionsMap = Eigen::Map<const detector::Positions>;

// The built-in detector throws nothing but the want of memory.
template <class Function>
std::int32_t guarded(const Function& function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return ASSAY_OUT_OF_MEMORY;
  }
}

const assay_description* describe() {
  static const assay_description description = {
      "built-in as a plug-in",
      "1",
      ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
          ASSAY_CLAIM_FIRST_PAIRS | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_NO_SPURIOUS |
          ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL,
      ASSAY_ADJACENCY_ALL,
      ASSAY_COORDINATES_FLOAT64,
      0};
  return &description;
}

std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) {
  return guarded([&]() -> std::int32_t {
    const auto m = static_cast<Eigen::Index>(triangle_count);
    const auto n = static_cast<Eigen::Index>(vertex_count);
    auto made = detector::Detector::create(Eigen::Map<const detector::Triangles>(triangles, m, 3),
                                           PositionsMap(positions, n, 3), {});
    if (!made) {
      *message = detector::name_of(made.error().error);
      return ASSAY_REFUSED;
    }
    *handle = new assay_handle{std::move(made.value()), n, {}, {}, {}};
    return ASSAY_OK;
  });
}

std::int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  return guarded([&]() -> std::int32_t {
    h->result = h->detector.evaluate(PositionsMap(x_t0, h->vertex_count, 3),
                                     PositionsMap(x_t1, h->vertex_count, 3));
    h->pairs.clear();
    h->times.clear();
    for (const auto& contact : h->result.pairs) {
      h->pairs.insert(h->pairs.end(), {contact.pair.a, contact.pair.b});
      h->times.insert(h->times.end(), {contact.time.lo, contact.time.hi});
    }
    return ASSAY_OK;
  });
}

std::int32_t commit(assay_handle* h) {
  return guarded([&]() -> std::int32_t { return h->detector.commit() ? ASSAY_FAILED : ASSAY_OK; });
}

std::int32_t result(assay_handle* h, assay_result* out) {
  switch (h->result.answer) {
    case Answer::free:
      out->answer = ASSAY_FREE;
      break;
    case Answer::collision:
      out->answer = ASSAY_COLLISION;
      break;
    case Answer::undecided:
      out->answer = ASSAY_UNDECIDED;
      break;
    case Answer::error:
      out->answer = ASSAY_ERROR;
      out->message = h->result.problem->message.c_str();
      break;
  }
  out->first_lo = h->result.first.lo;
  out->first_hi = h->result.first.hi;
  out->pair_count = h->result.pairs.size();
  out->pairs = h->pairs.data();
  out->pair_times = h->times.data();
  return ASSAY_OK;
}

void destroy(assay_handle* h) { delete h; }

}  // namespace
}  // namespace assay::detector

const assay_detector_api* assay_builtin_detector() {
  using namespace assay::detector;
  static const assay_detector_api api = {
      ASSAY_DETECTOR_ABI_VERSION, describe, create, evaluate, commit, result, destroy};
  return &api;
}
