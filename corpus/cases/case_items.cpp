#include "corpus/cases/case_items.h"

#include <fmt/format.h>

#include <cstddef>

#include "corpus/cases/case_names.h"

namespace assay::corpus {
namespace {

Expected<detector::Point> read_point(const JsonField& field) {
  BOOST_OUTCOME_TRY(expect_size(field, 3));
  detector::Point x{};
  for (std::size_t k = 0; k < 3; ++k) {
    BOOST_OUTCOME_TRY(value, field.item(k).number());
    x[k] = value;
  }
  return x;
}

}  // namespace

Expected<void> expect_size(const JsonField& field, std::size_t wanted) {
  BOOST_OUTCOME_TRY(size, field.size());
  if (size != wanted) return field.problem(fmt::format("{} items expected, not {}", wanted, size));
  return boost::outcome_v2::success();
}

Expected<std::vector<detector::Point>> read_points(const JsonField& field) {
  return read_list<detector::Point>(field, read_point);
}

Expected<detector::Positions> read_frame(const JsonField& field) {
  BOOST_OUTCOME_TRY(points, read_points(field));
  detector::Positions x(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      x(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = points[i][k];
    }
  }
  return x;
}

Expected<detector::Triangles> read_triangles(const JsonField& field, std::int64_t vertices,
                                             bool may_repeat) {
  BOOST_OUTCOME_TRY(size, field.size());
  detector::Triangles triangles(static_cast<Eigen::Index>(size), 3);
  for (std::size_t i = 0; i < size; ++i) {
    const JsonField item = field.item(i);
    BOOST_OUTCOME_TRY(expect_size(item, 3));
    auto row = triangles.row(static_cast<Eigen::Index>(i));
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_OUTCOME_TRY(index, item.item(k).integer(0, vertices));
      row(static_cast<Eigen::Index>(k)) = index;
    }
    const bool repeats = row(0) == row(1) || row(1) == row(2) || row(0) == row(2);
    if (repeats && !may_repeat) {
      return item.problem("a vertex named twice");
    }
  }
  return triangles;
}

Expected<detector::TimeEnclosure> read_time(const JsonField& lo, const JsonField& hi) {
  detector::TimeEnclosure time;
  BOOST_OUTCOME_TRY(low, lo.number());
  BOOST_OUTCOME_TRY(high, hi.number());
  time.lo = low;
  time.hi = high;
  if (!(0 <= time.lo && time.lo <= time.hi && time.hi <= 1)) {
    return lo.problem("times with 0 <= lo <= hi <= 1 expected");
  }
  return time;
}

Expected<std::vector<detector::ViewSign>> read_signs(const JsonField& field, std::size_t count) {
  BOOST_OUTCOME_TRY(expect_size(field, count));
  return read_list<detector::ViewSign>(field,
                                       [](const JsonField& item) -> Expected<detector::ViewSign> {
                                         BOOST_OUTCOME_TRY(sign, item.integer(-1, 2));
                                         return static_cast<detector::ViewSign>(sign);
                                       });
}

Expected<detector::Answer> read_answer(const JsonField& field) {
  BOOST_OUTCOME_TRY(name, field.text());
  const auto answer = from_name<detector::Answer>(name);
  if (!answer) return field.problem("free, collision, undecided or error expected");
  return *answer;
}

}  // namespace assay::corpus
