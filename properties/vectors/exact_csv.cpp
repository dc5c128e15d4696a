#include "properties/vectors/exact_csv.h"

#include <fmt/format.h>
#include <gmpxx.h>

#include <cmath>

#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// Numerator and denominator, without a common divisor.
std::string rational(double x) {
  const mpq_class exact(x);
  return exact.get_num().get_str() + "," + exact.get_den().get_str();
}

}  // namespace

std::string csv_name(const VectorGroup& group) {
  return fmt::format("{}/{}{}.csv", name_of(group.features),
                     group.question == VectorQuestion::distance ? "distance-" : "",
                     name_of(group.precision));
}

std::string csv_text(const VectorGroup& group) {
  std::string text;
  for (const auto& v : group.cases) {
    const auto query = *query_of(v.c);
    std::string end = v.result() == VectorResult::free ? ",0" : ",1";
    if (group.question == VectorQuestion::distance) end += fmt::format(",{}", v.distance);
    for (const auto place : {&detector::MovingPoint::t0, &detector::MovingPoint::t1}) {
      for (const auto& p : query.points) {
        const auto& x = p.*place;
        text += fmt::format("{},{},{}{}\n", rational(x[0]), rational(x[1]), rational(x[2]), end);
      }
    }
  }
  return text;
}

}  // namespace assay::properties
