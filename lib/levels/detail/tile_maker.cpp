#include "lib/levels/detail/tile_maker.h"

#include <algorithm>
#include <cmath>

#include "lib/geometry/surface_distance.h"
#include "lib/grid/clip.h"
#include "lib/grid/shelf_stream.h"
#include "lib/levels/detail/voxel_distance.h"
#include "lib/levels/voxel_choice.h"
#include "lib/mesh/box_group.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/volume/boundary_rects.h"
#include "lib/volume/dilate.h"

namespace bp {

namespace {

/// Makes bricks of the voxels in `box` from rows. word(c, y, z, p, i) returns row (y, z) of brick c; the row begins at
/// voxel p, and is word i of a row of a bit box over `box`.
template <class Word>
std::unique_ptr<BrickShelf> shelf_of_rows(const VoxelBox& box, const ShelfFactory& make_shelf, const Word& word) {
  auto shelf = make_shelf();
  const std::int32_t first_x = bricks_of(box).min.x;
  for_each_brick(box, [&](BrickCoord c) {
    BrickBits bits{};
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        if (row_within(c, y, z, box) == 0) continue;
        bits[std::size_t(z * kBrickEdge + y)] = word(c, y, z, first_voxel(c) + VoxelCoord{0, y, z}, c.x - first_x);
      }
    }
    if (classify(bits) != BrickFill::empty) shelf->put(c, classify(bits), bits);
  });
  return shelf;
}

}  // namespace

ResultKey TileMaker::key(const ResultKey& inputs) const {
  const TileShape& shape = params_;
  KeyHash hash("tile");
  hash.add(shape, level_.header.frame, coord_, level_.cells);
  const BrickCoord origin = brick_of(cell_.min);
  add_voxels(hash, level_.closing, grown_, origin);
  add_voxels(hash, level_.solid, grown_, origin);
  add_voxels(hash, level_.surface, reach(), origin);
  if (params_.scene != nullptr) {
    const std::vector<TriangleD> scene = scene_nearby();
    hash.add(std::as_bytes(std::span(scene)), params_.rounding.share, params_.rounding.offset, grown_world());
  }
  hash.add(inputs);
  return hash.key();
}

bool TileMaker::begin() {
  solid_ = clipped(level_.solid, grown_, context_.make_shelf);
  closing_ = clipped(level_.closing, grown_, context_.make_shelf);
  if (solid_->coords().empty() && is_full(*closing_, cell_)) return false;
  if (params_.mode == MeshMode::bounding && params_.enclose != Enclose::closing) leave_out_fringes();
  if (closing_->coords().empty()) return false;
  boundary_ = boundary_of(*solid_);
  take_scene();
  params_.mode == MeshMode::bounding && !scene_.empty() ? hold_beside_triangles() : hold_stray_parts();
  return true;
}

/// The number of triangles decides whether they stay inside. The memory must not decide it, since it must not change
/// the result.
void TileMaker::take_scene() {
  if (params_.scene == nullptr) return;
  const bool fit = params_.mode == MeshMode::fit;
  if (!fit && params_.enclose != Enclose::scene) return;
  scene_ = scene_nearby();
  if (fit) return;
  const Bounds3d cell = grown_world();
  const bool here =
      std::any_of(scene_.begin(), scene_.end(), [&](const TriangleD& t) { return overlap(bounds_of(t), cell); });
  if (!here || scene_.size() > TileParams::kMostTriangles) scene_.clear();
}

LatticeMesh TileMaker::make(TileMeasures& measures) {
  MeshCounts counts;
  ShelfSource source(header(), *solid_, closing_.get(), ShelfSource::Keep::solid);
  LatticeMesh mesh = std::move(mesh_stream(source, context_, mesh_params(measures), counts).front());
  measure(mesh, measures);
  measures.faces_dense = counts.levels.front().simplify.faces_in;
  measures.volume = counts.levels.front().measures.volume;
  return mesh;
}

std::uint64_t TileMaker::limit(std::uint64_t triangles) const {
  TileMeasures ignored;
  MeshParams mesh = mesh_params(ignored);
  if (params_.scene == nullptr && triangles > 0) mesh.enclose = Enclose::scene;
  ShelfSource source(header(), *solid_, closing_.get(), ShelfSource::Keep::solid);
  return mesh_limit(source, context_, mesh, params_.scene == nullptr ? triangles : scene_.size());
}

/// Removes from the closing the voxels that are here only because of voxels of the next cells: sheets along the walls,
/// far from everything that the tile encloses. These are the voxels beyond the closing's reach from the solid. Voxels
/// that fill a cavity of the rest stay.
void TileMaker::leave_out_fringes() {
  BitBox closing(grown_), kept(grown_), outside(grown_);
  load_voxels(*closing_, closing);
  load_voxels(*solid_, kept);
  dilate(kept, std::int32_t(std::ceil(params_.scale_world / level_.header.frame.voxel)) + 1);
  const VoxelBox box = closing.box();
  const std::int32_t words = closing.words_per_row();
  std::vector<std::uint64_t> here(std::size_t(words), 0);  // for each word of a row, the bits of grown_
  for (std::int32_t x = grown_.min.x; x < grown_.max.x; ++x)
    here[std::size_t((x - box.min.x) / 64)] |= std::uint64_t(1) << ((x - box.min.x) % 64);
  const auto for_each_word = [&](const auto& body) {
    for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
      for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
        for (std::int32_t i = 0; i < words; ++i)
          body(closing.row(y, z)[i], kept.row(y, z)[i], outside.row(y, z)[i], here[std::size_t(i)]);
      }
    }
  };
  std::uint64_t far = 0;
  for_each_word([&](std::uint64_t c, std::uint64_t& near, std::uint64_t& out, std::uint64_t cell) {
    far |= c & ~near;
    out = ~c & cell;
    near = (~c | ~near) & cell;  // the empty or far voxels, through which the outside may go
  });
  if (far == 0) return;
  grow_within(kept, outside);
  for_each_word([&](std::uint64_t& c, std::uint64_t, std::uint64_t out, std::uint64_t) { c &= ~out; });
  closing_ = shelf_of_rows(
      grown_, context_.make_shelf,
      [&](BrickCoord, std::int32_t, std::int32_t, VoxelCoord p, std::int32_t i) { return closing.row(p.y, p.z)[i]; });
}

/// Adds to the solid the parts of the closing that hold no voxel of the solid in this cell. Tightening would shrink
/// such a part without limit, even through itself; so it must enclose its own voxels.
void TileMaker::hold_stray_parts() {
  BitBox closing(grown_), held(grown_);
  load_voxels(*closing_, closing);
  load_voxels(*solid_, held);
  grow_within(closing, held);
  const auto stray = shelf_of_rows(grown_, context_.make_shelf,
                                   [&](BrickCoord, std::int32_t, std::int32_t, VoxelCoord p, std::int32_t i) {
                                     return closing.row(p.y, p.z)[i] & ~held.row(p.y, p.z)[i];
                                   });
  BrickBits bits, before;
  for (const BrickCoord c : stray->coords()) {
    stray->get(c, bits);
    solid_->get(c, before);
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] |= before[i];
    solid_->put(c, classify(bits), bits);
  }
}

/// Collects the voxels that must stay inside in addition to the triangles. These are the parts of the closing that hold
/// no triangle here (see hold_stray_parts()). In a filled solid they are also the voxels where the wall of the cell
/// cuts through it: else tightening would hollow out the tile from the wall.
void TileMaker::hold_beside_triangles() {
  constexpr std::int32_t kBesideTriangles = 2;  // voxels; the triangles hold what is so near to them
  BitBox closing(grown_), solid(grown_), reached(grown_), near(grown_);
  load_voxels(*closing_, closing);
  load_voxels(*solid_, solid);
  load_voxels(*clipped(level_.surface, cell_, context_.make_shelf), reached);
  load_voxels(level_.surface, near);
  grow_within(closing, reached);
  dilate(near, kBesideTriangles);
  held_ = shelf_of_rows(grown_, context_.make_shelf,
                        [&](BrickCoord c, std::int32_t y, std::int32_t z, VoxelCoord p, std::int32_t i) {
                          const std::uint64_t stray = closing.row(p.y, p.z)[i] & ~reached.row(p.y, p.z)[i];
                          const std::uint64_t inside = solid.row(p.y, p.z)[i] & ~near.row(p.y, p.z)[i];
                          return stray | (inside & row_within(c, y, z, cell_) & ~row_within(c, y, z, cell_.grown(-1)));
                        });
}

MeshParams TileMaker::mesh_params(TileMeasures& measures) const {
  MeshParams mesh;
  mesh.mode = params_.mode;
  mesh.enclose = params_.enclose;
  mesh.error_world = params_.error_world;
  mesh.near_world = params_.scale_world;  // used where error_world is no limit
  if (params_.error_world == 0) {
    const std::uint64_t solid_faces = 2 * boundary_.faces;
    measures.faces_asked =
        params_.faces > 0 ? params_.faces : std::max(solid_faces / kDensePerFace, TileParams::kLeastTileFaces);
    mesh.faces = {measures.faces_asked};
    if (params_.faces == 0 && params_.mode == MeshMode::bounding && solid_faces <= TileParams::kMostFacesForError)
      mesh.error_world = TileParams::kErrorVox * level_.header.frame.voxel;
  }
  mesh.scene = scene_, mesh.rounding = params_.rounding;
  if (params_.mode == MeshMode::fit) {
    mesh.enclose = scene_.empty() ? Enclose::closing : Enclose::scene;
  } else if (params_.enclose == Enclose::scene) {
    mesh.enclose = scene_.empty() ? Enclose::input : Enclose::scene;
    mesh.distances_to = Enclose::input;
    if (!scene_.empty()) mesh.part = ScenePart{grown_world(), held_.get()};
  }
  return mesh;
}

StreamHeader TileMaker::header() const {
  StreamHeader header = level_.header;
  header.bricks = bricks_of(grown_);
  header.slab_axis = longest_axis(header.bricks);
  header.has_closing = true;
  header.scale = {};
  header.scale.base = params_.scale_world;
  header.element = params_.element;
  return header;
}

/// Returns the cell, grown by a lattice unit and by twice the distance that triangles may be off: far more than a check
/// grows it by, and less than a voxel.
Bounds3d TileMaker::grown_world() const {
  const double off = params_.rounding.of(level_.header.bounds) * kLatticePerVoxel / level_.header.frame.voxel;
  return bounds_of(cell_, level_.header.frame, 1 + std::int64_t(std::ceil(2 * off)));
}

/// Returns the triangles that meet the box of reach(), in the scene's order.
std::vector<TriangleD> TileMaker::scene_nearby() const {
  std::vector<std::pair<std::uint32_t, TriangleD>> found;
  params_.scene->visit(bounds_of(reach(), level_.header.frame), [&](const TriangleBvh::Item& item) {
    found.emplace_back(item.id, item.corners);
    return false;
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TriangleD> triangles;
  for (const auto& [id, corners] : found) triangles.push_back(corners);
  return triangles;
}

/// Returns the triangles, and the faces of the cell's walls where the solid goes on beyond the cell.
std::vector<TriangleD> TileMaker::shown() const {
  std::vector<TriangleD> shown = scene_;
  for (const FaceRect& rect : boundary_rects(*solid_)) {
    bool wall = false;
    for (int i = 0; i < 3; ++i)
      wall = wall || (rect.min[i] == rect.max[i] && (rect.min[i] == grown_.min[i] || rect.max[i] == grown_.max[i]));
    if (!wall) continue;
    for (const TriangleD& t : triangles_of(rect, level_.header.frame)) shown.push_back(t);
  }
  return shown;
}

/// Returns a box in which every voxel of the closing in the cell finds a voxel of the scene, and a fit finds the
/// triangles that it follows.
VoxelBox TileMaker::reach() const {
  return cell_.grown(tile_reach(params_.scale_world, level_.header.frame.voxel));
}

void TileMaker::measure(const LatticeMesh& mesh, TileMeasures& measures) const {
  measures.faces = mesh.triangles.size();
  const LatticeBox box = box_of(mesh.vertices);
  measures.min = box.min;
  measures.max = box.max;
  const GridFrame& frame = mesh.frame;
  const std::vector<TriangleD> triangles = world_triangles(mesh);
  if (params_.mode == MeshMode::bounding && !scene_.empty()) {
    measures.error_world = largest_distance(triangles, TriangleBvh(shown()), frame.voxel * kTriangleTolerance).at_most;
    return;
  }
  std::vector<VoxelRun> near = runs_of(level_.surface, reach());
  near.insert(near.end(), boundary_.runs.begin(), boundary_.runs.end());  // walls
  measures.error_world = distance_from_mesh(triangles, TriangleBvh(segments_of(near, frame)), frame.voxel);
  if (params_.mode != MeshMode::fit) return;
  measures.error_world = distance_beyond_mesh(segments_of(runs_of(level_.surface, cell_), frame),
                                              TriangleBvh(triangles), frame.voxel, measures.error_world);
}

}  // namespace bp
