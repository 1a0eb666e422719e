#pragma once
#include <sstream>
#include <string>
#include <vector>

#include "io/scene/detail/vertex_pool.h"
#include "io/scene/part_names.h"
#include "io/scene/scene_options.h"

namespace bp {

/// The names that the next faces have, by the lines "o", "g" and "usemtl", and whether they fit the parts asked for.
class ObjParts {
 public:
  explicit ObjParts(const SceneOptions& options) : filter_(options.parts, options.part_names) {}
  [[nodiscard]] const PartFilter& filter() const { return filter_; }
  [[nodiscard]] bool is_wanted() const { return filter_.takes_all() || object_fits_ || group_fits_ || material_fits_; }
  void rewind() { *this = ObjParts(std::move(filter_)); }

  /// Takes the name of a line "o", "g", or 'u' for "usemtl". A line "g" may name several groups.
  void use(char key, const std::string& name) {
    if (key == 'o') object_fits_ = filter_.fits(name);
    if (key == 'u') material_fits_ = filter_.fits(name);
    (key == 'u' ? material_ : part_) = name;
    if (key != 'g') return;
    group_fits_ = filter_.fits(name);
    std::istringstream words(name);
    for (std::string word; words >> word;) group_fits_ = filter_.fits(word) || group_fits_;
  }

  /// Notes the part of a face: named by its group or object, else by its material.
  void note(const std::vector<std::uint64_t>& corners, VertexPool& vertices) const {
    for (const std::uint64_t corner : corners) {
      if (corner >= vertices.size()) return;
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      if (filter_.note(part_.empty() ? material_ : part_,
                       {vertices[corners[0]], vertices[corners[k - 1]], vertices[corners[k]]}))
        return;
    }
  }

 private:
  explicit ObjParts(PartFilter filter) : filter_(std::move(filter)) {}

  PartFilter filter_;
  bool object_fits_ = false, group_fits_ = false, material_fits_ = false;
  std::string part_, material_;  // part: name of the last line "o" or "g", of which a group in an object tells more
};

}  // namespace bp
