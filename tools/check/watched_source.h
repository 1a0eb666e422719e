#pragma once
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/triangle_source.h"
#include "tools/cli/progress.h"

namespace bp {

/// Counts and measures the triangles that pass through.
class WatchedSource : public TriangleSource {
 public:
  WatchedSource(TriangleSource& source, Progress& progress) : source_(source), progress_(progress) {}
  bool read(std::vector<TriangleD>& out) override {
    const bool more = source_.read(out);
    watch(out);
    return more;
  }
  bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                  std::vector<std::uint8_t>& inner_edges) override {
    const bool more = source_.read_faces(out, colors, inner_edges);
    watch(out);
    return more;
  }
  void rewind() override { source_.rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return source_.counts(); }
  [[nodiscard]] std::optional<UpAxis> up() const override { return source_.up(); }
  [[nodiscard]] const Bounds3d& bounds_read() const { return bounds_; }  ///< of all triangles read so far
  [[nodiscard]] std::string name() const override { return source_.name(); }

 private:
  void watch(const std::vector<TriangleD>& triangles) {
    progress_.add(triangles.size());
    for (const TriangleD& t : triangles) {
      for (const Vec3d& p : t) bounds_.add(p);
    }
  }

  TriangleSource& source_;
  Progress& progress_;
  Bounds3d bounds_;
};

}  // namespace bp
