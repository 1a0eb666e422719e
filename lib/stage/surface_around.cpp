#include "lib/stage/surface_around.h"

#include "lib/core/error.h"
#include "lib/meshing/repair.h"
#include "lib/meshing/surface.h"
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

LatticeMesh surface_around(const LatticeMesh& inner, double voxel, const ShelfFactory& make_shelf) {
  MeshSource source(inner);
  const auto shelf = make_shelf();
  ShelfSink sink(*shelf);
  VoxelizeOptions options;
  options.voxel_size = [voxel](const Bounds3d&) { return voxel; };
  options.up = inner.frame.up;
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
  repair_contacts(*shelf);
  LatticeMesh surface = dense_surface(*shelf, frame);
  surface.provenance = inner.provenance;
  return surface;
}

}  // namespace bp
