#pragma once
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "lib/device/backend.h"
#include "lib/live/surface_piece.h"
#include "lib/pass/context.h"
#include "lib/pass/measure/orientation_rules.h"

/// The closing of a scene while its rules change. Each request replaces the one before, whose work is given up. Only
/// the pieces of the surface that changed are made again.
namespace bp {

/// The scene to be closed. Its closing is that of `bpvox | bpscale | bpclose` with these rules, voxel for voxel.
struct LiveScene {
  StreamHeader header;                ///< of bpvox
  std::unique_ptr<BrickShelf> solid;  ///< with bricks of the header
  ClosingParams params;
  PassContext context;       ///< for the closing, and for rules by shape
  TriangleReader triangles;  ///< reads the scene again, for an orientation that asks for it
};

class LiveClosing {
 public:
  /// A piece of the surface, ready to be sent.
  struct Piece {
    std::uint64_t generation = 0;  ///< generation of the surface in which the piece changed last
    std::shared_ptr<const SurfacePiece> surface;
  };
  struct Status {
    std::uint64_t asked = 0, shown = 0;  ///< revisions of the design: of the last request, and of the surface; 0: none
    std::uint64_t generation = 0;        ///< generation of the surface; rises when pieces change
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
  /// Returns the pieces that changed after a generation of the surface, by brick. Pieces that became empty are among
  /// them.
  [[nodiscard]] std::vector<Piece> since(std::uint64_t generation) const;
  /// Returns the closing of the last request. Do not call it while a request is at work.
  [[nodiscard]] const BrickShelf* closing() const { return closing_.get(); }

 private:
  using Clock = std::chrono::steady_clock;
  void work();
  void close(const ScalePlan& plan, std::uint64_t revision, Clock::time_point begin);
  /// Returns the turned cubes of a plan; null if it has none. Making them anew takes time only where they change.
  [[nodiscard]] const OrientationField* cubes_of(const ScalePlan& plan);
  void make_pieces(const BrickShelf& closing, const ScaleField& field);
  /// A brick whose piece may have changed since closing_, because voxels near it did, or only the scales in it.
  struct Change {
    BrickCoord brick;
    bool voxels = false;
  };
  [[nodiscard]] std::vector<Change> changes(const BrickShelf& closing, const ScaleField& field);

  const LiveScene scene_;
  Backends& backends_;
  const std::function<void()> changed_;

  mutable std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::unique_ptr<ScalePlan> next_;  ///< requested, not begun
  Clock::time_point asked_at_;
  bool ends_ = false;
  Status status_;
  std::map<BrickCoord, Piece> pieces_;

  // The members below need no lock: only the working thread uses them, apart from stop_, which is atomic, thread_, and
  // closing_ while no request is at work.
  std::atomic<bool> stop_{false};                ///< gives up the work that is going on
  std::unique_ptr<BrickShelf> closing_;          ///< closing that the surface shows
  std::map<BrickCoord, ScaleLattice> lattices_;  ///< scales that the pieces show
  std::string cubes_text_;                       ///< the orientation of cubes_, as JSON
  std::int32_t cubes_cell_vox_ = 0;              ///< edge of the cells of cubes_
  OrientationField cubes_;
  std::thread thread_;  ///< the last member: the thread begins when all others exist
};

}  // namespace bp
