// Compares a line search by the IPC Toolkit, by Assay behind the toolkit's interfaces, and by a
// Detector: ipc_line_search FRAME FRAME...
//
// As in a solver, the mesh moves toward the next frame as far as it can without contact, and then
// from there toward the frame after that. The program asks twenty questions on the way to a frame:
// how far can the mesh go toward the frame, and toward the places at 0.9, 0.9^2, ... of the way.
// Five methods answer each question:
//
//   toolkit    LBVH's candidates, Tight-Inclusion
//   narrow     LBVH's candidates, AssayNarrowPhase
//   both       the candidates of AssayBroadPhase, AssayNarrowPhase
//   limit      Detector::limit with keeps_near; the way to its rounded end positions is free
//   first      Detector::first_contact with keeps_near; gives only the exact time
//
// The first three methods list candidates once for each frame, at the first question, as solvers
// do: a shorter step needs no other candidates. A Detector stores what it found before the first
// contact, so it needs less time for shorter steps that end before this contact. All methods work
// in one thread. A row of the output is one question: for each method, the share of the way that
// can be taken, and milliseconds.
#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <ipc/candidates/candidates.hpp>
#include <ipc/utils/logger.hpp>

#include "corpus/formats/mesh_reader.h"
#include "corpus/peers/ipc_adapter.h"
#include "detector/detector.h"

namespace assay::peers {
namespace {

using namespace detector;

constexpr const char* ways[] = {"toolkit", "narrow", "both", "limit", "first"};
constexpr int questions = 20;

Detector detector_of(const corpus::Mesh& mesh) {
  Options options;
  options.culling = Culling::bvh;
  options.keeps_near = true;
  return Detector::create(mesh.triangles, mesh.positions, options).value();
}

ipc::CollisionMesh collision_mesh(const corpus::Mesh& mesh) {
  const auto edges = make_topology(mesh.triangles, mesh.positions.rows()).edges;
  Eigen::MatrixXi rows(std::ssize(edges), 2);
  for (std::size_t e = 0; e < edges.size(); ++e)
    rows.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
  return ipc::CollisionMesh(mesh.positions, rows, mesh.triangles);
}

class Search {
 public:
  explicit Search(const corpus::Mesh& mesh)
      : mesh_(collision_mesh(mesh)),
        limiter_(detector_of(mesh)),
        timer_(detector_of(mesh)),
        x_(mesh.positions) {}

  // Asks all questions of the way to this frame, and goes as far as the way is free.
  void go_toward(const Positions& frame) {
    const Positions x = x_;
    const Eigen::MatrixXd start = x;
    ipc::Candidates of_toolkit, of_assay;
    double part = 1, total[std::size(ways)] = {};
    for (int question = 0; question < questions; ++question, part *= 0.9) {
      const Positions place = question == 0 ? frame : Positions(x + part * (frame - x));
      const Eigen::MatrixXd end = place;
      const auto size = [&](const ipc::Candidates& candidates, const ipc::NarrowPhaseCCD& narrow) {
        return candidates.compute_collision_free_stepsize(mesh_, start, end, 0, narrow);
      };
      const auto toolkit = [&] {
        if (question == 0) of_toolkit.build(mesh_, start, end, 0, &lbvh_);
        return size(of_toolkit, tight_inclusion_);
      };
      const auto narrow = [&] {
        if (question == 0) of_toolkit.build(mesh_, start, end, 0, &lbvh_);
        return size(of_toolkit, narrow_);
      };
      const auto both = [&] {
        if (question == 0) of_assay.build(mesh_, start, end, 0, &broad_);
        return size(of_assay, narrow_);
      };
      const auto limit = [&] {
        const StepLimit found = limiter_.limit(x, place);
        if (question == 0) x_ = found.positions;
        return found.share;
      };
      const auto first = [&] {
        const StepResult found = timer_.first_contact(x, place);
        return found.answer == Answer::free ? 1. : found.first.lo;
      };
      const std::function<double()> asked[] = {toolkit, narrow, both, limit, first};
      std::printf("%8.4f", part);
      for (std::size_t way = 0; way < std::size(ways); ++way) {
        const auto begin = std::chrono::steady_clock::now();
        const double share = asked[way]();
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - begin;
        total[way] += time.count();
        std::printf("  %9.7f %8.2f", share, time.count());
      }
      std::printf("\n");
    }
    std::printf("     all");
    for (const double time : total) std::printf("  %18.2f", time);
    std::printf("\ncandidates: %zu of LBVH, %zu of Assay\n", of_toolkit.size(), of_assay.size());
  }

 private:
  ipc::CollisionMesh mesh_;
  ipc::LBVH lbvh_;
  ipc::TightInclusionCCD tight_inclusion_;
  AssayBroadPhase broad_;
  AssayNarrowPhase narrow_;
  Detector limiter_, timer_;
  Positions x_;
};

}  // namespace
}  // namespace assay::peers

int main(int count, char** files) {
  using namespace assay;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  ipc::logger().set_level(spdlog::level::err);
  std::unique_ptr<peers::Search> search;
  for (int i = 1; i < count; ++i) {
    const auto mesh = corpus::read_mesh(files[i]);
    if (!mesh) return std::fprintf(stderr, "%s\n", mesh.error().message.c_str()), 2;
    if (!search) {
      search = std::make_unique<peers::Search>(mesh.value());
      continue;
    }
    std::printf("toward %s\n    part", files[i]);
    for (const char* way : peers::ways) std::printf("  %18s", way);
    std::printf("\n");
    search->go_toward(mesh.value().positions);
  }
}
