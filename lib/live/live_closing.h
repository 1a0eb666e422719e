#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "lib/device/backend.h"
#include "lib/live/live_surface.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/measure/orientation_rules.h"

/// The closing of a scene while its rules change. Each request replaces the one before, whose work is given up. Only
/// tiles in whose reach the scale has changed are closed again.
namespace bp {

/// The scene to be closed. Its closing is that of `bpvox | bpscale | bpclose` with these rules, voxel for voxel.
struct LiveScene {
  StreamHeader header;                ///< of bpvox
  std::unique_ptr<BrickShelf> solid;  ///< with bricks of the header
  ClosingParams params;
  PassContext context;                                 ///< for the closing, and for rules by shape
  TriangleReader triangles;                            ///< reads the scene again, for an orientation that asks for it
  std::uint64_t most_faces = LiveSurface::kMostFaces;  ///< of voxels that are drawn
};

class LiveClosing {
 public:
  struct Status {
    std::uint64_t asked = 0, shown = 0;  ///< revisions of the design: of the last request, and of the surface; 0: none
    std::uint64_t generation = 0;        ///< of the surface
    double drawn_voxel = 0;              ///< edge of the voxels that the surface shows, scene units
    std::uint64_t voxels = 0;            ///< voxels of the closing
    double seconds = 0;                  ///< from the request to the surface
    std::string error;                   ///< why the last request failed; empty: it did not fail
    [[nodiscard]] bool busy() const { return asked != shown && error.empty(); }
  };

  /// `changed` is called after each request that was not replaced, on a thread of this object.
  LiveClosing(LiveScene scene, Backends& backends, std::function<void()> changed);
  ~LiveClosing();  ///< gives up the work that is going on
  LiveClosing(const LiveClosing&) = delete;
  LiveClosing& operator=(const LiveClosing&) = delete;

  [[nodiscard]] const LiveScene& scene() const { return scene_; }
  /// Asks for the closing of a plan, and returns at once. A revision is one plan: the revision of the last request is
  /// not closed again, unless it has failed.
  void request(ScalePlan plan, std::uint64_t revision);
  void wait();  ///< waits until the last request is done, or has failed
  [[nodiscard]] Status status() const;
  [[nodiscard]] const LiveSurface& surface() const { return surface_; }
  /// Returns the closing of the last request. Do not call it while a request is at work.
  [[nodiscard]] const BrickShelf* closing() const { return closed_.voxels.get(); }

 private:
  using Clock = std::chrono::steady_clock;
  void work();
  void close(const ScalePlan& plan, std::uint64_t revision, Clock::time_point begin);
  /// Returns the turned cubes of a plan; null if it has none. Making them anew takes time only where they change.
  [[nodiscard]] const OrientationField* cubes_of(const ScalePlan& plan);

  const LiveScene scene_;
  Backends& backends_;
  const std::function<void()> changed_;

  mutable std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::unique_ptr<ScalePlan> next_;  ///< requested, not begun
  Clock::time_point asked_at_;
  bool ends_ = false;
  Status status_;

  LiveSurface surface_;  ///< has a lock of its own
  // The members below need no lock: only the working thread uses them, apart from stop_, which is atomic, thread_, and
  // closed_ while no request is at work.
  std::atomic<bool> stop_{false};    ///< gives up the work that is going on
  EarlierClosing closed_;            ///< what the surface shows
  OrientationField closed_cubes_;    ///< the turned cubes of closed_
  std::string cubes_text_;           ///< the orientation of cubes_, as JSON
  std::int32_t cubes_cell_vox_ = 0;  ///< edge of the cells of cubes_
  OrientationField cubes_;
  std::thread thread_;  ///< the last member: the thread begins when all others exist
};

}  // namespace bp
