#include "tools/lod/leaves.h"

#include <algorithm>
#include <mutex>
#include <set>

#include "io/mesh/leaf_writer.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/bake/textured_triangle.h"
#include "lib/pass/leaf/scene_leaf.h"
#include "lib/store/packing.h"
#include "lib/store/result_key.h"
#include "tools/lod/tiles/image_files.h"
#include "tools/run/provenance.h"

namespace bp {

namespace {

/// A leaf as the store keeps it.
struct KeptLeaf {
  Bounds3d bounds;
  std::uint64_t triangles = 0;
  std::string content;
};

std::string packed(const KeptLeaf& leaf) {
  std::string bytes;
  pack(bytes, leaf.bounds);
  pack(bytes, leaf.triangles);
  return bytes + leaf.content;
}

bool unpack_leaf(std::string_view bytes, KeptLeaf& leaf) {
  if (!unpack(bytes, leaf.bounds) || !unpack(bytes, leaf.triangles)) return false;
  leaf.content = bytes;
  return true;
}

/// The part of the memory for work that leaves have beside the looks.
constexpr double kLeavesShare = 0.7;

class LeafMaker {
 public:
  LeafMaker(const Build& build, const LeafTask& task)
      : build_(build),
        task_(task),
        looks_(task.looks),
        cells_{build.options.tile_vox},
        unit_(leaf_unit(task.frame.voxel, build.options.tile_vox)),
        names_(looks_.images()) {
    OptionText text;
    text.add("leaves", "scene").add("tile", build.options.tile_vox);
    if (build.options.compression() == Compression::none) text.add("compression", "none");
    provenance_ = {make_provenance("bplod", text)};
  }

  [[nodiscard]] std::uint64_t limit() {
    find();
    return memory().limit_for(bytes_of_largest());
  }

  MadeLeaves run() {
    find();
    std::size_t next = 0;
    run_jobs<std::size_t>(
        at_once(),
        [&](std::size_t& i) {
          i = next++;
          return i < leaves_.size();
        },
        [&](const std::size_t& i) { make(leaves_[i]); });
    return collected();
  }

 private:
  struct Leaf {
    CellCoord cell{};
    LeafBox box;
    std::string name;
    Bounds3d bounds;
    std::uint64_t triangles = 0, bytes = 0;
    bool kept = false;
    Scratch::Handle content = 0;
  };

  void find() {
    std::vector<std::vector<LeafBox>> boxes(task_.cells.size());
    parallel_for(std::int64_t(boxes.size()), [&](std::int64_t i) {
      boxes[std::size_t(i)] = leaf_boxes(looks_, cell_bounds(cells_, task_.frame, task_.cells[std::size_t(i)]));
    });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const CellCoord c = task_.cells[i];
      for (LeafBox& box : boxes[i]) {
        const std::string dash = box.path.empty() ? "" : "-" + box.path;
        std::string name = fmt::format("{}_{}_{}{}", c.x, c.y, c.z, dash);
        leaves_.push_back({c, std::move(box), std::move(name), {}});
      }
    }
  }

  /// Returns how many leaves are made at the same time. Even the largest leaves fit into the memory together. Throws
  /// NeedsMemory if one of them does not fit.
  [[nodiscard]] int at_once() const {
    const std::uint64_t needed = bytes_of_largest(), left = memory().bytes;
    if (needed > left)
      throw NeedsMemory(fmt::format("cutting a leaf of {} triangles", needed / kLeafBytesPerTriangle), needed, left,
                        memory().limit_for(needed));
    return int(std::min(left / needed, std::uint64_t(thread_count())));
  }

  /// While leaves are made, the looks, the voxels and the files that wait are all that is in memory.
  [[nodiscard]] MemoryShare memory() const { return build_.context(nullptr, kLeavesShare).memory; }
  [[nodiscard]] std::uint64_t bytes_of_largest() const {
    std::uint64_t triangles = 1;
    for (const Leaf& leaf : leaves_) triangles = std::max(triangles, leaf.box.triangles);
    return triangles * kLeafBytesPerTriangle;
  }

  [[nodiscard]] ResultKey key_of(const Leaf& leaf) const {
    KeyHash hash("leaf");
    hash.add(build_.options.name, leaf.name, unit_, build_.options.appearance, task_.frame.up,
             provenance_.front().options);
    add_leaf_to(hash, looks_, leaf.box.box);
    return hash.key();
  }

  void make(Leaf& leaf) {
    KeptLeaf made;
    ResultKey key;
    std::string bytes;
    if (task_.results != nullptr) {
      key = key_of(leaf);
      leaf.kept = task_.results->get(key, bytes) && unpack_leaf(bytes, made);
    }
    if (!leaf.kept) {
      made = cut(leaf);
      if (task_.results != nullptr) task_.results->put(key, packed(made));
    }
    leaf.bounds = made.bounds;
    leaf.triangles = made.triangles;
    leaf.bytes = made.content.size();
    if (leaf.triangles > 0) leaf.content = task_.files->put(std::as_bytes(std::span(made.content)));
    note_images(leaf);
  }

  /// Collects the images of all triangles near the leaf. A superset is harmless: it only copies an unused file.
  void note_images(const Leaf& leaf) {
    if (looks_.images() == nullptr) return;
    std::set<std::uint32_t> materials;
    looks_.visit(leaf.box.box, [&](const TexturedTriangle& t) {
      if (t.texture.material != TriangleTexture::kNoMaterial) materials.insert(t.texture.material);
    });
    for (const std::uint32_t material : materials) {
      for (const std::uint32_t image : looks_.images()->material(material).images()) {
        const std::string name = image == TextureMaterial::kNoImage ? "" : names_.name_of(image);
        const std::lock_guard lock(mutex_);
        if (!name.empty()) used_.insert(name);
      }
    }
  }

  KeptLeaf cut(const Leaf& leaf) {
    const SceneLeaf cut = cut_leaf(looks_, leaf.box.box, unit_);
    KeptLeaf made{cut.bounds, cut.triangles(), ""};
    if (made.triangles == 0) return made;
    const LeafLooks looks{looks_.images(), [this](std::uint32_t image) { return names_.name_of(image); },
                          build_.options.colors(), build_.options.compression()};
    made.content = leaf_glb(build_.options.name + "_" + leaf.name, cut, looks, task_.frame.up, provenance_);
    return made;
  }

  MadeLeaves collected() {
    MadeLeaves made;
    for (Leaf& leaf : leaves_) {
      made.kept += leaf.kept;
      if (leaf.triangles == 0) continue;
      made.triangles += leaf.triangles;
      made.bytes += leaf.bytes;
      const std::string file = leaf_folder(build_.options) + "/" + leaf.name + ".glb";
      made.files.push_back({file, leaf.content});
      const Bounds3d& box = leaf.box.box;
      made.places.push_back({leaf.cell, {{file, middle_of(box), leaf.bounds, leaf_error(unit_)}, box, leaf.box.path}});
    }
    for (const std::string& name : used_) made.images.emplace(name, names_.image_of(name));
    return made;
  }

  const Build& build_;
  const LeafTask& task_;
  const SceneLooks& looks_;
  const Cells cells_;
  const double unit_;
  ImageFiles names_;
  std::vector<Provenance> provenance_;
  std::vector<Leaf> leaves_;
  std::mutex mutex_;
  std::set<std::string> used_;
};

}  // namespace

std::string leaf_folder(const BuildOptions& options) {
  return options.name + "_leaves";
}

std::uint64_t leaves_limit(const Build& build, const LeafTask& task) {
  return LeafMaker(build, task).limit();
}

MadeLeaves make_leaves(const Build& build, const LeafTask& task) {
  return LeafMaker(build, task).run();
}

}  // namespace bp
