// Gives the steps of one mesh, one after another, from any input: from a case, which is in memory
// as a whole, or from files, where two frames are in memory at a time. Every input of steps is a
// StepSource.
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
  std::string title = {};  // "one mesh moving from a.obj to b.obj"; may be empty
  // In the order of reading. If empty, reports name the files as the user passed them.
  std::vector<std::string> files = {};
  std::vector<std::string> remarks = {};  // one line for each change and each ignored part
};

class StepSource {
 public:
  virtual ~StepSource() = default;

  virtual std::size_t count() const = 0;
  // Returns whether there is a step s. An input that still grows may wait for the step. REQUIRES an
  // s later than all steps that were read.
  virtual Expected<bool> has(std::size_t s) { return s < count(); }
  // Returns the number of step s in the whole run, from 0; the input can be a part of the run.
  virtual std::uint64_t number_of(std::size_t s) const { return s; }
  virtual InputText text() const { return {}; }
  // Each of these functions returns lines of text. notes() returns the notes before the step that
  // was read last. After all steps, lost() returns the lost parts of the input, and last_remarks()
  // all other remarks.
  virtual std::vector<std::string> notes() const { return {}; }
  virtual std::vector<std::string> lost() const { return {}; }
  virtual std::vector<std::string> last_remarks() const { return {}; }
  // Returns the number of frames, in memory or not.
  virtual std::size_t frames() const = 0;
  // Returns whether there is a single frame, and so one step in which nothing moves.
  bool is_at_rest() const { return frames() == 1 && count() == 1; }
  virtual const detector::Triangles& triangles() const = 0;
  // Returns the frame from which a detector is created. REQUIRES that no step after the first was
  // read.
  virtual const detector::Positions& first_frame() const = 0;

  // Returns step s < count(), or a problem of a file that is read for this step. The next call of
  // step() may free the frames of this step. REQUIRES that steps are read in order, and that no
  // step is read after a problem.
  virtual Expected<SourceStep> step(std::size_t s) = 0;

  // Returns which pairs count in every step; null: all pairs.
  virtual const detector::CountedPairs* counted() const { return nullptr; }

  // Returns the case if the input is a case in memory; otherwise null.
  virtual std::shared_ptr<const Case> whole() const { return nullptr; }
  // Returns the same case if it comes from a case file, with options and facts; otherwise null.
  virtual const Case* case_file() const { return nullptr; }

  // Reads the remaining frames into a case in memory, and returns the steps of the case. REQUIRES
  // that no step was read. This object must not be used afterwards.
  virtual Expected<std::unique_ptr<StepSource>> read_whole() = 0;
};

// Turns a detector's problem with the triangles of `steps` into a Problem. If two faces have the
// same three vertices, the message names their file and their places in it; otherwise it names
// `file`.
Problem problem_of_triangles(const StepSource& steps, const std::filesystem::path& file,
                             const detector::Problem& problem);

// Makes a source of the steps of a case. `is_case_file` says whether case_file() returns the case
// or null.
std::unique_ptr<StepSource> steps_of_case(std::shared_ptr<const Case> c, bool is_case_file,
                                          InputText text = {});

// Makes a source of the steps between files. Each file is a frame and is read once: this function
// reads the first two files, and step() reads the other files. A single file is a mesh at rest.
// This function refuses files that are missing or have no known format. REQUIRES at least one file.
Expected<std::unique_ptr<StepSource>> steps_of_files(std::vector<std::filesystem::path> files);

// The files of several bodies that are joined into one mesh: vertices and triangles of the bodies
// follow each other. A body has one file for each frame; a body with a single file stands still.
struct BodyFiles {
  std::vector<std::vector<std::filesystem::path>> frames;  // by body
  // Which pairs count (detector/mesh/counted_pairs.h): `apart` lists bodies that do not meet. Pairs
  // joined by fewer than `rings` edges, or nearer than `rest_distance` in frame 0, do not count.
  std::vector<std::array<std::int32_t, 2>> apart = {};
  std::int32_t rings = 0;
  double rest_distance = 0;
  // If true, vertices of a body that are at the same place in every frame count as one vertex, and
  // all files are read twice. The vertices keep their numbers.
  bool weld = false;
};
// Makes a source of the steps of several bodies, like steps_of_files. Puts the files of each body
// in the order of their numbers. counted() of the source names the bodies. REQUIRES at least one
// body, and at least one file for each body.
Expected<std::unique_ptr<StepSource>> steps_of_bodies(const BodyFiles& bodies);

// The purpose of a file. The first bytes of the file tell it. If they do not tell it or cannot be
// read, the name of the file does. If the name does not tell it either, the purpose is `frames`:
// the reader of frames then reports what is wrong.
enum class InputKind { frames, case_file, log, queries, answers };
InputKind kind_of_file(const std::filesystem::path& file);

// Makes a source of the steps of one case file, or of files that are frames of one mesh. REQUIRES
// at least one file.
Expected<std::unique_ptr<StepSource>> read_steps(const std::vector<std::filesystem::path>& files);

}  // namespace assay::corpus
