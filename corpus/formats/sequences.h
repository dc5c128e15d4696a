// Reads the frames of one mesh that deforms, one file a frame, or the frames of several bodies as
// one mesh. Puts the files in order, finds vertices that stand at one place in every frame, and
// writes meshes and sequences.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/formats/mesh_reader.h"
#include "corpus/problem.h"

namespace assay::corpus {

// Puts the files of frames in the order of the numbers in their names.
//
//   sim_1.obj sim_10.obj sim_2.obj  ->  sim_1.obj sim_2.obj sim_10.obj
//
// A shell lists names letter by letter; in some languages it ignores marks such as _. If the files
// came in such an order, they are taken in the order of their numbers. Any other order is the
// user's own and stays. Files whose names differ in more than numbers are not compared. In names,
// 0.25 and 0.5 may be decimals, or two numbers each: if that matters, the order stays, too.

struct FrameOrder {
  std::vector<std::filesystem::path> files;
  // One line each if the files were put in order, if they are not in the order of their numbers,
  // and if numbers are left out or repeated.
  std::vector<std::string> remarks;
};

FrameOrder in_order_of_numbers(const std::vector<std::filesystem::path>& files);

// Returns the names of two files for a message: without their folders if these names differ.
std::pair<std::string, std::string> short_names(const std::filesystem::path& a,
                                                const std::filesystem::path& b);

// One mesh that deforms: consecutive frames are the ends of a step.
struct Sequence {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  // One line each on the order of the files, and on content that was changed or is ignored.
  std::vector<std::string> remarks = {};
};

// Reads a frame when it is asked for, each file once, and keeps only the triangles. So a sequence
// of any length takes the memory of the frames that the caller keeps.
class SequenceReader {
 public:
  explicit SequenceReader(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  // Returns the number of frames, read or not.
  std::size_t frames() const { return files_.size(); }
  bool at_end() const { return next_ == files_.size(); }

  // Reads the next frame. All files must hold the same triangles and the same number of vertices;
  // otherwise the problem names both files. After a problem the reader stays where it is.
  // REQUIRES !at_end().
  Expected<detector::Positions> next();

  // Refuses the remaining frames by look_at_mesh alone, without reading them.
  Expected<void> look_ahead() const;

  // Returns the triangles and the number of vertices of every frame. REQUIRES that a frame was
  // read.
  const detector::Triangles& triangles() const { return triangles_; }
  std::size_t vertices() const { return static_cast<std::size_t>(vertices_); }
  // Returns the remarks on the first frame.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  // Returns the problem that the next frame's mesh is not that of the first frame.
  Problem other_mesh(std::string_view how) const;

  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
  detector::Triangles triangles_;
  Eigen::Index vertices_ = 0;
  std::vector<std::string> remarks_;
};

// Reads all frames, in the order of their numbers. Fails when `paths` is empty.
Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths);

// Reads frame after frame of several bodies, and makes one mesh of them.
//
// Vertices and triangles of the bodies follow each other in the order of the bodies. A body of one
// frame stands still.
class BodiesReader {
 public:
  // Takes the files of each body, one for each frame. REQUIRES a body, and a file of each.
  explicit BodiesReader(std::vector<std::vector<std::filesystem::path>> bodies);

  // Returns nothing if each body has as many frames as the others, or one; else a problem that
  // names both numbers of frames.
  Expected<void> fit() const;
  std::size_t frames() const;
  bool at_end() const { return read_ == frames(); }
  // Returns the next frame of all bodies. Problems: those of SequenceReader::next(). REQUIRES fit()
  // and !at_end().
  Expected<detector::Positions> next();
  Expected<void> look_ahead() const;

  // Return the triangles, and the number of each vertex's body. Both REQUIRE that a frame was read.
  const detector::Triangles& triangles() const { return triangles_; }
  std::vector<std::int32_t> bodies() const;
  // Returns the remarks on the first file of each body, with its name if there are several.
  std::vector<std::string> remarks() const;

 private:
  void join_triangles();

  std::vector<std::filesystem::path> first_files_;  // by body
  std::vector<SequenceReader> readers_;
  std::vector<detector::Positions> now_;  // by body, in the frame that was read last
  std::size_t read_ = 0;
  detector::Triangles triangles_;
};

// Finds vertices that stand at one place in every frame. If a format or an exporter doubles the
// corners of neighbouring triangles (STL, seams of textures), the triangles share no vertex, so
// they touch.
class DoubledCorners {
 public:
  // `body`: the number of each vertex's body; vertices of two bodies are never counted together.
  // Vertices of no triangle do not count.
  DoubledCorners(const detector::Triangles& triangles, const std::vector<std::int32_t>& body);

  // Separates vertices that stand apart in this frame. Two places are equal if all coordinates are
  // equal (0 = -0).
  void add(const detector::Positions& x);

  // Returns a remark on the frames that were added; empty if no two vertices stand together.
  std::string remark(bool is_welded) const;

  // Returns the triangles with each vertex replaced by the first vertex at its place.
  detector::Triangles welded(detector::Triangles triangles) const;

 private:
  std::vector<std::int32_t> first_;  // by vertex: the first vertex at its place; -1: in no triangle
};

// Writes meshes as binary little-endian PLY with double coordinates, which read back bit by bit.
//
// Every file is written beside its place and then renamed, so a reader sees the old file or the
// whole new one.

// Fails, with the reason, when the file system refuses, and when memory does not suffice. `marked`:
// null, or by triangle 0 for grey, 1 for red, 2 for amber.
Expected<void> write_mesh(const std::filesystem::path& path,
                          const detector::PositionsView& positions,
                          const detector::TrianglesView& triangles,
                          const std::vector<std::uint8_t>* marked = nullptr);

// Writes frame_0000.ply, frame_0001.ply, ... into `folder`, which is made if it is missing.
// Returns the paths, in frame order.
Expected<std::vector<std::filesystem::path>> write_sequence(const std::filesystem::path& folder,
                                                            const Sequence& sequence);

}  // namespace assay::corpus
