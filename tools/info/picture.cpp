#include "tools/info/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/image/label_font.h"
#include "io/image/png_writer.h"
#include "lib/core/error.h"
#include "lib/geometry/smooth_normals.h"
#include "lib/live/smooth_surface.h"
#include "tools/cli/common_options.h"
#include "tools/cli/names.h"
#include "tools/info/scale_colors.h"
#include "tools/notes/panel_label.h"

namespace bp {

namespace {

constexpr double kFarApart = 4;  // distance between inputs, over the size of the largest, from which they are far apart
// Largest size of an input's textures: the largest set of images that fits.
constexpr std::uint64_t kImageBytes = std::uint64_t(3) << 29;
constexpr std::size_t kEdges = 50000, kEdgesOfMany = 20000;  // more edges would only darken the picture

std::string shown_name(const std::string& in) {
  return in == "-" ? "stdin" : file_name(in);
}

Bounds3d bounds_of(const StreamHeader& header) {
  Bounds3d bounds;
  const VoxelBox box = voxels_of(header.bricks);
  const auto corner = [&](VoxelCoord v) {
    const std::int64_t unit = kLatticePerVoxel;
    return header.frame.world({v.x * unit, v.y * unit, v.z * unit});
  };
  bounds.add(corner(box.min));
  bounds.add(corner(box.max));
  return bounds;
}

void turn(std::vector<TriangleD>& triangles, UpAxis from, UpAxis to) {
  for (TriangleD& t : triangles) {
    for (Vec3d& p : t) p = turned(p, from, to);
  }
}

class TurnedSource final : public TriangleSource {
 public:
  TurnedSource(std::unique_ptr<TriangleSource> source, UpAxis from, UpAxis to)
      : source_(std::move(source)), from_(from), to_(to) {}
  bool read(std::vector<TriangleD>& out) override {
    const bool more = source_->read(out);
    turn(out, from_, to_);
    return more;
  }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) override {
    const bool more = source_->read_colored(out, colors);
    turn(out, from_, to_);
    return more;
  }
  bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                     std::vector<TriangleTexture>& textures) override {
    const bool more = source_->read_textured(out, colors, textures);
    turn(out, from_, to_);
    return more;
  }
  [[nodiscard]] bool has_colors() const override { return source_->has_colors(); }
  void rewind() override { source_->rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return source_->counts(); }
  [[nodiscard]] std::string name() const override { return source_->name(); }

 private:
  std::unique_ptr<TriangleSource> source_;
  UpAxis from_, to_;
};

void turn(Panel& panel, UpAxis from, UpAxis to) {
  turn(panel.triangles, from, to);
  for (auto& corners : panel.normals) {
    for (PackedNormal& n : corners) n = pack_normal(turned(unpack_normal(n), from, to));
  }
  Bounds3d bounds;
  if (!panel.bounds.empty()) {
    for (const Vec3d& p : {panel.bounds.min, panel.bounds.max}) bounds.add(turned(p, from, to));
  }
  panel.bounds = bounds;
  for (Vec3d& axis : panel.view.axes) axis = turned(axis, from, to);
  for (Mark& mark : panel.view.marks) mark.at = turned(mark.at, from, to);
  if (!panel.source) return;
  panel.source = std::make_unique<TurnedSource>(std::move(panel.source), from, to);
  panel.view.source = panel.source.get();
}

/// Returns true if the inputs are so far apart that hardly anything of them could be seen at one scale.
bool are_far_apart(const std::vector<std::unique_ptr<Panel>>& panels, const Bounds3d& all) {
  double largest = 0;
  for (const auto& panel : panels) {
    if (!panel->bounds.empty()) largest = std::max(largest, panel->bounds.diagonal());
  }
  return largest > 0 && all.diagonal() > kFarApart * largest;
}

}  // namespace

Picture::Picture(const PictureOptions& options) : o_(options) {
  if (!o_.image.file.empty()) file_ = open_output(o_.image.file, o_.overwrite);
}

void Picture::add_stream(const CoarseView& cells, const StreamHeader& header, const StreamTotals& totals,
                         const std::string& in) {
  const bool closing = header.has_closing;
  if (!closing || !o_.several) add_layer(Layer::solid, cells, header, totals, in);
  if (closing) add_layer(Layer::closing, cells, header, totals, in);
}

void Picture::add_layer(Layer layer, const CoarseView& cells, const StreamHeader& header, const StreamTotals& totals,
                        const std::string& in) {
  constexpr Color kColors[] = {{168, 182, 202}, {214, 178, 132}};
  const auto i = std::size_t(layer);
  auto panel = std::make_unique<Panel>();
  panel->input = in;
  panel->up = header.frame.up;
  SmoothSurface surface = smooth_surface(cells.cells(layer), cells.cell_voxels(), header.frame);
  panel->triangles = std::move(surface.triangles);
  panel->normals = std::move(surface.normals);
  panel->view.normals = panel->normals;
  panel->bounds = cells.bounds(layer, header.frame);
  if (totals.layers[0].bricks + totals.layers[1].bricks == 0) panel->bounds = bounds_of(header);
  panel->view.color = o_.several ? kColors[0] : kColors[i];
  panel->view.label =
      fmt::format("{}: {} voxels of {:.4g}", i == 0 ? "solid" : "closing", totals.layers[i].voxels, header.frame.voxel);
  if (cells.cell_voxels() > 1) panel->view.label += fmt::format("\ndrawn in cells of {} voxels", cells.cell_voxels());
  if ((header.has_closing || header.has_field) && !header.scale.constant() && !panel->triangles.empty()) {
    panel->view.bar = color_by_scale(header.scale, panel->triangles, panel->colors);
    panel->view.colors = panel->colors;
    panel->view.label += "\ncolours: the scale";
  }
  panels_.push_back(std::move(panel));
}

void Picture::add_mesh(MeshInfo& info, std::unique_ptr<TriangleSource> source, const std::string& in,
                       const std::string& which, std::shared_ptr<const TextureSet> textures) {
  auto panel = std::make_unique<Panel>();
  panel->input = in;
  panel->up = source->up();
  panel->bounds = info.totals.bounds;
  panel->view.label = fmt::format("{}{}{}", info.faces.text(), which.empty() ? "" : ", ", which);
  const bool textured = textures && source->has_textures();
  if (textured) panel->images = std::make_unique<ImageCache>(std::move(textures), MemoryShare{kImageBytes});
  if (!textured && info.triangles.size() == info.totals.triangles) {
    panel->triangles = std::move(info.triangles);
    panel->colors = std::move(info.colors);
    panel->view.colors = panel->colors;
    panel->inner_edges = std::move(info.inner_edges);
    panel->view.inner_edges = panel->inner_edges;
    panel->view.edges = panel->triangles.size() <= (o_.several ? kEdgesOfMany : kEdges);
    if (o_.several && panel->view.edges) panel->view.color = {238, 192, 130};
    if (!panel->view.edges) panel->normals = smooth_normals(panel->triangles);  // with edges, faces shall be seen
    panel->view.normals = panel->normals;
  } else {
    panel->source = std::move(source);
    panel->view.source_colors = panel->source->has_colors();
    panel->view.source_images = panel->images.get();
    panel->view.source = panel->source.get();
  }
  panels_.push_back(std::move(panel));
}

void Picture::point_at(std::vector<Mark> marks, double azimuth, double elevation, const std::string& text) {
  View& view = panels_.back()->view;
  view.marks = std::move(marks);
  view.label += "\n" + text;
  if (!o_.image.view_given) o_.image.azimuth = azimuth, o_.image.elevation = elevation;
}

/// Returns the axis of --up, else that of the first input that tells one.
UpAxis Picture::common_up() const {
  if (o_.image.up) return *o_.image.up;
  for (const auto& panel : panels_) {
    if (panel->up) return *panel->up;
  }
  return UpAxis::y;
}

std::string Picture::note_on_axes() const {
  std::string names;
  const Panel* last = nullptr;
  for (const auto& panel : panels_) {
    if (!o_.image.up || panel->up.value_or(*o_.image.up) == *o_.image.up) continue;
    if (last == nullptr || last->input != panel->input) names += (last ? ", " : "") + shown_name(panel->input);
    last = panel.get();
  }
  if (last == nullptr) return "";
  return fmt::format(
      "{}: drawn with {} up, as the file itself says; --up is for inputs that do not tell. If the file is wrong, make "
      "it "
      "again from the scene with --up {}",
      names, name_of(*last->up), name_of(*o_.image.up));
}

/// Labels each panel with its name, what is drawn, and the bounds in the input's own axes.
void Picture::label_panels() {
  std::vector<std::string> inputs;
  for (const auto& panel : panels_) inputs.push_back(panel->input);
  const std::vector<std::string> names = panel_names(inputs);
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    std::string& label = panels_[i]->view.label;
    label.insert(0, names[i] + "\n");
    if (const std::string bounds = bounds_text(panels_[i]->bounds); !bounds.empty()) label += "\n" + bounds;
  }
}

/// Turns the panels to common axes; returns the bounds of all.
Bounds3d Picture::place_panels(RenderOptions& options) {
  if (options.look_at && panels_[0]->up.value_or(options.up) != options.up)
    // It was given in the axes of the first input.
    options.look_at = turned(*options.look_at, *panels_[0]->up, options.up);
  Bounds3d all;
  bool streamed = false;  // then the bounds suffice: a streamed mesh is not read once more
  for (const auto& panel : panels_) {
    if (panel->up && *panel->up != options.up) turn(*panel, *panel->up, options.up);
    panel->view.triangles = panel->triangles;
    all.merge(panel->bounds);
    streamed = streamed || panel->source != nullptr;
  }
  if (streamed) options.bounds = all;
  return all;
}

void Picture::pick(const std::vector<View>& views, const RenderOptions& options) {
  const auto [x, y] = *o_.image.pick;
  std::optional<Vec3d> point = point_behind(views, options, x, y);
  if (!point) fail(ErrorCode::bad_argument, "--pick {},{}: nothing is drawn at this pixel", x, y);
  const Panel& panel = *panels_[std::size_t(x / options.panel_width)];
  if (panel.up) point = turned(*point, options.up, *panel.up);
  const double pixel = panel.bounds.diagonal() / options.panel_width / options.zoom;
  const int digits = std::clamp(int(std::ceil(1 - std::log10(pixel))), 0, 17);
  picked_ = fmt::format("{:.{}f},{:.{}f},{:.{}f}", (*point)[0] + 0.0, digits, (*point)[1] + 0.0, digits,
                        (*point)[2] + 0.0, digits);
}

std::vector<std::string> Picture::write() {
  label_panels();
  RenderOptions options = o_.image.render_options(common_up());
  const Bounds3d all = place_panels(options);
  std::vector<std::string> notes;
  if (std::string note = note_on_axes(); !note.empty()) notes.push_back(std::move(note));
  if (!options.look_at && are_far_apart(panels_, all)) {
    for (const auto& panel : panels_) {
      panel->view.bounds = panel->bounds;
      panel->view.label += "\ndrawn by itself";
    }
    notes.emplace_back(
        "the inputs lie far apart: each is drawn by itself, not at one scale. The place of a tile's content is in "
        "tileset.json");
  }
  const auto typeface = open_label_font();
  options.typeface = typeface.get();
  if (std::string note = note_on_font(typeface.get()); !note.empty()) notes.push_back(std::move(note));
  std::vector<View> views;
  for (const auto& panel : panels_) views.push_back(panel->view);
  if (o_.image.pick) pick(views, options);
  if (!file_) return notes;
  file_->write(encode_png(render(views, options)));
  for (const auto& panel : panels_) {
    if (!panel->images) continue;
    for (const std::string& fault : panel->images->faults())
      notes.push_back(fault + "; its material's colour is drawn");
  }
  file_->commit();
  return notes;
}

}  // namespace bp
