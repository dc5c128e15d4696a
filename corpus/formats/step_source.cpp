#include "corpus/formats/step_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <iterator>
#include <utility>

#include "corpus/files.h"
#include "corpus/formats/sequences.h"
#include "corpus/formats/step_log.h"
#include "corpus/formats/text_lines.h"
#include "detector/mesh/mesh_checks.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {
namespace {

using detector::Positions;

using FramesOfBodies = std::vector<std::vector<std::filesystem::path>>;

// Describes these files for the first line that a user sees.
std::string title_of(const FramesOfBodies& bodies) {
  const bool stands = std::ranges::all_of(bodies, [](const auto& one) { return one.size() == 1; });
  if (bodies.size() > 1) return fmt::format("{} bodies{}", bodies.size(), stands ? " at rest" : "");
  const auto& files = bodies.front();
  if (std::ranges::all_of(files, [&](const auto& file) { return file == files.front(); }))
    return "one mesh at rest";
  const auto [from, to] = short_names(files.front(), files.back());
  const auto through = files.size() == 2 ? "" : fmt::format("through {} frames ", files.size());
  return in_one_line(fmt::format("one mesh moving {}from {} to {}", through, from, to));
}

Expected<void> add_all(DoubledCorners& corners, BodiesReader reader) {
  while (!reader.at_end()) {
    BOOST_OUTCOME_TRY(x, reader.next());
    corners.add(x);
  }
  return boost::outcome_v2::success();
}

class StepsOfCase : public StepSource {
 public:
  StepsOfCase(std::shared_ptr<const Case> c, bool is_case_file, InputText text)
      : case_(std::move(c)),
        script_(steps_of(*case_)),
        is_case_file_(is_case_file),
        text_(std::move(text)) {}

  InputText text() const override { return text_; }

  std::size_t count() const override { return script_.size(); }
  std::size_t frames() const override { return case_->frames.size(); }
  const detector::Triangles& triangles() const override { return case_->triangles; }
  const Positions& first_frame() const override { return case_->frames.front(); }

  Expected<SourceStep> step(std::size_t s) override {
    return SourceStep{start_of(*case_, script_[s]), end_of(*case_, script_[s]),
                      view_of_step(*case_, s), script_[s].commit};
  }

  const detector::CountedPairs* counted() const override { return counted_of(*case_); }
  std::shared_ptr<const Case> whole() const override { return case_; }
  const Case* case_file() const override { return is_case_file_ ? case_.get() : nullptr; }

  Expected<std::unique_ptr<StepSource>> read_whole() override {
    return steps_of_case(case_, is_case_file_, text_);
  }

 private:
  std::shared_ptr<const Case> case_;
  std::vector<CaseStep> script_;
  bool is_case_file_;
  InputText text_;
};

// Consecutive steps share a frame: the end of one is the start of the next. One frame alone is both
// ends of one step, and then there is no second.
class StepsOfFiles : public StepSource {
 public:
  StepsOfFiles(InputText text, BodiesReader reader, detector::Triangles triangles,
               std::optional<detector::CountedPairs> counted, Positions first, Positions second)
      : text_(std::move(text)),
        reader_(std::move(reader)),
        triangles_(std::move(triangles)),
        counted_(std::move(counted)),
        x_t0_(std::move(first)),
        x_t1_(std::move(second)) {}

  std::size_t count() const override { return std::max<std::size_t>(reader_.frames(), 2) - 1; }
  std::size_t frames() const override { return reader_.frames(); }
  const detector::Triangles& triangles() const override { return triangles_; }
  const Positions& first_frame() const override { return x_t0_; }
  const detector::CountedPairs* counted() const override { return counted_ ? &*counted_ : nullptr; }
  InputText text() const override { return text_; }

  Expected<SourceStep> step(std::size_t s) override {
    if (s > step_) {
      BOOST_OUTCOME_TRYV(go_on());
    }
    return SourceStep{x_t0_, is_at_rest() ? x_t0_ : x_t1_};
  }

  Expected<std::unique_ptr<StepSource>> read_whole() override {
    Case c;
    c.triangles = triangles_;
    if (counted_) c.counted = CaseRelation{*counted_, {}};
    c.frames.push_back(std::move(x_t0_));
    if (!is_at_rest()) c.frames.push_back(std::move(x_t1_));
    while (!reader_.at_end()) {
      BOOST_OUTCOME_TRY(frame, reader_.next());
      c.frames.push_back(std::move(frame));
    }
    return steps_of_case(std::make_shared<const Case>(std::move(c)), false, text_);
  }

 private:
  Expected<void> go_on() {
    x_t0_.swap(x_t1_);
    x_t1_.resize(0, 3);  // so that there are not three while the next one is read
    BOOST_OUTCOME_TRY(frame, reader_.next());
    x_t1_ = std::move(frame);
    ++step_;
    return boost::outcome_v2::success();
  }

  InputText text_;
  BodiesReader reader_;
  detector::Triangles triangles_;
  std::optional<detector::CountedPairs> counted_;
  std::size_t step_ = 0;  // the step from x_t0_ to x_t1_
  Positions x_t0_, x_t1_;
};

}  // namespace

Problem problem_of_triangles(const StepSource& steps, const std::filesystem::path& file,
                             const detector::Problem& problem) {
  if (problem.error == detector::InputError::same_vertices_twice) {
    for (const auto& own : steps.text().files) {
      if (const auto places = places_of_same_faces(own); !places.empty())
        return problem_in(own, fmt::format("{} ({}): remove one of them, in MeshLab by Remove "
                                           "Duplicate Faces",
                                           problem.message, places));
    }
  }
  return problem_in(file, problem.message);
}

std::unique_ptr<StepSource> steps_of_case(std::shared_ptr<const Case> c, bool is_case_file,
                                          InputText text) {
  return std::make_unique<StepsOfCase>(std::move(c), is_case_file, std::move(text));
}

Expected<std::unique_ptr<StepSource>> steps_of_files(std::vector<std::filesystem::path> files) {
  return steps_of_bodies({{std::move(files)}, {}});
}

Expected<std::unique_ptr<StepSource>> steps_of_bodies(const BodyFiles& bodies) {
  InputText text;
  auto frames = bodies.frames;
  for (auto& files : frames) {
    auto ordered = in_order_of_numbers(files);
    files = std::move(ordered.files);
    for (const auto& file : files) text.files.push_back(file.string());
    std::ranges::move(ordered.remarks, std::back_inserter(text.remarks));
  }
  text.title = title_of(frames);
  BodiesReader reader(frames);
  BOOST_OUTCOME_TRYV(reader.fit());
  BOOST_OUTCOME_TRY(first, reader.next());
  std::optional<detector::CountedPairs> counted;
  const auto bodies_of_vertices = reader.bodies();
  const bool has_bodies = bodies.frames.size() > 1 || !bodies.apart.empty();
  if (has_bodies || bodies.rings > 0 || bodies.rest_distance > 0) {
    counted.emplace();
    if (has_bodies) counted->body = bodies_of_vertices;
    counted->apart = bodies.apart;
    counted->rings = bodies.rings;
    counted->rest_distance = bodies.rest_distance;
    if (bodies.rest_distance > 0) counted->rest = points_of(first);
    if (const auto wrong =
            detector::check_counted_pairs(*counted, reader.triangles(), first.rows()))
      return problem_in({}, wrong->message);
  }
  Positions second;
  if (!reader.at_end()) {
    BOOST_OUTCOME_TRY(frame, reader.next());
    second = std::move(frame);
  }
  BOOST_OUTCOME_TRYV(reader.look_ahead());
  std::ranges::move(reader.remarks(), std::back_inserter(text.remarks));
  DoubledCorners corners(reader.triangles(), bodies_of_vertices);
  auto triangles = reader.triangles();
  if (bodies.weld) {
    BOOST_OUTCOME_TRYV(add_all(corners, BodiesReader(frames)));
    triangles = corners.welded(std::move(triangles));
    if (const auto bad = detector::check_triangles(triangles, first.rows()))
      return problem_in({},
                        fmt::format("--weld: {} if corners at the same place in every frame become "
                                    "one vertex: remove such faces",
                                    bad->message));
  } else {
    corners.add(first);
    if (second.rows() > 0) corners.add(second);
  }
  if (auto line = corners.remark(bodies.weld); !line.empty())
    text.remarks.push_back(std::move(line));
  return std::make_unique<StepsOfFiles>(std::move(text), std::move(reader), std::move(triangles),
                                        std::move(counted), std::move(first), std::move(second));
}

InputKind kind_of_file(const std::filesystem::path& file) {
  constexpr std::size_t bytes_that_tell = 4096;
  const auto read = read_start(file, bytes_that_tell);
  const std::string start = read ? read.value() : "";
  if (start.starts_with(mark_of_log)) return InputKind::log;
  const auto end = (file.extension() == ".gz" ? file.stem() : file).extension();
  Lines lines(start, '#', false);
  const auto row = lines.next().value_or("");
  const bool is_case = row.starts_with('{') && start.find("\"assay-case/") != std::string::npos;
  if (is_case || end == ".json") return InputKind::case_file;
  const auto comma = row.find(',');
  if (comma != std::string_view::npos) {
    const auto word = row.substr(comma + 1, row.find(',', comma + 1) - comma - 1);
    if (word == "answer" || from_name<detector::Answer>(word)) return InputKind::answers;
  }
  // Numbers with blanks between them may be OFF without its first line, or a cloud of points, too.
  const bool is_shape = comma == std::string_view::npos && (end == ".off" || end == ".xyz");
  const bool has_numbers =
      !row.empty() && row.find_first_not_of("0123456789+-.eE, \t") == std::string_view::npos;
  const bool is_query = end == ".csv" || (has_numbers && !is_shape);
  return is_query ? InputKind::queries : InputKind::frames;
}

Expected<std::unique_ptr<StepSource>> read_steps(const std::vector<std::filesystem::path>& files) {
  const auto kind = kind_of_file(files[0]);
  if (kind == InputKind::log) return problem_in(files[0], "a log: in a shell, use assay check");
  if (files.size() > 1 || kind != InputKind::case_file) return steps_of_files(files);
  BOOST_OUTCOME_TRY(c, read_case(files[0]));
  return steps_of_case(std::make_shared<const Case>(std::move(c)), true);
}

}  // namespace assay::corpus
