#pragma once
#include "lib/core/error.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

namespace bp::test {

/// A store for a scene that is in memory already: it stores nothing.
class NoStore final : public Scratch {
 public:
  Handle put(std::span<const std::byte>) override { fail(ErrorCode::failed, "triangles left memory"); }
  void get(Handle, std::vector<std::byte>&) const override {}
  void drop(Handle) override {}
  [[nodiscard]] std::uint64_t memory_bytes() const override { return 0; }
  [[nodiscard]] std::uint64_t scratch_bytes() const override { return 0; }
};

struct Voxelized {
  StreamHeader header;
  std::unique_ptr<BrickShelf> shelf = std::make_unique<MemoryShelf>();
};

/// Voxelizes `scene` as bpvox would. cell_vox: see VoxelizeOptions.
inline Voxelized voxelized(const Triangles& scene, double voxel, std::int32_t cell_vox = 0) {
  Voxelized out;
  ShelfSink sink(out.shelf.get());
  MemorySource source(scene);
  VoxelizeOptions options;
  options.voxel_size = [&](const Bounds3d&) { return voxel; };
  options.cell_vox = cell_vox;
  options.context.make_shelf = memory_shelves();
  options.context.memory.bytes = UINT64_MAX / 8;
  options.context.make_scratch = [] { return std::make_unique<NoStore>(); };
  const auto open = [&](const StreamHeader& h, const VoxelizeCounts&) -> BrickSink& {
    out.header = h;
    return sink;
  };
  voxelize_stream(source, open, options);
  return out;
}

}  // namespace bp::test
