// Reads the frames of a deforming mesh, one file for each frame, or the frames of several bodies as
// one mesh. Puts the files in order, finds vertices that are at the same place in every frame, and
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
// A shell sorts names letter by letter; in some languages it ignores marks such as _. If a shell
// may have sorted the files, they are put in the order of their numbers. Any other order is the
// user's own and stays unchanged. Files whose names differ in more than numbers are not compared.
// In names, 0.25 and 0.5 may be decimals, or two numbers each: if the two readings give different
// orders, the order stays unchanged, too.

struct FrameOrder {
  std::vector<std::filesystem::path> files;
  // One line if the files were put in another order, one if they are not in the order of their
  // numbers, and one if numbers are missing or repeated.
  std::vector<std::string> remarks;
};

FrameOrder in_order_of_numbers(const std::vector<std::filesystem::path>& files);

// Returns the names of two files for a message: without folders, unless both have the same name.
std::pair<std::string, std::string> short_names(const std::filesystem::path& a,
                                                const std::filesystem::path& b);

// A deforming mesh: a step goes from each frame to the next.
struct Sequence {
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  // Lines on the order of the files, and on content that was changed or ignored.
  std::vector<std::string> remarks = {};
};

// Reads one frame at each call of next(), each file once, and stores only the triangles. So the
// memory in use does not grow with the length of the sequence, if the caller does not store the
// frames.
class SequenceReader {
 public:
  explicit SequenceReader(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  // Returns the number of frames, read or not.
  std::size_t frames() const { return files_.size(); }
  bool at_end() const { return next_ == files_.size(); }

  // Reads the next frame. All files must hold the same triangles and the same number of vertices;
  // otherwise the problem names both files. After a problem, next() reads the same frame again.
  // REQUIRES !at_end().
  Expected<detector::Positions> next();

  // Looks at the remaining files by look_at_mesh, without reading them as a whole, and returns the
  // first problem.
  Expected<void> look_ahead() const;

  // Returns the triangles and the number of vertices of every frame. REQUIRES that a frame was
  // read.
  const detector::Triangles& triangles() const { return triangles_; }
  std::size_t vertices() const { return static_cast<std::size_t>(vertices_); }
  // Returns the remarks on the first frame.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  // Returns the problem that the next frame's mesh differs from the first frame's mesh.
  Problem other_mesh(std::string_view how) const;

  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
  detector::Triangles triangles_;
  Eigen::Index vertices_ = 0;
  std::vector<std::string> remarks_;
};

// Reads all frames, in the order of their numbers. Fails when `paths` is empty.
Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths);

// Reads the frames of several bodies one by one, and joins the bodies into one mesh.
//
// Vertices and triangles of the bodies follow each other in the order of the bodies. A body of one
// frame stands still.
class BodiesReader {
 public:
  // Takes the files of each body: one file for each frame. REQUIRES at least one body, and at least
  // one file for each body.
  explicit BodiesReader(std::vector<std::vector<std::filesystem::path>> bodies);

  // Returns a problem if two bodies of more than one frame each have different numbers of frames.
  // The problem names both numbers.
  Expected<void> fit() const;
  std::size_t frames() const;
  bool at_end() const { return read_ == frames(); }
  // Returns the next frame of all bodies, or a problem of SequenceReader::next(). REQUIRES fit()
  // and !at_end().
  Expected<detector::Positions> next();
  Expected<void> look_ahead() const;

  // Return the triangles, and the number of each vertex's body. Both REQUIRE that a frame was read.
  const detector::Triangles& triangles() const { return triangles_; }
  std::vector<std::int32_t> bodies() const;
  // Returns the remarks on the first file of each body. If there are several bodies, each remark
  // names its file.
  std::vector<std::string> remarks() const;

 private:
  void join_triangles();

  std::vector<std::filesystem::path> first_files_;  // by body
  std::vector<SequenceReader> readers_;
  std::vector<detector::Positions> now_;  // by body, in the frame that was read last
  std::size_t read_ = 0;
  detector::Triangles triangles_;
};

// Finds vertices that are at the same place in every frame. If a format or an exporter doubles the
// corners of neighbouring triangles (STL, seams of textures), these triangles share no vertex, so
// they are in contact with each other.
class DoubledCorners {
 public:
  // `body`: the number of each vertex's body; two vertices of different bodies are never taken as
  // one. Vertices of no triangle are ignored.
  DoubledCorners(const detector::Triangles& triangles, const std::vector<std::int32_t>& body);

  // Separates vertices that are at different places in this frame. Two places are equal if all
  // coordinates are equal (0 = -0).
  void add(const detector::Positions& x);

  // Returns a remark on the frames that were added; empty if no two vertices are at the same place
  // in all of these frames.
  std::string remark(bool is_welded) const;

  // Returns the triangles with each vertex replaced by the first vertex at its place.
  detector::Triangles welded(detector::Triangles triangles) const;

 private:
  std::vector<std::int32_t> first_;  // by vertex: the first vertex at its place; -1: in no triangle
};

// Writes meshes as binary little-endian PLY with double coordinates, so that a reader gets the same
// bits.
//
// Every file is written under another name and then renamed, so a reader sees the old file or the
// whole new one.

// Writes one mesh. Fails if the file system refuses (the problem states its reason), or if there is
// too little memory. `marked`: null, or for each triangle 0 for grey, 1 for red, 2 for amber.
Expected<void> write_mesh(const std::filesystem::path& path,
                          const detector::PositionsView& positions,
                          const detector::TrianglesView& triangles,
                          const std::vector<std::uint8_t>* marked = nullptr);

// Writes frame_0000.ply, frame_0001.ply, ... into `folder`, which is made if it is missing.
// Returns the paths, in frame order.
Expected<std::vector<std::filesystem::path>> write_sequence(const std::filesystem::path& folder,
                                                            const Sequence& sequence);

}  // namespace assay::corpus
