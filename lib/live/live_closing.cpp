#include "lib/live/live_closing.h"

#include <bit>
#include <chrono>
#include <set>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/orientation.h"
#include "lib/pass/measure/shape_rules.h"

namespace bp {

namespace {

VoxelBox voxels_of_brick(BrickCoord c) {
  return voxels_of(BrickBox{c, {c.x + 1, c.y + 1, c.z + 1}});
}

/// Returns the voxels of a brick in which two shelves differ, as a box of whole rows and slices of the brick; empty if
/// they agree.
VoxelBox differing(const BrickShelf& a, const BrickShelf& b, BrickCoord brick) {
  BrickBits of_a, of_b;
  const BrickFill fill_a = a.get(brick, of_a), fill_b = b.get(brick, of_b);
  VoxelBox box;
  if (fill_a == fill_b && fill_a != BrickFill::mixed) return box;
  const VoxelCoord first = first_voxel(brick);
  for (std::int32_t i = 0; i < std::int32_t(of_a.size()); ++i) {
    const std::uint64_t bits = of_a[std::size_t(i)] ^ of_b[std::size_t(i)];
    if (bits == 0) continue;
    const std::int32_t y = first.y + i % kBrickEdge, z = first.z + i / kBrickEdge;
    box = hull(box, {{first.x + std::countr_zero(bits), y, z}, {first.x + 64 - std::countl_zero(bits), y + 1, z + 1}});
  }
  return box;
}

bool same(const ScaleLattice& a, const ScaleLattice& b) {
  return a.origin == b.origin && a.size == b.size && a.samples == b.samples;
}

std::uint64_t count_voxels(const BrickShelf& shelf) {
  std::uint64_t count = 0;
  BrickBits bits;
  for (const BrickCoord c : shelf.coords()) {
    (void)shelf.get(c, bits);
    for (const std::uint64_t word : bits) count += std::uint64_t(std::popcount(word));
  }
  return count;
}

}  // namespace

LiveClosing::LiveClosing(LiveScene scene, Backends& backends, std::function<void()> changed)
    : scene_(std::move(scene)), backends_(backends), changed_(std::move(changed)), thread_([this] { work(); }) {}

LiveClosing::~LiveClosing() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void LiveClosing::request(ScalePlan plan, std::uint64_t revision) {
  {
    const std::lock_guard lock(mutex_);
    if (revision == status_.asked && status_.error.empty()) return;
    next_ = std::make_unique<ScalePlan>(std::move(plan));
    status_.asked = revision;
    status_.error.clear();
    asked_at_ = Clock::now();
    stop_ = true;
  }
  wake_.notify_all();
}

void LiveClosing::wait() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return !status_.busy(); });
}

LiveClosing::Status LiveClosing::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::vector<LiveClosing::Piece> LiveClosing::since(std::uint64_t generation) const {
  const std::lock_guard lock(mutex_);
  std::vector<Piece> some;
  for (const auto& [brick, piece] : pieces_) {
    if (piece.generation > generation) some.push_back(piece);
  }
  return some;
}

void LiveClosing::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return ends_ || next_ != nullptr; });
    if (ends_) return;
    const std::unique_ptr<ScalePlan> plan = std::move(next_);
    const std::uint64_t revision = status_.asked;
    const Clock::time_point begin = asked_at_;
    stop_ = false;
    lock.unlock();
    std::string error;
    try {
      close(*plan, revision, begin);
    } catch (const Cancelled&) {
      continue;
    } catch (const std::exception& e) {
      error = e.what();
      closing_.reset();  // all pieces are made again, because some may be of this request
      lattices_.clear();
    }
    lock.lock();
    if (status_.asked == revision) status_.error = error;
    lock.unlock();
    done_.notify_all();
    changed_();
  }
}

void LiveClosing::close(const ScalePlan& plan, std::uint64_t revision, Clock::time_point begin) {
  CloseOptions options;
  options.context = scene_.context;
  options.context.stop = &stop_;
  const ScalePlan found = measured(plan, scene_.header, *scene_.solid, {0, options.context});
  ClosingParams params = scene_.params;
  params.orientation = cubes_of(found);
  auto closing = close_shelf(scene_.header, *scene_.solid, backends_, found.field, params, options);
  options.context.check();
  make_pieces(*closing, found.field);
  const std::uint64_t voxels = count_voxels(*closing);
  closing_ = std::move(closing);
  const std::lock_guard lock(mutex_);
  status_.shown = revision;
  status_.voxels = voxels;
  status_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
}

const OrientationField* LiveClosing::cubes_of(const ScalePlan& plan) {
  if (plan.orientation.empty() || scene_.params.element != StructuringElement::cube) return nullptr;
  const std::int32_t cell = orientation_cell_vox(scene_.header, plan.field.base);
  if (plan.orientation != cubes_text_ || cell != cubes_cell_vox_) {
    const TriangleReader read_scene = [&](const auto& take) {
      scene_.triangles([&](const TriangleD& t) {
        if (stop_) throw Cancelled{};
        take(t);
      });
    };
    cubes_ = make_orientation(parse_orientation(plan.orientation, "orientation"), scene_.header, plan.field.base,
                              read_scene);
    cubes_text_ = plan.orientation;
    cubes_cell_vox_ = cell;
  }
  return cubes_.empty() ? nullptr : &cubes_;
}

std::vector<LiveClosing::Change> LiveClosing::changes(const BrickShelf& closing, const ScaleField& field) {
  std::set<BrickCoord> there;
  std::map<BrickCoord, bool> changed;  // whether its voxels changed; else only its scales did
  for (const BrickCoord c : closing.coords()) there.insert(c);
  std::set<BrickCoord> all = there;
  if (closing_ != nullptr) {
    for (const BrickCoord c : closing_->coords()) all.insert(c);
  } else {
    for (const auto& [brick, piece] : pieces_) changed[brick] = true;
  }
  for (const BrickCoord c : all) {
    const VoxelBox box = closing_ == nullptr ? voxels_of_brick(c) : differing(*closing_, closing, c);
    if (!box.empty()) for_each(bricks_of(box.grown(piece_apron())), [&](BrickCoord b) { changed[b] = true; });
  }
  const std::vector<BrickCoord> sampled(there.begin(), there.end());
  std::vector<ScaleLattice> lattices(sampled.size());
  parallel_for(std::int64_t(sampled.size()), [&](std::int64_t i) {
    lattices[std::size_t(i)] = field.sample(scene_.header.frame, voxels_of_brick(sampled[std::size_t(i)]).grown(1));
  });
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    ScaleLattice& old = lattices_[sampled[i]];
    if (!same(old, lattices[i])) changed.emplace(sampled[i], false);
    old = std::move(lattices[i]);
  }
  std::vector<Change> all_changes;
  for (const auto& [brick, voxels] : changed) all_changes.push_back({brick, voxels});
  return all_changes;
}

void LiveClosing::make_pieces(const BrickShelf& closing, const ScaleField& field) {
  const std::vector<Change> bricks = changes(closing, field);
  std::vector<std::shared_ptr<const SurfacePiece>> made(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const auto [brick, voxels] = bricks[std::size_t(i)];
    static const ScaleLattice none;
    const auto found = lattices_.find(brick);
    const ScaleLattice& lattice = found == lattices_.end() ? none : found->second;
    const auto old = pieces_.find(brick);  // only this thread changes the pieces
    made[std::size_t(i)] = std::make_shared<const SurfacePiece>(voxels || old == pieces_.end()
                                                                    ? piece_of(closing, brick, lattice)
                                                                    : with_scales(*old->second.surface, lattice));
  });
  const std::lock_guard lock(mutex_);
  if (bricks.empty()) return;
  ++status_.generation;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (made[i]->triangles.empty() && !pieces_.contains(bricks[i].brick)) continue;
    pieces_[bricks[i].brick] = {status_.generation, std::move(made[i])};
  }
}

}  // namespace bp
