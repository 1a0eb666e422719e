#include "lib/live/live_closing.h"

#include <atomic>
#include <chrono>

#include "lib/core/error.h"
#include "lib/pass/measure/orientation.h"
#include "lib/pass/measure/shape_rules.h"

namespace bp {

LiveClosing::LiveClosing(LiveScene scene, Backends& backends, std::function<void()> changed)
    : scene_(std::move(scene)),
      backends_(backends),
      changed_(std::move(changed)),
      surface_(scene_.context.make_shelf, scene_.most_faces),
      thread_([this] { work(); }) {}

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
  Status status = status_;
  status.generation = surface_.generation();
  status.drawn_voxel = surface_.drawn_voxel();
  return status;
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
  const OrientationField upright;
  const OrientationField& cubes = params.orientation != nullptr ? *params.orientation : upright;
  if (closed_.voxels != nullptr && closed_cubes_ == cubes) options.earlier = &closed_;
  const std::shared_ptr<BrickShelf> filled = scene_.context.make_shelf();
  options.filled = filled.get();
  EarlierClosing closed{found.field, close_shelf(scene_.header, *scene_.solid, backends_, found.field, params, options),
                        filled};
  options.context.check();
  const std::uint64_t voxels = surface_.show(scene_.header.frame, closed.voxels, found.field);
  closed_ = std::move(closed);
  closed_cubes_ = cubes;
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

}  // namespace bp
