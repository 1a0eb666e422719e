#pragma once
#include <optional>

#include "io/scene/detail/ahead/obj_blocks.h"
#include "io/scene/detail/text/text_scanner.h"
#include "io/scene/detail/vertex_pool.h"
#include "io/scene/scene_options.h"

namespace bp {

/// Consumes a line's keyword. Returns 'v', 'f', 'l', 'p', 'o' or 'g' for these words, 't' for "vt", 'n' for "vn", 's'
/// for those of adds_unread_surface(), '1' for is_glued(), 'u' for "usemtl" and 'm' for "mtllib", 0 for any other,
/// comments included.
[[nodiscard]] char obj_keyword(TextScanner& text);

/// A corner of a face as its line has it. Lines are counted from 0; kNone: the corner names none, or none further up.
struct ObjCorner {
  static constexpr std::uint64_t kNone = ~std::uint64_t(0);
  std::int64_t vertex = 0;  ///< as written
  std::uint64_t place = kNone, normal = kNone;
};
/// Reads a corner: "v", "v/vt", "v//vn" or "v/vt/vn". Only the vertex's number is required; other forms are noted.
/// `seen`: lines further up. Throws bad_input.
[[nodiscard]] ObjCorner read_obj_corner(TextScanner& text, const ObjLines& seen);

/// The vectors of the lines "v", "vt" and "vn". Each line is read once, however often the file is.
class ObjVectors {
 public:
  ObjVectors(const SceneFilePtr& file, const SceneOptions& options);

  VertexPool vertices;
  std::optional<VertexPool> colors;           ///< if asked for; up to the last vertex that has one
  std::optional<VertexPool> places, normals;  ///< if asked for
  bool has_colors = false;                    ///< a vertex has one
  bool all_loaded = false;                    ///< `vertices` holds every vertex of the file

  /// Returns the lines of this pass so far.
  [[nodiscard]] const ObjLines& seen() const { return seen_; }
  void rewind() { seen_ = {}; }
  /// Reads a line of the keyword 'v', 't' or 'n', if no pass before has.
  void read(char key, TextScanner& text);
  /// Returns the vertex of this number, counted from 1 or backwards; ObjCorner::kNone if there can be none. A face that
  /// names a later vertex makes all other vertices load at once. `text`: stands in the line of the face.
  [[nodiscard]] std::uint64_t vertex_of(std::int64_t number, TextScanner& text);

 private:
  void read_vertex(TextScanner& text);
  void read_vertex_rest(TextScanner& text);
  void load_ahead(const TextScanner& text);

  SceneFilePtr file_;
  ObjLines seen_;
};

}  // namespace bp
