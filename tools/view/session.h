#pragma once
#include <optional>

#include "lib/live/design.h"
#include "lib/live/live_closing.h"
#include "tools/view/events.h"
#include "tools/view/files/layers.h"
#include "tools/view/files/shown_scene.h"
#include "tools/view/geometry/distances.h"
#include "tools/view/made_proxies.h"
#include "tools/view/proxy_job.h"

namespace bp {

/// A design and all that is shown of it. The requests of the page come here, without a network. Thread-safe.
class Session {
 public:
  /// Voxelizes the scene and begins to close it. Throws as bpvox and bpscale do. Keeps a reference to `options`.
  Session(const ViewOptions& options, Backends& backends);
  ~Session();

  [[nodiscard]] Events& events() { return events_; }
  [[nodiscard]] std::string state() const;  ///< JSON of everything but geometry; events tell when it changes
  [[nodiscard]] ShownScene& scene() { return *scene_; }
  /// Returns the pieces of the closing's surface that changed after a generation.
  [[nodiscard]] LiveSurface::Change surface(std::uint64_t after) const { return closing_->surface().since(after); }
  [[nodiscard]] std::string rules() const;  ///< the file that save() writes: a page keeps it for the case that we end
  /// Returns the proxy with a number as ShownMesh::bytes(), with distances from the scene if they are asked for. Number
  /// 0: the last one, or nothing if there is none. Throws bad_argument if the proxy is not kept, out_of_resource if it
  /// has too many triangles.
  [[nodiscard]] std::string proxy(std::uint64_t number, bool distances) const;

  /// Returns a level of a file of --show, likewise. Throws as read_level() and SceneDistances::add_to().
  [[nodiscard]] std::string layer(std::uint64_t file, std::uint64_t level, bool distances) const;

  /// Makes one step of the design, which is JSON: {"op": "rule", "rule": {...}, "again": BOOL},
  /// where a list of rules is one step, too, {"op": "base", "base": LENGTH, "again": BOOL},
  /// {"op": "orientation", "orientation": "auto", a list of frames, or null, "again": BOOL}, {"op": "remove", "rule":
  /// N}, {"op": "undo"}, {"op": "redo"}, {"op": "faces", "faces": N}, {"op": "live", "live": BOOL}. Throws bad_input,
  /// and changes nothing, for any other JSON. Returns the design's revision after the step.
  std::uint64_t edit(const std::string& json);
  void check(const std::string& json);  ///< begins to prove a file of --show: `json` is {"file": N}
  void mesh();                          ///< begins a proxy of the present design
  void stop();                          ///< ends the proxy at work
  /// Writes the file that was named on the command line: `json` is {"what": "rules"} or {"what": "proxy"}. Throws
  /// bad_argument if the file exists and may not be replaced, bad_input if there is no proxy of the present design.
  void save(const std::string& json);

 private:
  void open_stream();
  void begin_design();
  void changed();  ///< called by the closing and the proxy job, on their threads
  void request_proxy();
  [[nodiscard]] std::shared_ptr<const std::string> proxy_file(std::uint64_t number) const;
  [[nodiscard]] std::string bytes_of(ShownMesh mesh, bool distances) const;
  [[nodiscard]] bool is_current(const ProxyJob::Status& proxy) const;
  [[nodiscard]] Json design_json() const;
  [[nodiscard]] Json proxy_json() const;

  const ViewOptions& options_;
  Events events_;
  MemoryFile stream_;  ///< made by bpvox
  StreamHeader header_;
  std::unique_ptr<BrickShelf> solid_;  ///< until the closing takes it
  Vec3d middle_{};                     ///< of the scene; it is subtracted from positions that are sent
  const std::uint64_t most_shown_;     ///< triangles of a scene or file
  std::unique_ptr<ShownScene> scene_;
  std::unique_ptr<SceneDistances> distances_;

  mutable std::mutex mutex_;  ///< guards all that follows
  std::optional<Design> design_;
  std::uint64_t faces_ = 0;
  bool live_ = true;
  bool ends_ = false;
  std::uint64_t meshed_ = 0, meshed_faces_ = 0;         ///< last request to job_
  bool rules_saved_ = false, proxy_saved_ = false;      ///< saved by this session, so that their files may be replaced
  std::uint64_t saved_revision_ = 0, saved_proxy_ = 0;  ///< the design and the number of the proxy that were saved last
  std::optional<MadeProxies> made_;

  // The closing, the job and the layers call changed(), so they are made last and destroyed first.
  std::unique_ptr<Layers> layers_;
  std::unique_ptr<ProxyJob> job_;
  std::unique_ptr<LiveClosing> closing_;
};

}  // namespace bp
