#pragma once
#include <memory>

#include "lib/pass/color/scene_colors.h"
#include "tests/support/memory_store.h"
#include "tests/support/voxelized.h"

namespace bp::test {

inline constexpr LinearColor kRed{65535, 0, 0}, kBlue{0, 0, 65535};

class ColoredSource final : public TriangleSource {
 public:
  ColoredSource(Triangles triangles, std::vector<TriangleColors> colors)
      : plain_(std::move(triangles)), colors_(std::move(colors)) {}
  bool read(std::vector<TriangleD>& out) override { return plain_.read(out); }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    const auto first = std::ptrdiff_t(plain_.counts().triangles);
    const bool more = plain_.read(out);
    colors.assign(colors_.begin() + first, colors_.begin() + first + std::ptrdiff_t(out.size()));
    return more;
  }
  [[nodiscard]] bool has_colors() const override { return true; }
  void rewind() override { plain_.rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return plain_.counts(); }
  [[nodiscard]] std::string name() const override { return "memory"; }

 private:
  MemorySource plain_;
  std::vector<TriangleColors> colors_;
};

struct ColoredScene {
  Triangles triangles;
  std::vector<TriangleColors> colors;
  void paint(LinearColor c) { colors.resize(triangles.size(), {c, c, c}); }
};

inline std::unique_ptr<SceneColors> gathered(const ColoredScene& scene, const Voxelized& voxels, std::uint64_t memory,
                                             std::uint64_t* put = nullptr) {
  static std::uint64_t ignored = 0, held = 0;
  ColoredSource source(scene.triangles, scene.colors);
  PassContext options;
  options.memory.bytes = memory;
  options.make_shelf = memory_shelves();
  options.make_scratch = [put] { return std::make_unique<MemoryStore>(put != nullptr ? *put : ignored, held); };
  return gather_colors(source, voxels.header.frame, *voxels.shelf, options);
}

}  // namespace bp::test
