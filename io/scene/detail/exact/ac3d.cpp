#include <charconv>
#include <sstream>

#include "io/scene/detail/exact/exact_scene.h"

// AC3D (Inivis, "The AC3D file format"): lines of words. The corners of an object are those of its surfaces, sorted by
// material, with its `loc` added; `loc` of a group moves its kids.

namespace bp {

namespace {

struct Surface {
  std::uint64_t material = 0, type = 0;
  std::vector<std::uint64_t> corners;
};

struct Ac3dObject {
  bool is_group = false;
  Vec3d loc{};
  std::vector<double> rot{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<Vec3d> vertices;
  std::vector<Surface> surfaces;
  std::vector<Ac3dObject> kids;
};

/// Thrown where the text is anything else.
struct NotUnderstood {};

class Ac3dText {
 public:
  explicit Ac3dText(std::string_view text) : text_(text) {}

  std::vector<Ac3dObject> objects() {
    std::vector<Ac3dObject> all;
    next_line();
    while (next_line()) {
      if (word() == "MATERIAL") ++materials_;
      if (word() == "OBJECT") all.push_back(object(0));
    }
    return all;
  }
  [[nodiscard]] std::uint64_t materials() const { return std::max<std::uint64_t>(materials_, 1); }
  /// Returns whether Assimp computes vertices of some objects, which are not known here.
  [[nodiscard]] bool has_subdivision() const { return has_subdivision_; }
  /// Returns the number of lists that Assimp silently reads in another way. For Assimp, a vertex line that begins with
  /// neither a digit nor a sign, such as ".5 0 0", ends the list, and the number of a missing vertex means the first
  /// vertex.
  [[nodiscard]] std::uint64_t unlike() const { return unlike_; }

 private:
  static constexpr int kMostNested = 1000;

  bool next_line() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = std::min(text_.find_first_not_of("\r\n", end), text_.size());
    line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
    return true;
  }
  [[nodiscard]] std::string_view word() const { return line_.substr(0, line_.find_first_of(" \t")); }
  [[nodiscard]] std::string_view rest() const {
    return word().size() == line_.size() ? std::string_view() : line_.substr(word().size() + 1);
  }
  [[nodiscard]] std::vector<double> numbers(std::string_view from, std::size_t n) const {
    std::vector<double> found = numbers_in(from);
    if (found.size() < n) throw NotUnderstood();
    found.resize(n);
    return found;
  }
  /// Reads the number of entries that follow, each on a line of at least two characters.
  [[nodiscard]] std::uint64_t count() const {
    const std::uint64_t n = integer(rest());
    if (n > text_.size()) throw NotUnderstood();
    return n;
  }
  [[nodiscard]] static std::uint64_t integer(std::string_view from) {
    std::uint64_t value = 0;
    const bool hex = from.starts_with("0x") || from.starts_with("0X");
    if (hex) from.remove_prefix(2);
    if (std::from_chars(from.data(), from.data() + from.size(), value, hex ? 16 : 10).ec != std::errc())
      throw NotUnderstood();
    return value;
  }

  Ac3dObject object(int depth);
  void add_vertices(Ac3dObject& object);
  void add_surfaces(Ac3dObject& object);

  std::string_view text_, line_;
  std::size_t at_ = 0;
  std::uint64_t materials_ = 0, unlike_ = 0;
  bool has_subdivision_ = false;
};

void Ac3dText::add_vertices(Ac3dObject& object) {
  bool cut = false;
  for (std::uint64_t n = count(); n > 0; --n) {
    if (!next_line()) throw NotUnderstood();
    const std::vector<double> p = numbers(line_, 3);
    object.vertices.push_back({p[0], p[1], p[2]});
    cut = cut || std::string_view("0123456789+-").find(line_[0]) == std::string_view::npos;
  }
  unlike_ += cut ? 1 : 0;
}

void Ac3dText::add_surfaces(Ac3dObject& object) {
  bool missing = false;
  for (std::uint64_t n = count(); n > 0; --n) {
    if (!next_line() || word() != "SURF") throw NotUnderstood();
    Surface& surface = object.surfaces.emplace_back();
    surface.type = integer(rest()) & 0xF;
    while (next_line() && word() == "mat") surface.material = integer(rest());
    if (word() != "refs") throw NotUnderstood();
    for (std::uint64_t k = count(); k > 0; --k) {
      if (!next_line()) throw NotUnderstood();
      const std::uint64_t corner = integer(word());
      missing = missing || corner >= object.vertices.size();
      surface.corners.push_back(corner < object.vertices.size() ? corner : 0);
    }
  }
  if (missing && object.vertices.empty()) throw NotUnderstood();
  unlike_ += missing ? 1 : 0;
}

Ac3dObject Ac3dText::object(int depth) {
  if (depth == kMostNested) throw NotUnderstood();
  Ac3dObject object;
  object.is_group = rest().starts_with("group");
  while (next_line()) {
    if (word() == "loc") {
      const std::vector<double> p = numbers(rest(), 3);
      object.loc = {p[0], p[1], p[2]};
    } else if (word() == "rot") {
      object.rot = numbers(rest(), 9);
    } else if (word() == "subdiv" && integer(rest()) > 0) {
      has_subdivision_ = true;
    } else if (word() == "numvert") {
      add_vertices(object);
    } else if (word() == "numsurf") {
      add_surfaces(object);
    } else if (word() == "kids") {
      for (std::uint64_t n = count(); n > 0; --n) {
        const std::size_t here = at_;
        if (next_line() && word() == "OBJECT") {
          object.kids.push_back(this->object(depth + 1));
        } else {
          at_ = here;  // the file has fewer kids than it says
          break;
        }
      }
      return object;
    }
  }
  throw NotUnderstood();
}

/// The corners of one object in the order of Assimp's meshes: those of polygons, of each triangle of strips, of lines.
class Ac3dMeshes {
 public:
  Ac3dMeshes(ExactScene& scene, std::uint64_t materials) : scene_(scene), materials_(materials) {}

  ExactNode add(const Ac3dObject& object) {
    const bool has_corners = std::any_of(object.surfaces.begin(), object.surfaces.end(),
                                         [](const Surface& s) { return !s.corners.empty(); });
    ExactNode node;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) node.transform.m[i][j] = object.rot[3 * i + j];
      if (object.is_group || !has_corners) node.transform.m[i][3] = object.loc[i];
    }
    if (!object.vertices.empty() && !has_corners) scene_.meshes.push_back({"", object.vertices, 0});
    for (std::uint64_t m = 0; m < materials_ && !object.vertices.empty() && has_corners; ++m) add_mesh(object, m);
    for (const Ac3dObject& kid : object.kids) node.children.push_back(add(kid));
    return node;
  }

 private:
  void add_mesh(const Ac3dObject& object, std::uint64_t material) {
    ExactMesh mesh;
    bool used = false;
    for (const Surface& s : object.surfaces) {
      if (s.material != material) continue;
      used = true;
      add_corners(object, s, mesh);
    }
    if (used) scene_.meshes.push_back(std::move(mesh));
  }

  void add_corners(const Ac3dObject& object, const Surface& s, ExactMesh& mesh) {
    constexpr std::uint64_t kClosedLine = 1, kOpenLine = 2, kStrip = 4;
    const auto add = [&](std::uint64_t k) { add_corner(object.vertices[s.corners[k]], object.loc, mesh); };
    const std::size_t n = s.corners.size();
    if (s.type == kStrip) {
      for (std::size_t k = 2; k < n; ++k) {
        if (is_skipped(
                {object.vertices[s.corners[k - 2]], object.vertices[s.corners[k - 1]], object.vertices[s.corners[k]]}))
          continue;
        add(k % 2 == 0 ? k - 2 : k - 1);
        add(k % 2 == 0 ? k - 1 : k - 2);
        add(k);
      }
    } else if (s.type == kClosedLine || s.type == kOpenLine) {  // lines are no triangles, and are not moved
      for (std::size_t k = 0; k + (s.type == kOpenLine ? 1 : 0) < n; ++k) {
        mesh.positions.push_back(object.vertices[s.corners[k]]);
        mesh.positions.push_back(object.vertices[s.corners[(k + 1) % n]]);
      }
    } else {
      for (std::size_t k = 0; k < n; ++k) add(k);
    }
  }

  /// Returns whether Assimp leaves a triangle of a strip out, since two of its corners are at one place. If they are so
  /// only in float32, a triangle of the file is missing.
  bool is_skipped(const TriangleD& t) {
    bool skipped = false, equal = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &p = t[k], &q = t[(k + 1) % 3];
      equal = equal || p == q;
      skipped = skipped || (float(p[0]) == float(q[0]) && float(p[1]) == float(q[1]) && float(p[2]) == float(q[2]));
    }
    if (skipped && !equal) ++scene_.unfollowed.vertices;
    return skipped;
  }

  static void add_corner(const Vec3d& p, const Vec3d& loc, ExactMesh& mesh) {
    Vec3d& at = mesh.positions.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      RoundedSum sum{p[i]};
      sum.add(loc[i]);
      at[i] = sum.value;
      mesh.off = std::max(mesh.off, sum.bound());
    }
  }

  ExactScene& scene_;
  const std::uint64_t materials_;
};

}  // namespace

std::optional<ExactScene> exact_ac3d(const std::string& text) {
  try {
    Ac3dText reader(text);
    const std::vector<Ac3dObject> objects = reader.objects();
    ExactScene scene;
    scene.unfollowed.vertices = reader.unlike();
    if (objects.size() != 1 || reader.has_subdivision()) return scene;
    scene.root = Ac3dMeshes(scene, reader.materials()).add(objects[0]);
    return scene;
  } catch (const NotUnderstood&) {  // it is not known how Assimp reads it
    ExactScene nothing;
    nothing.unfollowed.vertices = 1;
    return nothing;
  }
}

}  // namespace bp
