#pragma once
#include <optional>

#include "lib/live/design.h"
#include "lib/live/live_closing.h"
#include "tools/view/events.h"
#include "tools/view/proxy_job.h"

namespace bp {

/// A design and all that is shown of it. What the page asks for comes here, without a network. Thread-safe.
class Session {
 public:
  /// Voxelizes the scene, and begins to close it. Throws as bpvox and bpscale do. Keeps a reference to `options`.
  Session(const ViewOptions& options, Backends& backends);
  ~Session();

  [[nodiscard]] Events& events() { return events_; }
  [[nodiscard]] std::string state() const;  ///< JSON: all but geometry; events tell when it changes
  [[nodiscard]] std::string scene() const { return scene_bytes_; }  ///< wire.h; empty: too many triangles
  [[nodiscard]] std::string surface(std::uint64_t after) const;     ///< wire.h: the pieces after a generation
  [[nodiscard]] std::string proxy() const;                          ///< wire.h; empty: there is none

  /// One step of the design, as JSON: {"op": "rule", "rule": {...}, "again": BOOL},
  /// {"op": "base", "base": LENGTH, "again": BOOL},
  /// {"op": "remove", "rule": N}, {"op": "undo"}, {"op": "redo"}, {"op": "faces", "faces": N}, {"op": "live", "live":
  /// BOOL}. Throws bad_input, and changes nothing, if it is none of these.
  void edit(const std::string& json);
  void mesh();  ///< begins a proxy of the design as it is
  void stop();  ///< ends the proxy at work
  /// {"what": "rules"} or "proxy": writes the file that was named on the command line. Throws bad_argument if it exists
  /// and may not be replaced, bad_input if there is no proxy of the design as it is.
  void save(const std::string& json);

 private:
  void open_stream();
  void read_scene();
  void begin_design();
  void changed();  ///< of the closing or the proxy, on their threads
  void request_proxy();
  [[nodiscard]] bool is_current(const ProxyJob::Status& proxy) const;
  [[nodiscard]] Json design_json() const;
  [[nodiscard]] Json proxy_json() const;

  const ViewOptions& options_;
  Events events_;
  MemoryFile stream_;  ///< of bpvox
  StreamHeader header_;
  std::unique_ptr<BrickShelf> solid_;  ///< until the closing takes it
  Vec3d middle_{};                     ///< of the scene: positions are sent less this
  std::string scene_bytes_;
  std::uint64_t triangles_ = 0;

  mutable std::mutex mutex_;  ///< of what follows
  std::optional<Design> design_;
  std::uint64_t faces_ = 0;
  bool live_ = true;
  bool ends_ = false;
  std::uint64_t meshed_ = 0, meshed_faces_ = 0;     ///< last requested of job_
  bool rules_saved_ = false, proxy_saved_ = false;  ///< by this session: their files may be replaced
  std::uint64_t saved_revision_ = 0;

  // They call changed(): made last, and ended first.
  std::unique_ptr<ProxyJob> job_;
  std::unique_ptr<LiveClosing> closing_;
};

}  // namespace bp
