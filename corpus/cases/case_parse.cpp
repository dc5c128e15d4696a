// Reads the text of a case: see case_file.h.
#include <fmt/format.h>

#include <boost/outcome/try.hpp>
#include <new>
#include <utility>

#include "corpus/cases/case_file.h"
#include "corpus/cases/case_items.h"
#include "corpus/cases/case_names.h"
#include "corpus/json_fields.h"

namespace assay::corpus {
namespace {

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
