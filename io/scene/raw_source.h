#pragma once
#include "io/scene/affine.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_options.h"
#include "lib/core/indexed_mesh.h"
#include "lib/core/triangle_source.h"
#include "lib/exact/polygon_cut.h"

/// The interface of every format's reader: triangles as they are in the file; only faces without existing corners are
/// dropped.
namespace bp {

/// Where a mesh stands.
struct MeshPlace {
  Affine transform;
  bool mirrors = false, stays = true;  ///< the transform turns its outside in; it moves nothing
};

/// Triangles [first, end) of a primitive of an InstancedScene, in one place.
struct PlacedRun {
  std::uint32_t primitive = 0;
  std::shared_ptr<const MeshPlace> place;
  std::uint64_t first = 0, end = 0;
};

/// A batch of triangles being read from a file.
struct RawBatch {
  bool colored = false, textured = false;  ///< what is asked for; textures only together with colours
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;     ///< if asked for; if there are fewer than triangles, all are white
  std::vector<TriangleTexture> textures;  ///< if asked for; if there are fewer than triangles, the others have none
  /// TriangleSource::read_faces(); if there are fewer than triangles, the others have none.
  std::vector<std::uint8_t> inner_edges;
  std::vector<std::byte> bytes;          ///< complete() makes triangles of them
  std::vector<std::byte> vertices;       ///< buffer of complete(), kept for later batches
  std::vector<PlacedRun> runs;           ///< complete() makes triangles of them
  std::uint64_t records = 0, count = 0;  ///< faces in `bytes`, and their triangles if all faces are good
  std::uint64_t bad_faces = 0;           ///< found by complete()
};

/// Content of a file that may change what a viewer shows and that no reader here follows; a line each.
struct UnreadParts {
  std::vector<std::string> moves;        ///< may move or hide its triangles, or replace them
  std::vector<std::string> see_through;  ///< may make its triangles transparent
  bool has_holes = false;                ///< images may cut holes into its triangles
};

class RawSource {
 public:
  static constexpr std::size_t kBatch = 1 << 14;  ///< triangles per read(), about

  virtual ~RawSource() = default;
  /// Replaces `out` by the next triangles; returns false, and `out` empty, at the end.
  virtual bool read(std::vector<TriangleD>& out) = 0;
  /// As TriangleSource::read_colored() and has_colors().
  virtual bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) {
    const bool more = read(out);
    colors.assign(out.size(), TriangleColors{});
    return more;
  }
  [[nodiscard]] virtual bool has_colors() const { return false; }
  [[nodiscard]] virtual bool has_textures() const { return false; }
  /// Reads in two steps, so that many batches are decoded at once: next() fetches a batch, in order, on one thread at a
  /// time; complete() makes its triangles, on any thread. A batch may turn out to hold no triangle.
  virtual bool next(RawBatch& batch) {
    batch.bad_faces = 0;
    return batch.colored ? read_colored(batch.triangles, batch.colors) : read(batch.triangles);
  }
  virtual void complete(RawBatch&) const {}
  virtual void rewind() = 0;
  [[nodiscard]] virtual std::optional<Bounds3d> bounds() { return {}; }  ///< TriangleSource::bounds()
  [[nodiscard]] virtual std::uint64_t instances() const { return 1; }
  [[nodiscard]] virtual std::optional<UpAxis> up() const { return {}; }  ///< TriangleSource::up()
  [[nodiscard]] virtual std::size_t animations() const { return 0; }     ///< SceneCounts::animations
  [[nodiscard]] virtual std::uint64_t posed() const { return 0; }        ///< SceneCounts::posed
  [[nodiscard]] virtual std::uint64_t differing() const { return 0; }    ///< SceneCounts::differing
  [[nodiscard]] virtual Unfollowed unfollowed() const { return {}; }     ///< SceneCounts::unfollowed
  [[nodiscard]] virtual UnreadParts unread() const { return {}; }        ///< contents of tiles only
  /// SceneCounts::rounding of the triangles read so far.
  [[nodiscard]] virtual Rounding rounding() const { return {}; }
  /// Levels of the file: SceneOptions::level is one of them.
  [[nodiscard]] virtual std::size_t levels() const { return 1; }
  [[nodiscard]] virtual std::uint64_t points() const { return 0; }  ///< vertices read so far, where they are counted
  [[nodiscard]] virtual std::uint64_t lines() const { return 0; }   ///< elements met, where they are counted
  [[nodiscard]] std::uint64_t bad_faces() const {
    return bad_faces_;
  }  ///< since the last rewind, without those of complete()

 protected:
  std::uint64_t bad_faces_ = 0;
};
using RawSourcePtr = std::unique_ptr<RawSource>;

/// Base of formats that are read in two steps, next() and complete().
class TwoStepSource : public RawSource {
 public:
  bool read(std::vector<TriangleD>& out) final { return read_one(out, false); }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) final {
    const bool more = read_one(out, true);
    colors.swap(one_.colors);
    colors.resize(out.size());
    return more;
  }

 private:
  bool read_one(std::vector<TriangleD>& out, bool colored) {
    bool more;
    one_.colored = colored;
    do {  // a batch may hold bad faces only
      more = next(one_);
      complete(one_);
      bad_faces_ += one_.bad_faces;
      out.swap(one_.triangles);
    } while (more && out.empty());
    return more;
  }

  RawBatch one_;
};

/// Cuts a polygon into triangles, by the positions of its corners or by their number alone. Holds the polygon that was
/// cut last.
class FaceTriangles {
 public:
  /// fans: as SceneOptions::fans.
  explicit FaceTriangles(bool fans) : fans_(fans), places_(4) {}

  /// Cuts a polygon of n corners, at least 3. place(k): position of corner k.
  template <class Place>
  void cut(std::size_t n, const Place& place) {
    corners_ = n;
    triangles_ = {};
    held_ = n > 3 && n <= PolygonCutter::kMostCorners && !fans_;
    if (!held_) return;
    if (n == 4) {  // most polygons
      const Vec3d a = place(0), b = place(1), c = place(2), d = place(3);
      places_[0] = a, places_[1] = b, places_[2] = c, places_[3] = d;
      if (is_surely_fan(a, b, c, d)) return;
    } else {
      if (n > places_.size()) places_.resize(n);
      for (std::size_t k = 0; k < n; ++k) places_[k] = place(k);
    }
    triangles_ = cutter_.cut(std::span(places_).first(n));
  }
  [[nodiscard]] std::size_t triangles() const { return corners_ - 2; }
  [[nodiscard]] CutTriangle operator[](std::size_t i) const {
    return triangles_.empty() ? fan_triangle(i) : triangles_[i];
  }
  /// Returns the bits of triangle i for TriangleSource::read_faces().
  [[nodiscard]] std::uint8_t inner_edges(std::size_t i) const {
    const bool first = i == 0, last = i + 3 == corners_;
    const int bits = (first ? 0 : kSamePolygonBefore) | (last ? 0 : kSamePolygonAfter);
    if (triangles_.empty()) return std::uint8_t(bits | (first ? 0 : 1) | (last ? 0 : 4));
    const auto [a, b, c] = triangles_[i];
    return std::uint8_t(bits | (follows(a, b) ? 0 : 1) | (follows(b, c) ? 0 : 2) | (follows(c, a) ? 0 : 4));
  }
  /// Returns a triangle's corners. place: as in cut(), for corners that are not kept here.
  template <class Place>
  [[nodiscard]] TriangleD places(const CutTriangle& t, const Place& place) const {
    if (!held_) return {place(t[0]), place(t[1]), place(t[2])};
    return {places_[t[0]], places_[t[1]], places_[t[2]]};
  }

 private:
  [[nodiscard]] bool follows(std::uint32_t a, std::uint32_t b) const { return b == (a + 1 == corners_ ? 0 : a + 1); }

  const bool fans_;
  PolygonCutter cutter_;
  std::size_t corners_ = 2;
  bool held_ = false;                       // places_ are those of the polygon
  std::vector<Vec3d> places_;               // at least one for each corner
  std::span<const CutTriangle> triangles_;  // empty: the fan
};

/// Base of formats whose faces are lists of vertex numbers. A format gives faces and vertices; they are checked and cut
/// here.
class PolygonSource : public RawSource {
 public:
  /// Most corners of a face; a file with more is considered broken.
  static constexpr std::size_t kMaxCorners = std::size_t(1) << 20;

  explicit PolygonSource(const SceneOptions& options) : cut_(options.fans) {}

  bool read(std::vector<TriangleD>& out) final { return read(out, nullptr, nullptr); }
  bool read_colored(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors) final {
    return read(out, &colors, nullptr);
  }
  bool next(RawBatch& batch) override;
  void rewind() final;
  [[nodiscard]] std::uint64_t points() const final { return vertex_count(); }

 protected:
  static constexpr std::uint64_t kNoVertex = ~std::uint64_t(0);

  /// Replaces `corners` by those of the next face (kNoVertex for one that cannot exist); returns false at the end.
  virtual bool next_face(std::vector<std::uint64_t>& corners) = 0;
  [[nodiscard]] virtual std::uint64_t vertex_count() const = 0;
  [[nodiscard]] virtual Vec3d vertex(std::uint64_t i) = 0;
  /// Returns the colour of a corner of the last face.
  [[nodiscard]] virtual LinearColor corner_color(std::uint64_t) { return kWhite; }
  /// Return the material of the last face, and the texture coordinates of its corner k.
  [[nodiscard]] virtual std::uint32_t face_material() const { return TriangleTexture::kNoMaterial; }
  [[nodiscard]] virtual std::array<float, 2> corner_uv(std::size_t) { return {}; }
  /// Returns the normal of that corner, if SceneOptions::surface asked for normals.
  [[nodiscard]] virtual PackedNormal corner_normal(std::size_t) { return 0; }
  virtual void rewind_faces() = 0;

 private:
  /// Reads triangles. `rest`: gets textures, if it asks for them, and inner edges.
  bool read(std::vector<TriangleD>& out, std::vector<TriangleColors>* colors, RawBatch* rest);
  bool open_face();
  void add_rest(RawBatch& rest, std::size_t triangle, const CutTriangle& corners);
  [[nodiscard]] bool good_face() const;

  std::vector<std::uint64_t> corners_;
  FaceTriangles cut_;
  std::size_t next_ = 0, end_ = 0;  // range of the open face's triangles
};

/// Filters a source as open_scene() does.
[[nodiscard]] std::unique_ptr<TriangleSource> filtered(std::string name, RawSourcePtr raw, const SceneOptions& options);

/// Sets tiny coordinates and negative zeros to 0, as the other parts of the suite want them (scene_reader.h).
void normalize(TriangleD& t);
/// Sets only negative zeros to 0: nothing moves.
void drop_signs_of_zeros(TriangleD& t);
[[nodiscard]] bool is_finite(const TriangleD& t);

/// Reads a mesh as read_mesh(), from an open source.
[[nodiscard]] IndexedMesh mesh_of(const std::string& name, RawSource& raw, const SceneOptions& options,
                                  SceneCounts& counts);

/// Throws out_of_resource, with the figure, if `what` of a file takes more than `left` bytes: the part of
/// SceneOptions::document that is still free. `later`: bytes that will be taken in addition; the limit in the error has
/// room for them.
void check_document(const SceneOptions& options, const std::string& name, const char* what, std::uint64_t bytes,
                    std::uint64_t left, std::uint64_t later = 0);

/// Returns options that leave next to no memory for a description: opening then refuses before it takes any, and names
/// the limit of this description alone. Used to ask files how much they take.
[[nodiscard]] SceneOptions without_memory(SceneOptions options);

/// Returns the directory of scratch files.
[[nodiscard]] std::string temp_dir_of(const SceneOptions& options);

[[nodiscard]] RawSourcePtr open_ply(SceneFilePtr file, const SceneOptions& options);
[[nodiscard]] RawSourcePtr open_stl(SceneFilePtr file, const SceneOptions& options);
[[nodiscard]] RawSourcePtr open_obj(SceneFilePtr file, const SceneOptions& options);
[[nodiscard]] RawSourcePtr open_off(SceneFilePtr file, const SceneOptions& options);

/// The place of a tile's content, and the axis that is up in it.
struct ContentPlace {
  Affine tile;
  UpAxis up = UpAxis::y;
};
/// Opens a glTF. With `place`, extras.up is ignored.
[[nodiscard]] RawSourcePtr open_gltf(SceneFilePtr file, const SceneOptions& options,
                                     const std::optional<ContentPlace>& place = {});
/// Opens a tileset of 3D Tiles. Reads every tile with refine=ADD, and of REPLACE tiles only those without tiles below.
/// If the tileset was made with `--leaves`, it reads the leaf contents only. z is up, as in 3D Tiles, or the axis that
/// a tileset of this suite tells. One content is open at a time. Throws bad_input if contents are missing, or if
/// tilesets name each other in a ring.
[[nodiscard]] RawSourcePtr open_tileset(SceneFilePtr file, const SceneOptions& options);
/// Opens any other format; `extension` (lower case) tells which.
[[nodiscard]] RawSourcePtr open_with_assimp(SceneFilePtr file, const std::string& extension,
                                            const SceneOptions& options);
[[nodiscard]] bool assimp_reads(const std::string& extension);

}  // namespace bp
