#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/half_edge_mesh.h"

/// Waves: edits of a mesh that are all planned at the same time on the mesh as it is, and then made one after the other
/// as planned. Neither the choice nor the result depends on the number of threads.
/// Why a plan holds after the edits made before it in its wave: an edit reads and changes the stars of its vertices,
/// and moves no other vertex. Claims (below) leave two edits of a wave no vertex in common: neither a vertex of their
/// stars nor one of the faces next to these across their rims is moved by the other, for such a face has two vertices
/// on the rim. So the shape of the star, its links, the space that it sweeps and the contact points nearest to its
/// faces are as they were planned. The guard has compared the new faces with all other faces of the mesh as it was.
/// Faces made since then are new faces of earlier edits, and no box of a new face may meet one of theirs (WaveBoxes).
/// So new faces of different edits have no point in common.
namespace bp {

/// Returns whether several threads may plan edits of the mesh at the same time. Parts of a mesh have a thread each, and
/// limits count what they have allowed.
[[nodiscard]] inline bool has_planners(const HalfEdgeMesh& mesh, bool any_limits) {
  return !any_limits && mesh.cell().holds(kEverywhere);
}

/// Returns whether edits of the mesh are made in waves. Small meshes are edited one by one.
[[nodiscard]] inline bool has_waves(const HalfEdgeMesh& mesh, bool any_limits) {
  constexpr std::uint64_t kFewFaces = 512;
  return mesh.face_count() >= kFewFaces && has_planners(mesh, any_limits);
}

/// The vertices that the edits of a wave have claimed.
class WaveClaims {
 public:
  explicit WaveClaims(const HalfEdgeMesh& mesh) : mesh_(mesh), wave_of_(mesh.vertex_capacity(), 0) {}
  void begin() { ++wave_; }  ///< begins a new wave
  /// Returns whether all vertices of the star are free. claim() claims the vertices of the last question.
  [[nodiscard]] bool star_is_free(VertexId v);
  [[nodiscard]] bool stars_are_free(HalfEdgeId h);  ///< stars of both ends
  [[nodiscard]] bool faces_are_free(HalfEdgeId h);  ///< the two faces at the edge
  void claim() {
    for (const VertexId v : vertices_) wave_of_[v] = wave_;
  }

 private:
  void gather(VertexId v);
  [[nodiscard]] bool is_free(VertexId v) const { return wave_of_[v] != wave_; }
  [[nodiscard]] bool are_free() const;

  const HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> wave_of_;  // per vertex: the wave that claimed it
  std::uint32_t wave_ = 0;
  std::vector<VertexId> vertices_;
};

/// Boxes around the new faces of an edit.
struct EditBoxes {
  LatticeBox all;                 ///< around all of them
  std::vector<LatticeBox> faces;  ///< one or more boxes, each around one face or several
  void clear() { faces.clear(); }
  void add(const LatticeBox& face);
  [[nodiscard]] bool meet(const EditBoxes& others) const;
};

/// Boxes of the edits of a wave that have been made.
class WaveBoxes {
 public:
  void begin() { count_ = 0; }  ///< begins a new wave
  /// Adds boxes; returns false, and adds nothing, if they meet boxes that are there. Cost: linear in the edits.
  [[nodiscard]] bool add(const EditBoxes& boxes);

 private:
  std::vector<EditBoxes> boxes_;  // only the first count_ are in use
  std::size_t count_ = 0;
};

/// Workers that plan or make edits, each with its own buffers; as many as there are threads.
template <class Worker>
class WaveWorkers {
 public:
  /// `make()` makes a worker. It is called when a worker is needed: once for a single item.
  explicit WaveWorkers(std::function<std::unique_ptr<Worker>()> make) : make_(std::move(make)) {}

  [[nodiscard]] Worker& first() {
    need(1);
    return *workers_.front();
  }
  /// Calls act(worker) for each worker made so far, one after the other.
  template <class Act>
  void visit(const Act& act) {
    for (const auto& worker : workers_) act(*worker);
  }

  /// Calls body(worker, i) for i in [0, n), in any order; the result must not depend on the worker. `grain`: number of
  /// items that are worth another thread.
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
