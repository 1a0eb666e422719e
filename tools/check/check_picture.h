#pragma once
#include <string>
#include <vector>

#include "lib/check/check_report.h"
#include "lib/core/indexed_mesh.h"
#include "lib/image/render.h"
#include "tools/cli/image_options.h"

/// The picture of bpcheck --image.
namespace bp {

struct CheckedFiles {
  std::vector<std::string> files;  ///< scenes, then the proxy
  const std::vector<IndexedMesh>& levels;
  const std::vector<CheckReport>& verdicts;  ///< one for each level
  TriangleSource* scene = nullptr;           ///< null: none
  Bounds3d scene_bounds;
};

/// The scene, then each level of the proxy; the scene is read twice. typeface: null draws no labels.
[[nodiscard]] Image draw_checked(const CheckedFiles& checked, const ImageOptions& image, Typeface* typeface);

}  // namespace bp
