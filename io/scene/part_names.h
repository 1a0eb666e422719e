#pragma once
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "io/files/name_pattern.h"
#include "lib/core/coords.h"

namespace bp {

/// Names of the parts of a scene, up to a limit: files may hold millions.
struct PartNames {
  static constexpr std::size_t kMostBytes = std::size_t(1) << 20;
  std::set<std::string> names;
  bool complete = true;
  /// Returns whether a triangle of the part of this name is asked for: parts that hold such a triangle are noted, by
  /// one name each, and are not asked about any more. Empty: all names are noted.
  std::function<bool(const std::string& name, const TriangleD&)> of_triangle;

  void add(const std::string& name) {
    if (name.empty() || names.contains(name)) return;
    complete = complete && bytes_ + name.size() + kOfEach <= kMostBytes;
    if (complete) names.insert(name), bytes_ += name.size() + kOfEach;
  }

 private:
  static constexpr std::size_t kOfEach = 64;
  std::size_t bytes_ = 0;
};

/// Tells whether names fit SceneOptions::parts, and notes all names.
class PartFilter {
 public:
  PartFilter(std::string pattern, std::shared_ptr<PartNames> met)
      : pattern_(std::move(pattern)), met_(std::move(met)) {}
  [[nodiscard]] bool takes_all() const { return pattern_.empty(); }
  [[nodiscard]] bool asks() const { return met_ != nullptr || !takes_all(); }
  [[nodiscard]] bool fits(const std::string& name) const {
    if (met_ && !asks_for_triangles()) met_->add(name);
    return fits_pattern(name, pattern_);
  }
  /// Returns whether PartNames::of_triangle is set: then the reader calls note() for each part and its triangles.
  [[nodiscard]] bool asks_for_triangles() const { return met_ != nullptr && met_->of_triangle != nullptr; }
  /// Notes the part of this name if the triangle is asked for; returns whether it is.
  bool note(const std::string& name, const TriangleD& triangle) const {
    const bool holds = met_->of_triangle(name, triangle);
    if (holds) met_->add(name);
    return holds;
  }

 private:
  std::string pattern_;
  std::shared_ptr<PartNames> met_;
};

}  // namespace bp
