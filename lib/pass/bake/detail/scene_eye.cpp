#include "lib/pass/bake/detail/scene_eye.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lib/core/vec3.h"
#include "lib/image/image_cache.h"

namespace bp {

namespace {

constexpr std::size_t kMostHeld = 8;

template <class Held, class Get>
auto held(Held& all, std::uint32_t number, const Get& get) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& h) { return h.first == number; });
  if (found != all.end()) {
    std::rotate(found, found + 1, all.end());
  } else {
    if (all.size() == kMostHeld) all.erase(all.begin());
    all.emplace_back(number, get(number));
  }
  return all.back().second;
}

/// Returns the bits of the places, since a place in an image may be no number.
std::array<std::array<std::uint32_t, 2>, 3> bits_of(const TriangleTexture& t) {
  return std::bit_cast<std::array<std::array<std::uint32_t, 2>, 3>>(t.uv);
}

constexpr Vec3d kUp = {0, 0, 1};  // for a vector without a direction

/// Returns the unit normal at a place, bent as its image of directions says. It stays if the triangle has no area in
/// the image.
Vec3d bent(const Vec3d& normal, const TriangleD& t, const TriangleTexture& texture, const LinearTexel& said,
           double scale) {
  const auto& [a, b, c] = texture.uv;
  const double u1 = double(b[0]) - a[0], v1 = double(b[1]) - a[1], u2 = double(c[0]) - a[0], v2 = double(c[1]) - a[1];
  const double area = u1 * v2 - u2 * v1;  // v goes down
  const Vec3d along = (v2 / area) * (t[1] - t[0]) - (v1 / area) * (t[2] - t[0]);
  const Vec3d flat = along - dot(along, normal) * normal;
  const double l = length(flat);
  if (!(l > 0) || !std::isfinite(l)) return normal;
  const Vec3d tangent = (1 / l) * flat;
  if (!(std::abs(dot(tangent, normal)) < 0.5)) return normal;
  const Vec3d up = (area < 0 ? 1.0 : -1.0) * cross(normal, tangent);
  const double x = scale * (2 * double(said[0]) - 1), y = scale * (2 * double(said[1]) - 1),
               z = 2 * double(said[2]) - 1;
  return unit(x * tangent + y * up + z * normal, kUp);
}

}  // namespace

SceneEye::Block SceneEye::block(std::uint32_t number) {
  return held(blocks_, number, [&](std::uint32_t i) { return looks_.blocks_->get(i); });
}

const MipImage* SceneEye::image(std::uint32_t number, MipImage::Kind kind) {
  if (number == TextureMaterial::kNoImage) return nullptr;
  return held(images_, 2 * number + std::uint32_t(kind),
              [&](std::uint32_t) { return looks_.cache_->get(number, kind); })
      .get();
}

/// Calls for blocks that are no farther away than `most`, the nearest first.
template <class Distance>
void SceneEye::find_candidates(const Bounds3d& box, double most, const Distance& distance) {
  candidates_.clear();
  looks_.blocks_->visit(box, [&](std::uint32_t block) {
    const double d = distance(looks_.blocks_->box(block));
    if (d <= most) candidates_.push_back({d, block});
  });
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.block) < std::tie(b.distance, b.block);
  });
}

bool SceneEye::before(const LookBlock& a, std::uint32_t item_a, const LookBlock& b, std::uint32_t item_b) const {
  const TriangleTexture &s = a.texture(item_a), &t = b.texture(item_b);
  if (const ResultKey k = looks_.key_of(s.material), l = looks_.key_of(t.material); k.words != l.words)
    return k.words < l.words;
  if (a.colors(item_a) != b.colors(item_b)) return a.colors(item_a) < b.colors(item_b);
  return std::tuple(bits_of(s), a.triangles().item(item_a).corners) <
         std::tuple(bits_of(t), b.triangles().item(item_b).corners);
}

std::optional<SceneEye::Seen> SceneEye::first_along(const Vec3d& start, const Vec3d& direction, double size,
                                                    float threshold, bool& through) {
  Bounds3d box;
  box.add(start);
  box.add(start + direction);
  find_candidates(box, 1, [&](const Bounds3d& b) { return enters_along(start, direction, b, 1); });
  Place best;
  double along = 1;
  for (const Candidate& c : candidates_) {
    if (c.distance > along) break;
    const Block here = block(c.block);
    const auto accept = [&](std::uint32_t item, double at) {
      const bool does = covers(*here, item, start + at * direction, size, threshold);
      through = through || !does;
      return does;
    };
    const auto found = here->triangles().first_along(
        start, direction, along, accept, [&](std::uint32_t a, std::uint32_t b) { return before(*here, a, *here, b); });
    if (!found) continue;
    if (best.block && found->along == along && !before(*here, found->item, *best.block, best.item)) continue;
    best = {here, found->item};
    along = found->along;
  }
  if (!best.block) return {};
  return Seen{along, at(*best.block, best.item, start + along * direction, size)};
}

/// Returns the nearest item that accept(block, item) takes, at most the root of `most` away. If there is none, it has
/// no block.
template <class Accept>
SceneEye::Place SceneEye::nearest_place(const Vec3d& p, double most, const Accept& accept) {
  Bounds3d box;
  const double side = std::sqrt(most) * (1 + 1e-9);
  box.add({p[0] - side, p[1] - side, p[2] - side});
  box.add({p[0] + side, p[1] + side, p[2] + side});
  constexpr double kRounding = 1 - 1e-12;  // as in TriangleBvh::nearest_within()
  find_candidates(box, most, [&](const Bounds3d& b) { return kRounding * distance_squared(p, b); });
  Place best;
  for (const Candidate& c : candidates_) {
    if (c.distance > most) break;
    const Block here = block(c.block);
    const auto found = here->triangles().nearest_within(
        p, most, [&](std::uint32_t item) { return accept(*here, item); },
        [&](std::uint32_t a, std::uint32_t b) { return before(*here, a, *here, b); });
    if (!found) continue;
    if (best.block && found->distance_squared == most && !before(*here, found->item, *best.block, best.item)) continue;
    best = {here, found->item};
    most = found->distance_squared;
  }
  return best;
}

Vec3d SceneEye::nearest_of(const Place& place, const Vec3d& p) const {
  return nearest_point(p, place.block->triangles().item(place.item).corners);
}

std::optional<Look> SceneEye::nearest(const Vec3d& p, double reach, double size, float threshold) {
  double most = reach * reach;
  if (near_.block) most = std::min(most, distance_squared(p, near_.block->triangles().item(near_.item).corners));
  const Place first = nearest_place(p, most, [](const LookBlock&, std::uint32_t) { return true; });
  if (!first.block) return {};
  near_ = first;
  const Vec3d q = nearest_of(first, p);
  Look look = at(*first.block, first.item, q, size);
  look.alpha = 1;
  if (covers(*first.block, first.item, q, size, threshold)) return look;
  const double away = length(q - p), farther = std::min(reach, away + std::max(away, 2 * size));
  const auto accept = [&](const LookBlock& block, std::uint32_t item) {
    return covers(block, item, nearest_point(p, block.triangles().item(item).corners), size, threshold);
  };
  const Place other = nearest_place(p, farther * farther, accept);
  if (other.block) look = at(*other.block, other.item, nearest_of(other, p), size);
  look.alpha = other.block ? 1 : 0;
  return look;
}

Look SceneEye::at(const LookBlock& block, std::uint32_t item, const Vec3d& p, double size) {
  const TriangleD& corners = block.triangles().item(item).corners;
  std::array<double, 3> part = barycentric(corners, p);
  for (double& x : part) x = std::clamp(x, 0.0, 1.0);
  Look look;
  const TriangleColors& colors = block.colors(item);
  const auto mean = [&](std::uint16_t LinearColor::*c) {
    return float((part[0] * colors[0].*c + part[1] * colors[1].*c + part[2] * colors[2].*c) / 65535);
  };
  look.color = {mean(&LinearColor::r), mean(&LinearColor::g), mean(&LinearColor::b)};
  const TriangleTexture& texture = block.texture(item);
  Spot spot{part, {}, {}, size};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      spot.uv[i] += part[k] * double(texture.uv[k][i]);
      spot.second_uv[i] += part[k] * double(texture.second_uv[k][i]);
    }
  }
  if (surfaces_) add_surface(block, item, spot, look);
  if (texture.material == TriangleTexture::kNoMaterial) return look;
  const TextureMaterial& material = looks_.images_->material(texture.material);
  LinearTexel texel{1, 1, 1, 1};
  if (const MipImage* const seen = image(material.image)) {
    const double texels = size * texels_per_unit(corners, texture, {seen->width(), seen->height()});
    texel = seen->at(spot.uv[0], spot.uv[1], texels, material.wrap);
    for (std::size_t i = 0; i < 3; ++i) look.color[i] = material.replaces_color ? texel[i] : look.color[i] * texel[i];
  }
  if (!surfaces_) {
    const std::array<float, 3> light = light_at(material.surface, corners, texture, spot);
    for (std::size_t i = 0; i < 3; ++i) look.color[i] = std::min(1.0F, look.color[i] + light[i]);
    if (image(material.image) == nullptr) return look;
  }
  if (material.alpha_mode != AlphaMode::opaque) look.alpha = std::clamp(texel[3] * material.alpha, 0.0F, 1.0F);
  return look;
}

LinearTexel SceneEye::numbers_at(const TextureMap& map, const TriangleD& t, const TriangleTexture& texture,
                                 const Spot& spot, MipImage::Kind kind) {
  const MipImage* const seen = image(map.image, kind);
  if (seen == nullptr) return {1, 1, 1, 1};
  const double texels = spot.size * texels_per_unit(t, texture, {seen->width(), seen->height()});
  const std::array<double, 2>& uv = map.in_second_places ? spot.second_uv : spot.uv;
  return seen->at(uv[0], uv[1], texels, map.wrap);
}

/// Returns no light if the image is broken.
std::array<float, 3> SceneEye::light_at(const TextureSurface& surface, const TriangleD& t,
                                        const TriangleTexture& texture, const Spot& spot) {
  if (surface.emission_factor == std::array<float, 3>{}) return {};
  if (surface.emission.is_there() && image(surface.emission.image) == nullptr) return {};
  const LinearTexel texel = numbers_at(surface.emission, t, texture, spot, MipImage::Kind::color);
  std::array<float, 3> light{};
  for (std::size_t i = 0; i < 3; ++i) light[i] = std::clamp(surface.emission_factor[i] * texel[i], 0.0F, 1.0F);
  return light;
}

/// Adds the surface: the normals of corners, else of the triangle; then the image of directions. Its tangent space
/// follows from the triangle's places in it, as in viewers that know no tangents.
void SceneEye::add_surface(const LookBlock& block, std::uint32_t item, const Spot& spot, Look& look) {
  const TriangleD& t = block.triangles().item(item).corners;
  const TriangleTexture& texture = block.texture(item);
  const Vec3d flat = unit(cross(t[1] - t[0], t[2] - t[0]), kUp);
  Vec3d normal{};
  for (std::size_t k = 0; k < 3; ++k) normal = normal + spot.part[k] * unpack_normal(texture.normals[k]);
  normal = dot(normal, flat) > 0 ? unit(normal, kUp) : flat;
  if (texture.material != TriangleTexture::kNoMaterial) {
    const TextureSurface& surface = looks_.images_->material(texture.material).surface;
    const LinearTexel rough = numbers_at(surface.roughness, t, texture, spot, MipImage::Kind::numbers);
    look.roughness = std::clamp(surface.roughness_factor * rough[1], 0.0F, 1.0F);
    look.metal = std::clamp(surface.metal_factor * rough[2], 0.0F, 1.0F);
    look.emission = light_at(surface, t, texture, spot);
    if (image(surface.normal.image, MipImage::Kind::numbers) != nullptr)
      normal = bent(normal, t, texture, numbers_at(surface.normal, t, texture, spot, MipImage::Kind::numbers),
                    double(surface.normal_scale));
  }
  const double turn = dot(flat, side_) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) look.normal[i] = float(turn * normal[i]);
}

bool SceneEye::covers(const LookBlock& block, std::uint32_t item, const Vec3d& p, double size, float threshold) {
  const TriangleTexture& texture = block.texture(item);
  if (texture.material == TriangleTexture::kNoMaterial) return true;
  const TextureMaterial& material = looks_.images_->material(texture.material);
  if (material.alpha_mode == AlphaMode::opaque) return true;
  return at(block, item, p, size).alpha >= (material.alpha_mode == AlphaMode::mask ? material.cutoff : threshold);
}

}  // namespace bp
