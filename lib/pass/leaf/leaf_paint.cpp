#include "lib/pass/leaf/leaf_paint.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/image/image_cache.h"
#include "lib/pass/bake/textured_triangle.h"

namespace bp {

LeafImages::LeafImages(const SceneLeaf& leaf, const TextureSet* images, const MemoryShare& memory) : images_(images) {
  std::map<std::uint32_t, bool> wanted;  // whether they are colours
  for (const LeafPart& part : leaf.parts) {
    const TextureMaterial* const m = material(part.material);
    if (m == nullptr) continue;
    for (const std::uint32_t image : m->images()) {
      if (image != kNoTextureImage) wanted[image] = wanted[image] || image == m->image;
    }
  }
  std::uint64_t kept = 0;
  for (const auto& [image, is_color] : wanted) {
    try {
      MipImage decoded(images_->image(image, (memory.bytes - kept) / 4 * 3));
      decoded.keep_up_to(kSide);
      if (is_color) kept += small_.emplace(image, std::move(decoded)).first->second.bytes();
    } catch (const NeedsMemory& e) {
      throw Error(e.code(), e.what(), e.remedies(), memory.limit_for(kept + e.needed_bytes() / 3 * 4 + 8));
    } catch (const Error& e) {
      if (e.code() != ErrorCode::bad_input) throw;
      broken_[image] = e.what();
    }
    if (kept > memory.bytes)
      throw NeedsMemory("small copies of the scene's images", kept, memory.bytes, memory.limit_for(kept));
  }
}

std::uint64_t LeafImages::bytes_needed(const TextureSet& images) {
  constexpr std::uint64_t kMostTexels = std::uint64_t(kSide) * kSide;
  std::uint64_t kept = 0;
  for (std::uint32_t i = 0; i < images.image_count(); ++i) {
    const std::array<int, 2> size = images.size(i);
    const std::uint64_t texels = std::min(std::uint64_t(size[0]) * std::uint64_t(size[1]), kMostTexels);
    kept += texels * sizeof(TextureImage::Texel) / 3 * 4 + 8;  // with its smaller copies
  }
  return kept + ImageCache::bytes_needed(images);
}

const TextureMaterial* LeafImages::material(std::uint32_t i) const {
  return images_ == nullptr || i == TriangleTexture::kNoMaterial ? nullptr : &images_->material(i);
}

const MipImage* LeafImages::small(std::uint32_t image) const {
  const auto found = small_.find(image);
  return found == small_.end() ? nullptr : &found->second;
}

namespace {

class LeafPaint {
 public:
  LeafPaint(const SceneLeaf& leaf, const LeafImages& images) : leaf_(leaf), images_(images) {
    std::uint32_t count = 0;
    for (const LeafPart& part : leaf.parts) ends_.push_back(count += std::uint32_t(part.triangles.size()));
  }

  SurfaceViews::Color operator()(std::uint32_t triangle, const std::array<double, 3>& shares, double side) const {
    const auto number = std::size_t(std::upper_bound(ends_.begin(), ends_.end(), triangle) - ends_.begin());
    const LeafPart& part = leaf_.parts[number];
    const auto& corners = part.triangles[triangle - (number > 0 ? ends_[number - 1] : 0)];
    TriangleD t{};
    TriangleTexture texture;
    std::array<double, 3> color{};
    std::array<double, 2> uv{};
    for (std::size_t k = 0; k < 3; ++k) {
      const LeafVertex& v = part.vertices[corners[k]];
      for (std::size_t i = 0; i < 3; ++i) t[k][i] = leaf_.unit * v.at[i];
      texture.uv[k] = v.uv;
      for (std::size_t i = 0; i < 2; ++i) uv[i] += shares[k] * double(v.uv[i]);
      const std::array<std::uint16_t, 3> rgb{v.color.r, v.color.g, v.color.b};
      for (std::size_t i = 0; i < 3; ++i) color[i] += shares[k] * rgb[i] / 65535;
    }
    const TextureMaterial* const material = images_.material(part.material);
    if (const MipImage* const image = material != nullptr ? images_.small(material->image) : nullptr) {
      const double texels = side * texels_per_unit(t, texture, {image->width(), image->height()});
      const LinearTexel texel = image->at(uv[0], uv[1], texels, material->wrap);
      for (std::size_t i = 0; i < 3; ++i)
        color[i] = material->replaces_color ? double(texel[i]) : color[i] * double(texel[i]);
    }
    return {byte_of_linear(float(color[0])), byte_of_linear(float(color[1])), byte_of_linear(float(color[2]))};
  }

 private:
  const SceneLeaf& leaf_;
  const LeafImages& images_;
  std::vector<std::uint32_t> ends_;  // of the parts' triangles
};

}  // namespace

SurfaceViews::ColorAt paint_of(const SceneLeaf& leaf, const LeafImages& images) {
  return LeafPaint(leaf, images);
}

}  // namespace bp
