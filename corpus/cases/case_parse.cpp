// Reads the text of a case: see case_file.h.

#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/json_fields.h"
#include "corpus/problem.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {

namespace {

// The small parts of a case file: points, triangles, times, signs.

// Fails unless `field` is an array of `wanted` items.
Expected<void> expect_size(const JsonField& field, std::size_t wanted) {
  BOOST_OUTCOME_TRY(size, field.size());
  if (size != wanted) return field.problem(fmt::format("{} items expected, not {}", wanted, size));
  return boost::outcome_v2::success();
}

Expected<detector::Point> read_point(const JsonField& field) {
  BOOST_OUTCOME_TRY(expect_size(field, 3));
  detector::Point x{};
  for (std::size_t k = 0; k < 3; ++k) {
    BOOST_OUTCOME_TRY(value, field.item(k).number());
    x[k] = value;
  }
  return x;
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

// Reads triples of indices below `vertices`; unless `may_repeat`, the three of a triple differ.
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

// Reads two numbers, and demands 0 <= lo <= hi <= 1.
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

// Reads `count` signs, each -1, 0 or 1.
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

// Reads lists of so many integers, each in [0, end).
template <std::size_t n>
Expected<std::vector<std::array<std::int32_t, n>>> read_tuples(const JsonField& field,
                                                               std::int64_t end) {
  using Tuple = std::array<std::int32_t, n>;
  return read_list<Tuple>(field, [end](const JsonField& item) -> Expected<Tuple> {
    BOOST_OUTCOME_TRY(expect_size(item, n));
    Tuple tuple{};
    for (std::size_t i = 0; i < n; ++i) {
      BOOST_OUTCOME_TRY(value, item.item(i).integer(0, end));
      tuple[i] = value;
    }
    return tuple;
  });
}

class CaseParser {
 public:
  explicit CaseParser(JsonField top) : top_(std::move(top)) {}

  Expected<Case> read() {
    BOOST_OUTCOME_TRY(schema, top_.at("schema"));
    if (schema.json() != case_schema) {
      return schema.problem(fmt::format("{} expected", case_schema));
    }
    BOOST_OUTCOME_TRY(read_text("id", case_.id));
    BOOST_OUTCOME_TRY(read_text("about", case_.about));
    BOOST_OUTCOME_TRY(read_text("source", case_.source));
    BOOST_OUTCOME_TRY(read_mesh());
    if (top_.has("script")) {
      BOOST_OUTCOME_TRY(read_script());
    }
    if (top_.has("view")) {
      BOOST_OUTCOME_TRY(read_view());
    }
    if (top_.has("ghosts")) {
      BOOST_OUTCOME_TRY(read_ghosts());
    }
    BOOST_OUTCOME_TRY(read_options());
    BOOST_OUTCOME_TRY(read_expected());
    if (top_.has("counted")) {
      BOOST_OUTCOME_TRY(read_counted());
    }
    BOOST_OUTCOME_TRY(pending, top_.at("pending"));
    if (!pending.json().is_object()) return pending.problem("an object expected");
    case_.pending = pending.json().dump();
    return std::move(case_);
  }

 private:
  Expected<void> read_text(std::string_view key, std::string& value) {
    BOOST_OUTCOME_TRY(field, top_.at(key));
    BOOST_OUTCOME_TRY(text, field.text());
    value = std::move(text);
    return boost::outcome_v2::success();
  }

  Expected<void> read_mesh() {
    BOOST_OUTCOME_TRY(frames, top_.at("frames"));
    BOOST_OUTCOME_TRY(list, read_list<detector::Positions>(frames, read_frame));
    if (list.empty()) return frames.problem("at least one frame expected");
    for (std::size_t i = 1; i < list.size(); ++i) {
      if (list[i].rows() != list[0].rows()) {
        return frames.item(i).problem(
            fmt::format("{} vertices, but frame 0 has {}", list[i].rows(), list[0].rows()));
      }
    }
    case_.frames = std::move(list);
    BOOST_OUTCOME_TRY(expected, top_.at("expected"));
    if (expected.has("answer")) {
      BOOST_OUTCOME_TRY(answer_field, expected.at("answer"));
      BOOST_OUTCOME_TRY(answer, read_answer(answer_field));
      case_.expected.answer = answer;
    }
    BOOST_OUTCOME_TRY(field, top_.at("triangles"));
    BOOST_OUTCOME_TRY(triangles, read_triangles(field, case_.frames[0].rows(),
                                                case_.expected.answer == detector::Answer::error));
    if (triangles.rows() == 0) return field.problem("none");
    case_.triangles = std::move(triangles);
    return boost::outcome_v2::success();
  }

  Expected<void> read_script() {
    BOOST_OUTCOME_TRY(field, top_.at("script"));
    BOOST_OUTCOME_TRY(steps, read_list<CaseStep>(field, [&](const JsonField& item) {
                        return read_script_step(item);
                      }));
    if (steps.empty()) return field.problem("at least one step expected");
    case_.script = std::move(steps);
    return boost::outcome_v2::success();
  }

  Expected<CaseStep> read_script_step(const JsonField& field) const {
    BOOST_OUTCOME_TRY(expect_size(field, 3));
    const auto frames = static_cast<std::int64_t>(case_.frames.size());
    BOOST_OUTCOME_TRY(from, field.item(0).integer(0, frames));
    BOOST_OUTCOME_TRY(to, field.item(1).integer(0, frames));
    BOOST_OUTCOME_TRY(action, field.item(2).text());
    if (action != "commit" && action != "evaluate") {
      return field.item(2).problem("commit or evaluate expected");
    }
    return CaseStep{static_cast<std::int32_t>(from), static_cast<std::int32_t>(to),
                    action == "commit"};
  }

  Expected<void> read_view() {
    CaseView view;
    BOOST_OUTCOME_TRY(field, top_.at("view"));
    BOOST_OUTCOME_TRY(q0, field.at("q0"));
    BOOST_OUTCOME_TRY(expect_size(q0, case_.frames.size()));
    BOOST_OUTCOME_TRY(first, read_points(q0));
    view.q0 = std::move(first);
    if (field.has("q1")) {
      BOOST_OUTCOME_TRY(q1, field.at("q1"));
      BOOST_OUTCOME_TRY(expect_size(q1, case_.frames.size()));
      BOOST_OUTCOME_TRY(second, read_points(q1));
      view.q1 = std::move(second);
    }
    case_.view = std::move(view);
    return boost::outcome_v2::success();
  }

  Expected<void> read_ghosts() {
    CaseGhosts ghosts;
    BOOST_OUTCOME_TRY(field, top_.at("ghosts"));
    BOOST_OUTCOME_TRY(apexes, field.at("apexes"));
    BOOST_OUTCOME_TRY(expect_size(apexes, case_.frames.size()));
    BOOST_OUTCOME_TRY(places, read_list<std::vector<detector::Point>>(apexes, read_points));
    for (std::size_t i = 1; i < places.size(); ++i) {
      BOOST_OUTCOME_TRY(expect_size(apexes.item(i), places[0].size()));
    }
    ghosts.apexes = std::move(places);
    BOOST_OUTCOME_TRY(triangles_field, field.at("triangles"));
    const auto end = case_.frames[0].rows() + static_cast<std::int64_t>(ghosts.apexes[0].size());
    BOOST_OUTCOME_TRY(triangles, read_triangles(triangles_field, end, true));
    ghosts.triangles = std::move(triangles);
    case_.ghosts = std::move(ghosts);
    return boost::outcome_v2::success();
  }

  Expected<void> read_options() {
    BOOST_OUTCOME_TRY(field, top_.at("options"));
    if (!field.json().is_object()) return field.problem("an object expected");
    for (const auto& [key, value] : field.json().items()) {
      BOOST_OUTCOME_TRY(option, field.at(key));
      BOOST_OUTCOME_TRY(text, option.text());
      case_.options[key] = std::move(text);
    }
    return boost::outcome_v2::success();
  }

  Expected<void> read_expected() {
    BOOST_OUTCOME_TRY(expected, top_.at("expected"));
    BOOST_OUTCOME_TRY(field, expected.at("steps"));
    BOOST_OUTCOME_TRY(steps, read_list<ExpectedStep>(
                                 field, [&](const JsonField& item) { return read_step(item); }));
    if (!steps.empty()) {
      BOOST_OUTCOME_TRY(expect_size(field, steps_of(case_).size()));
    }
    case_.expected.steps = std::move(steps);
    return boost::outcome_v2::success();
  }

  Expected<void> read_counted() {
    BOOST_OUTCOME_TRY(field, top_.at("counted"));
    BOOST_OUTCOME_TRY(level_field, field.at("level"));
    BOOST_OUTCOME_TRY(level_name, level_field.text());
    const auto level = from_name<detector::CountedLevel>(level_name);
    if (!level) return level_field.problem("triangles or features expected");
    CaseRelation relation;
    relation.pairs.level = *level;
    BOOST_OUTCOME_TRY(read_bodies(field, relation.pairs));
    BOOST_OUTCOME_TRY(read_rest(field, relation.pairs));
    BOOST_OUTCOME_TRY(read_counted_lists(field, relation.pairs));
    if (auto problem = detector::check_counted_pairs(relation.pairs, case_.triangles,
                                                     case_.frames[0].rows())) {
      return field.problem(fmt::format("{}: {}", name_of(problem->error), problem->message));
    }
    if (field.has("steps")) {
      BOOST_OUTCOME_TRY(steps_field, field.at("steps"));
      BOOST_OUTCOME_TRY(expect_size(steps_field, steps_of(case_).size()));
      BOOST_OUTCOME_TRY(steps, read_list<ExpectedStep>(steps_field, [&](const JsonField& item) {
                          return read_step(item);
                        }));
      relation.steps = std::move(steps);
    }
    case_.counted = std::move(relation);
    return boost::outcome_v2::success();
  }

  Expected<void> read_bodies(const JsonField& field, detector::CountedPairs& pairs) const {
    const std::int64_t vertices = case_.frames[0].rows();
    if (field.has("bodies")) {
      BOOST_OUTCOME_TRY(bodies, field.at("bodies"));
      BOOST_OUTCOME_TRY(runs, read_tuples<2>(bodies, vertices + 1));
      for (const auto& [count, body] : runs) {
        if (static_cast<std::int64_t>(pairs.body.size()) + count > vertices)
          return bodies.problem(fmt::format("more than {} vertices", vertices));
        pairs.body.insert(pairs.body.end(), static_cast<std::size_t>(count), body);
      }
    }
    if (field.has("apart")) {
      BOOST_OUTCOME_TRY(apart_field, field.at("apart"));
      BOOST_OUTCOME_TRY(apart, read_tuples<2>(apart_field, vertices));
      pairs.apart = std::move(apart);
    }
    return boost::outcome_v2::success();
  }

  Expected<void> read_rest(const JsonField& field, detector::CountedPairs& pairs) const {
    if (field.has("rings")) {
      BOOST_OUTCOME_TRY(rings_field, field.at("rings"));
      BOOST_OUTCOME_TRY(rings, rings_field.integer(0, std::int64_t{1} << 31));
      pairs.rings = rings;
    }
    if (field.has("rest_distance")) {
      BOOST_OUTCOME_TRY(distance_field, field.at("rest_distance"));
      BOOST_OUTCOME_TRY(distance, distance_field.number());
      pairs.rest_distance = distance;
    }
    if (field.has("rest")) {
      BOOST_OUTCOME_TRY(rest_field, field.at("rest"));
      BOOST_OUTCOME_TRY(rest, read_points(rest_field));
      pairs.rest = std::move(rest);
    } else if (pairs.rest_distance != 0) {
      pairs.rest = points_of(case_.frames[0]);
    }
    return boost::outcome_v2::success();
  }

  Expected<void> read_counted_lists(const JsonField& field, detector::CountedPairs& pairs) const {
    const std::int64_t vertices = case_.frames[0].rows(), triangles = case_.triangles.rows();
    if (field.has("triangle_pairs")) {
      BOOST_OUTCOME_TRY(list_field, field.at("triangle_pairs"));
      BOOST_OUTCOME_TRY(list, read_tuples<2>(list_field, triangles));
      for (const auto& [a, b] : list) pairs.triangle_pairs.push_back({a, b});
    }
    if (field.has("vertex_faces")) {
      BOOST_OUTCOME_TRY(list_field, field.at("vertex_faces"));
      BOOST_OUTCOME_TRY(list, read_tuples<2>(list_field, std::max(vertices, triangles)));
      for (const auto& [v, face] : list) pairs.vertex_faces.push_back({v, face});
    }
    if (field.has("edge_pairs")) {
      BOOST_OUTCOME_TRY(list_field, field.at("edge_pairs"));
      BOOST_OUTCOME_TRY(list, read_tuples<4>(list_field, vertices));
      for (const auto& [a, b, c, d] : list) pairs.edge_pairs.push_back({{a, b}, {c, d}});
    }
    return boost::outcome_v2::success();
  }

  Expected<ExpectedStep> read_step(const JsonField& field) const {
    ExpectedStep step;
    BOOST_OUTCOME_TRY(answer_field, field.at("answer"));
    BOOST_OUTCOME_TRY(answer, read_answer(answer_field));
    step.answer = answer;
    if (field.has("first_time")) {
      BOOST_OUTCOME_TRY(time_field, field.at("first_time"));
      BOOST_OUTCOME_TRY(expect_size(time_field, 2));
      BOOST_OUTCOME_TRY(time, read_time(time_field.item(0), time_field.item(1)));
      step.first_time = time;
    }
    if (field.has("pairs")) {
      BOOST_OUTCOME_TRY(pairs_field, field.at("pairs"));
      BOOST_OUTCOME_TRY(pairs, read_list<ExpectedPair>(pairs_field, [&](const JsonField& item) {
                          return read_pair(item);
                        }));
      step.pairs = std::move(pairs);
    }
    if (field.has("view_signs")) {
      BOOST_OUTCOME_TRY(signs_field, field.at("view_signs"));
      BOOST_OUTCOME_TRY(signs,
                        read_signs(signs_field, static_cast<std::size_t>(case_.triangles.rows())));
      step.view_signs = std::move(signs);
    }
    if (field.has("ghost_view_signs")) {
      BOOST_OUTCOME_TRY(signs_field, field.at("ghost_view_signs"));
      const auto ghosts = case_.ghosts ? case_.ghosts->triangles.rows() : 0;
      BOOST_OUTCOME_TRY(signs, read_signs(signs_field, static_cast<std::size_t>(ghosts)));
      step.ghost_view_signs = std::move(signs);
    }
    return step;
  }

  Expected<ExpectedPair> read_pair(const JsonField& field) const {
    BOOST_OUTCOME_TRY(expect_size(field, 4));
    ExpectedPair pair;
    BOOST_OUTCOME_TRY(b, field.item(1).integer(1, case_.triangles.rows()));
    BOOST_OUTCOME_TRY(a, field.item(0).integer(0, b));
    BOOST_OUTCOME_TRY(time, read_time(field.item(2), field.item(3)));
    pair.pair = {a, b};
    pair.time = time;
    return pair;
  }

  JsonField top_;
  Case case_;
};

}  // namespace

Expected<Case> parse_case(std::string_view text, std::string_view name) try {
  const std::filesystem::path file(name);
  BOOST_OUTCOME_TRY(json, parse_json(text, file));
  return CaseParser(JsonField(json, file)).read();
} catch (const std::bad_alloc&) {
  return problem_in(name, "larger than the memory at hand");
}

}  // namespace assay::corpus
