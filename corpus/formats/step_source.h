// The steps of one mesh, one after another, from any input: a case that is in memory as a whole, or
// files, with two frames in memory at a time. Every input of steps is a StepSource.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/problem.h"

namespace assay::corpus {

// The places of the vertices at the start and the end of a step, and the facts that the input
// states.
struct SourceStep {
  const detector::Positions& x_t0;
  const detector::Positions& x_t1;
  std::optional<detector::ViewPrimitive> view = {};
  bool commit = true;
};

// A description of an input in words.
struct InputText {
  std::string title = {};                 // "one mesh moving from a.obj to b.obj"; may be empty
  std::vector<std::string> files = {};    // in the order of reading; empty: in the order given
  std::vector<std::string> remarks = {};  // one line for each change and each ignored part
};

class StepSource {
 public:
  virtual ~StepSource() = default;

  virtual std::size_t count() const = 0;
  // Returns whether there is a step s, later than all steps that were asked for. An input that
  // still grows may wait for the step.
  virtual Expected<bool> has(std::size_t s) { return s < count(); }
  // Returns the number of step s in the whole that the input is a part of, from 0.
  virtual std::uint64_t number_of(std::size_t s) const { return s; }
  virtual InputText text() const { return {}; }
  // Return lines of text: the notes before the last step that was asked for; and, after all steps,
  // the lost parts of the input and other remarks.
  virtual std::vector<std::string> notes() const { return {}; }
  virtual std::vector<std::string> lost() const { return {}; }
  virtual std::vector<std::string> last_remarks() const { return {}; }
  // Returns the number of frames, in memory or not.
  virtual std::size_t frames() const = 0;
  // Returns whether there is a single frame, whose one step ends where it starts.
  bool is_at_rest() const { return frames() == 1 && count() == 1; }
  virtual const detector::Triangles& triangles() const = 0;
  // Returns the frame that a detector is made from. REQUIRES that no step after the first was asked
  // for.
  virtual const detector::Positions& first_frame() const = 0;

  // Returns step s < count(). The frames of the step may be freed when the next step is asked for.
  // Problems: those of a file whose frame is read now. REQUIRES that steps are asked for in order,
  // and none after a problem.
  virtual Expected<SourceStep> step(std::size_t s) = 0;

  // Returns which pairs count; null: all of them. The same for all steps.
  virtual const detector::CountedPairs* counted() const { return nullptr; }

  // Returns the case, if it is in memory as a whole; else null.
  virtual std::shared_ptr<const Case> whole() const { return nullptr; }
  // Returns the same case if it states options and facts; null if it is only triangles and frames.
  virtual const Case* case_file() const { return nullptr; }

  // Reads the remaining frames, and returns the steps as those of a case in memory. REQUIRES that
  // no step was asked for. This object must not be used afterwards.
  virtual Expected<std::unique_ptr<StepSource>> read_whole() = 0;
};

// Returns a problem of these steps' triangles as a Problem. If two faces have the same three
// vertices, it names their places in their file; for other problems it names `file`.
Problem problem_of_triangles(const StepSource& steps, const std::filesystem::path& file,
                             const detector::Problem& problem);

// Makes the steps of a case. `is_case_file` says whether case_file() returns the case or null.
std::unique_ptr<StepSource> steps_of_case(std::shared_ptr<const Case> c, bool is_case_file,
                                          InputText text = {});

// Makes steps of files. Each file is a frame, and is read once: the first two now, the others when
// their step is asked for. One file alone is a mesh at rest. Files that are missing or of no known
// format are refused now. REQUIRES a file.
Expected<std::unique_ptr<StepSource>> steps_of_files(std::vector<std::filesystem::path> files);

// Several meshes as bodies of one: their vertices and triangles follow each other. A body has a
// file for each frame, or one file: then it stands still.
struct BodyFiles {
  std::vector<std::vector<std::filesystem::path>> frames;  // by body
  // Which pairs count (detector/mesh/counted_pairs.h): bodies that do not meet, and the pairs that
  // rings of edges and the distance in the first frame leave out.
  std::vector<std::array<std::int32_t, 2>> apart = {};
  std::int32_t rings = 0;
  double rest_distance = 0;
  // Vertices of a body that stand at one place in every frame count as one. All files are then read
  // twice. The vertices keep their numbers.
  bool weld = false;
};
// Does the same for bodies, with the files of each body in the order of their numbers. The relation
// of the steps has the bodies. REQUIRES a body, and a file of each.
Expected<std::unique_ptr<StepSource>> steps_of_bodies(const BodyFiles& bodies);

// The purpose of a file. Its first bytes decide, or its name if they do not decide or cannot be
// read. If the name does not decide either, the purpose is `frames`: the reader of frames then says
// what it found.
enum class InputKind { frames, case_file, log, queries, answers };
InputKind kind_of_file(const std::filesystem::path& file);

// Reads the steps of these files: of one case file, or of frames of one mesh. REQUIRES a file.
Expected<std::unique_ptr<StepSource>> read_steps(const std::vector<std::filesystem::path>& files);

}  // namespace assay::corpus
