#include "lib/stage/surface_around.h"

#include "lib/core/error.h"
#include "lib/meshing/repair.h"
#include "lib/meshing/surface.h"
#include "lib/stage/complement.h"
#include "lib/stage/voxelize_stage.h"

namespace bp {

namespace {

class MeshSource final : public TriangleSource {
 public:
  explicit MeshSource(const LatticeMesh& mesh) : triangles_(world_triangles(mesh)) {}
  bool read(std::vector<TriangleD>& out) override {
    out.clear();
    if (counts_.triangles > 0) return false;
    out = triangles_;
    counts_.triangles = out.size();
    return true;
  }
  void rewind() override { counts_ = {}; }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return "level"; }

 private:
  std::vector<TriangleD> triangles_;
  SceneCounts counts_;
};

class ShelfSink final : public BrickSink {
 public:
  explicit ShelfSink(BrickShelf& shelf) : shelf_(shelf) {}
  void write(const Brick& brick) override { shelf_.put(brick.coord, brick.fill, brick.bits); }
  void finish() override {}

 private:
  BrickShelf& shelf_;
};

/// A mesh that is in memory already needs no place to wait.
class NoStore final : public ChunkStore {
 public:
  Handle put(std::span<const std::byte>) override { fail(ErrorCode::failed, "a level's triangles left memory"); }
  void get(Handle, std::vector<std::byte>& out) const override { out.clear(); }
  void drop(Handle) override {}
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 0; }
  [[nodiscard]] std::uint64_t memory_bytes() const override { return 0; }
};

}  // namespace

std::vector<TriangleD> world_triangles(const LatticeMesh& mesh) {
  std::vector<TriangleD> out;
  out.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    out.push_back({mesh.frame.world(mesh.vertices[t[0]]), mesh.frame.world(mesh.vertices[t[1]]),
                   mesh.frame.world(mesh.vertices[t[2]])});
  }
  return out;
}

namespace {

/// Voxels of a mesh, as bpvox would find them; returns their frame.
GridFrame voxelize_mesh(const LatticeMesh& mesh, double voxel, FillMode fill, const ShelfFactory& make_shelf,
                        BrickShelf& shelf) {
  MeshSource source(mesh);
  ShelfSink sink(shelf);
  VoxelizeOptions options;
  options.voxel_size = [voxel](const Bounds3d&) { return voxel; };
  options.fill = fill;
  options.up = mesh.frame.up;
  options.memory_bytes = UINT64_MAX / 8;
  options.make_shelf = make_shelf;
  options.make_store = [] { return std::make_unique<NoStore>(); };
  GridFrame frame;
  const auto open = [&](const StreamHeader& header, const VoxelizeCounts&) -> BrickSink& {
    frame = header.frame;
    return sink;
  };
  Backends on_threads;
  voxelize_stream(source, open, on_threads, options);
  return frame;
}

}  // namespace

LatticeMesh surface_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf) {
  const auto shelf = make_shelf();
  const GridFrame frame = voxelize_mesh(inner, voxel, FillMode::flood, make_shelf, *shelf);
  repair_contacts(*shelf);
  LatticeMesh surface = dense_surface(*shelf, frame);
  surface.provenance = inner.provenance;
  return surface;
}

LatticeMesh surface_within(const LatticeMesh& outer, double voxel, const ShelfFactory& make_shelf) {
  const auto shelf = make_shelf(), around = make_shelf();
  const GridFrame frame = voxelize_mesh(outer, voxel, FillMode::inside, make_shelf, *shelf);
  LatticeMesh surface = inward_surface(*shelf, frame, make_shelf, *around);
  if (surface.triangles.empty())
    fail(ErrorCode::failed, "no voxel lies inside a level of {} faces; use smaller voxels", outer.triangles.size());
  surface.provenance = outer.provenance;
  return surface;
}

LatticeMesh inward_surface(const BrickShelf& solid, const GridFrame& frame, const ShelfFactory& make_shelf,
                           BrickShelf& around) {
  const BrickBox box = bricks_around(solid);
  complement(solid, box, around);
  repair_contacts(around);
  const auto left = make_shelf();
  complement(around, box, *left);
  LatticeMesh surface = dense_surface(*left, frame);
  turn_over(surface);
  return surface;
}

void turn_over(LatticeMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace bp
