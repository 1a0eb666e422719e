#pragma once
#include <string>
#include <vector>

/// What robot simulators read of a set of hulls: text that names the files of the hulls, which lie beside it.
namespace bp {

/// A model of MuJoCo (MJCF) with one body that has a geom for each file. It loads by itself, and through <include>.
[[nodiscard]] std::string mjcf_text(const std::string& name, const std::vector<std::string>& files);

/// A URDF with one link that has a collision element for each file.
[[nodiscard]] std::string urdf_text(const std::string& name, const std::vector<std::string>& files);

}  // namespace bp
