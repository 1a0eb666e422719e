#pragma once
#include <string>
#include <vector>

#include "lib/core/triangle_source.h"
#include "tools/cli/progress.h"

namespace bp {

/// Counts the triangles that pass through.
class WatchedSource : public TriangleSource {
 public:
  WatchedSource(TriangleSource& source, Progress& progress) : source_(source), progress_(progress) {}
  bool read(std::vector<TriangleD>& out) override {
    const bool more = source_.read(out);
    progress_.add(out.size());
    return more;
  }
  bool read_faces(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                  std::vector<std::uint8_t>& inner_edges) override {
    const bool more = source_.read_faces(out, colors, inner_edges);
    progress_.add(out.size());
    return more;
  }
  void rewind() override { source_.rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return source_.counts(); }
  [[nodiscard]] std::optional<UpAxis> up() const override { return source_.up(); }
  [[nodiscard]] std::string name() const override { return source_.name(); }

 private:
  TriangleSource& source_;
  Progress& progress_;
};

}  // namespace bp
