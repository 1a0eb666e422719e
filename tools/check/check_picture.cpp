#include "tools/check/check_picture.h"

#include <fmt/format.h>

#include "tools/notes/panel_label.h"

namespace bp {

namespace {

Bounds3d bounds_of(const IndexedMesh& mesh) {
  Bounds3d bounds;
  for (const Vec3d& p : mesh.vertices) bounds.add(p);
  return bounds;
}

View scene_view(const CheckedFiles& checked, const std::string& name) {
  View view;
  view.source = checked.scene;
  const std::size_t scenes = checked.files.size() - 1;
  view.label = fmt::format("{}{}\n{} triangles\n{}", name, scenes > 1 ? fmt::format(" and {} more", scenes - 1) : "",
                           checked.verdicts[0].scene_triangles, bounds_text(checked.scene_bounds));
  return view;
}

View level_view(const CheckedFiles& checked, std::size_t level, const std::string& name) {
  View view;
  view.mesh = &checked.levels[level];
  view.edges = true;
  view.color = {238, 192, 130};
  const CheckReport& verdict = checked.verdicts[level];
  view.label =
      fmt::format("{}{}\n{}, {}\n{}", name, checked.levels.size() > 1 ? fmt::format(" level {}", level) : "",
                  verdict.faces.text(), to_string(verdict.answer()), bounds_text(bounds_of(checked.levels[level])));
  return view;
}

/// What --up says, else the proxy, else the scene.
UpAxis up_of(const CheckedFiles& checked, const ImageOptions& image) {
  if (image.up) return *image.up;
  if (checked.levels[0].up) return *checked.levels[0].up;
  return checked.scene != nullptr ? checked.scene->up().value_or(UpAxis::y) : UpAxis::y;
}

}  // namespace

Image draw_checked(const CheckedFiles& checked, const ImageOptions& image, Typeface* typeface) {
  const std::vector<std::string> names = panel_names(checked.files);
  std::vector<View> views;
  if (checked.scene != nullptr) views.push_back(scene_view(checked, names.front()));
  for (std::size_t i = 0; i < checked.levels.size(); ++i) views.push_back(level_view(checked, i, names.back()));
  RenderOptions options = image.render_options(up_of(checked, image));
  options.typeface = typeface;
  return render(views, options);
}

}  // namespace bp
