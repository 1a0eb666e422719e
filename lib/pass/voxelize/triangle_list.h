#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/triangle_source.h"

namespace bp {

/// Reads triangles that lie in memory. They must outlive it.
class TriangleList final : public TriangleSource {
 public:
  TriangleList(std::string name, std::span<const TriangleD> triangles, const Rounding& rounding = {})
      : name_(std::move(name)), triangles_(triangles) {
    counts_.rounding = rounding;
  }
  bool read(std::vector<TriangleD>& out) override {
    constexpr std::size_t kAtOnce = 16384;
    const auto some = triangles_.subspan(counts_.triangles)
                          .first(std::min(kAtOnce, triangles_.size() - std::size_t(counts_.triangles)));
    out.assign(some.begin(), some.end());
    counts_.triangles += some.size();
    return !out.empty();
  }
  void rewind() override { counts_.triangles = 0; }
  [[nodiscard]] const SceneCounts& counts() const override { return counts_; }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::string name_;
  std::span<const TriangleD> triangles_;
  SceneCounts counts_;
};

}  // namespace bp
