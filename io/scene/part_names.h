#pragma once
#include <memory>
#include <set>
#include <string>

#include "io/scene/name_pattern.h"

namespace bp {

/// Names of the parts of a scene, without those that would make it too much: files may hold millions.
struct PartNames {
  static constexpr std::size_t kMostBytes = std::size_t(1) << 20;
  std::set<std::string> names;
  bool complete = true;

  void add(const std::string& name) {
    if (name.empty() || names.contains(name)) return;
    complete = complete && bytes_ + name.size() + kOfEach <= kMostBytes;
    if (complete) names.insert(name), bytes_ += name.size() + kOfEach;
  }

 private:
  static constexpr std::size_t kOfEach = 64;
  std::size_t bytes_ = 0;
};

/// Asks whether names fit SceneOptions::parts, and notes all of them.
class PartFilter {
 public:
  PartFilter(std::string pattern, std::shared_ptr<PartNames> met)
      : pattern_(std::move(pattern)), met_(std::move(met)) {}
  [[nodiscard]] bool takes_all() const { return pattern_.empty(); }
  [[nodiscard]] bool asks() const { return met_ != nullptr || !takes_all(); }
  [[nodiscard]] bool fits(const std::string& name) const {
    if (met_) met_->add(name);
    return fits_pattern(name, pattern_);
  }

 private:
  std::string pattern_;
  std::shared_ptr<PartNames> met_;
};

}  // namespace bp
