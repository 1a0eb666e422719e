#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/stream/brick_stream.h"
#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"
#include "lib/image/render.h"
#include "lib/volume/coarse_view.h"
#include "tools/info/image_options.h"
#include "tools/info/mesh_info.h"

/// The PNG of bpinfo --image.
namespace bp {

struct PictureOptions {
  ImageOptions image;
  bool overwrite = false;
  bool several = false;  ///< several inputs
};

/// A panel, and what it draws.
struct Panel {
  std::string input;
  std::vector<TriangleD> triangles;
  std::vector<std::array<PackedNormal, 3>> normals;
  std::vector<TriangleColors> colors;
  std::vector<std::uint8_t> inner_edges;
  std::unique_ptr<TriangleSource> source;  ///< for a mesh too large to keep, or with textures
  std::unique_ptr<ImageCache> images;
  Bounds3d bounds;
  std::optional<UpAxis> up;  ///< if the input tells
  View view;
};

/// A picture of panels from left to right, at one scale; each with its own axis up.
class Picture {
 public:
  /// Opens the file, so that a name that cannot be written fails before the work.
  explicit Picture(const PictureOptions& options);
  [[nodiscard]] bool wanted() const { return file_ != nullptr || o_.image.pick; }

  /// Adds the layers of a stream; with several inputs only the last layer.
  void add_stream(const CoarseView& cells, const StreamHeader& header, const StreamTotals& totals,
                  const std::string& in);
  /// Adds a mesh. `info`: facts about `source`; its triangles are taken. `which`: which of the source's levels it is;
  /// empty if there is one level. `textures`: images that the source may show; null: none.
  void add_mesh(MeshInfo& info, std::unique_ptr<TriangleSource> source, const std::string& in, const std::string& which,
                std::shared_ptr<const TextureSet> textures = nullptr);
  /// Points at places of the last input, from this direction unless the user chose one. `text`: lines for its label.
  void point_at(std::vector<Mark> marks, double azimuth, double elevation, const std::string& text);
  /// Writes the picture; returns notes for the user.
  [[nodiscard]] std::vector<std::string> write();
  /// Returns the point of ImageOptions::pick as "X,Y,Z", in the axes of the input that is seen there. To be called
  /// after write(). Throws bad_argument if nothing is seen there.
  [[nodiscard]] std::string picked() const { return picked_; }

 private:
  void add_layer(Layer layer, const CoarseView& cells, const StreamHeader& header, const StreamTotals& totals,
                 const std::string& in);
  [[nodiscard]] UpAxis common_up() const;
  [[nodiscard]] std::string note_on_axes() const;
  void label_panels();
  Bounds3d place_panels(RenderOptions& options);

  void pick(const std::vector<View>& views, const RenderOptions& options);

  PictureOptions o_;
  std::string picked_;
  std::unique_ptr<OutputFile> file_;
  std::vector<std::unique_ptr<Panel>> panels_;
};

}  // namespace bp
