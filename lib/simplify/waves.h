#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/half_edge_mesh.h"

/// Waves: edits of a mesh that are all planned on the mesh as it is, at the same time, and then made one after the
/// other, each as planned. What is chosen, and what holds, does not depend on the number of threads.
///
/// Why a plan holds after the edits made before it in its wave: an edit reads and changes the stars of its vertices,
/// and changes no position but theirs. Claims (below) leave two edits of a wave no vertex in common: neither a vertex
/// of their stars nor one of the faces next to these across their rims is moved by the other, for such a face has two
/// vertices on the rim. So the shape of the star, its links, what it sweeps over and what lies nearest to its faces are
/// as they were planned. The guard has compared the new faces with all others of the mesh as it was; those made since
/// are new faces of edits made before, and no box of a new face may meet one of theirs (WaveBoxes). Then new faces of
/// different edits have no point in common.
namespace bp {

/// Smaller meshes, parts of a mesh, and edits under limits, which count what they have allowed, are edited one by one.
[[nodiscard]] inline bool has_waves(const HalfEdgeMesh& mesh, bool any_limits) {
  constexpr std::uint64_t kFewFaces = 512;
  return mesh.face_count() >= kFewFaces && !any_limits && mesh.cell().holds(kEverywhere);
}

/// The vertices that the edits of a wave take part in.
class WaveClaims {
 public:
  explicit WaveClaims(const HalfEdgeMesh& mesh) : mesh_(mesh), wave_of_(mesh.vertex_capacity(), 0) {}
  void begin() { ++wave_; }  ///< a new wave
  /// Whether all of the vertices are free: claim() claims those of the last question.
  [[nodiscard]] bool star_is_free(VertexId v);
  [[nodiscard]] bool stars_are_free(HalfEdgeId h);  ///< of both ends
  [[nodiscard]] bool faces_are_free(HalfEdgeId h);  ///< the two at the edge
  void claim() {
    for (const VertexId v : vertices_) wave_of_[v] = wave_;
  }

 private:
  void gather(VertexId v);
  [[nodiscard]] bool is_free(VertexId v) const { return wave_of_[v] != wave_; }
  [[nodiscard]] bool are_free() const;

  const HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> wave_of_;  // per vertex
  std::uint32_t wave_ = 0;
  std::vector<VertexId> vertices_;
};

/// Where the new faces of an edit lie.
struct EditBoxes {
  LatticeBox all;                 ///< around them
  std::vector<LatticeBox> faces;  ///< one or more, around each of them, or around several
  void clear() { faces.clear(); }
  void add(const LatticeBox& face);
  [[nodiscard]] bool meet(const EditBoxes& others) const;
};

/// Boxes of a wave's edits that have been made.
class WaveBoxes {
 public:
  void begin() { count_ = 0; }  ///< a new wave
  /// False if they meet any of those there; else they are there now. Cost: linear in the edits.
  [[nodiscard]] bool add(const EditBoxes& boxes);

 private:
  std::vector<EditBoxes> boxes_;  // the first of them
  std::size_t count_ = 0;
};

/// Workers of waves: things that plan or make edits, with scratch of their own; as many as there are threads.
template <class Worker>
class WaveWorkers {
 public:
  /// `make()`: a worker. Called when they are needed: one for a single item.
  explicit WaveWorkers(std::function<std::unique_ptr<Worker>()> make) : make_(std::move(make)) {}

  [[nodiscard]] Worker& first() {
    need(1);
    return *workers_.front();
  }
  /// act(worker) for each that was needed so far, one after the other.
  template <class Act>
  void visit(const Act& act) {
    for (const auto& worker : workers_) act(*worker);
  }

  /// body(worker, i) for i in [0, n), in any order; what it does must not depend on the worker. `grain`: so many items
  /// are worth another thread.
  template <class Body>
  void for_each(std::size_t n, std::size_t grain, const Body& body) {
    const std::size_t workers = std::min<std::size_t>(std::size_t(thread_count()), (n + grain - 1) / grain);
    need(std::max<std::size_t>(workers, 1));
    if (workers <= 1) {
      for (std::size_t i = 0; i < n; ++i) body(*workers_.front(), i);
      return;
    }
    std::atomic<std::size_t> next{0};
    parallel_for(std::int64_t(workers), [&](std::int64_t w) {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < n;) body(*workers_[std::size_t(w)], i);
    });
  }

 private:
  void need(std::size_t n) {
    while (workers_.size() < n) workers_.push_back(make_());
  }
  std::function<std::unique_ptr<Worker>()> make_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace bp
