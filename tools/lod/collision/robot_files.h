#pragma once
#include <string>
#include <vector>

/// Makes the models of robot simulators for a set of hulls: texts that name the hulls' files, which lie in the same
/// folder.
namespace bp {

/// Returns a MuJoCo model (MJCF) with one body that has a geom for each file. It can be loaded alone and through
/// <include>.
[[nodiscard]] std::string mjcf_text(const std::string& name, const std::vector<std::string>& files);

/// Returns a URDF with one link that has a collision element for each file.
[[nodiscard]] std::string urdf_text(const std::string& name, const std::vector<std::string>& files);

}  // namespace bp
