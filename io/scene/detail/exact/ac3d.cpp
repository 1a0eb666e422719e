#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <set>

#include "io/scene/detail/exact/exact_scene.h"

// AC3D (Inivis, "The AC3D file format"): lines of words. The corners of an object are those of its surfaces, sorted by
// material, with its `loc` added; `loc` of a group moves its kids. Assimp passes over lines that it does not expect,
// and takes lines of a text for its own. So a file is understood only if each line is one that belongs where it is.

namespace bp {

namespace {

constexpr std::uint64_t kClosedLine = 1, kOpenLine = 2, kStrip = 4;

struct Surface {
  std::uint64_t material = 0, type = 0;
  std::vector<std::uint64_t> corners;
};

struct Ac3dObject {
  bool is_group = false, is_turned = false;
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

  /// Returns the object that all others are below.
  Ac3dObject world() {
    if (!next_line() || !line_.starts_with("AC3D")) throw NotUnderstood();
    while (next_line() && word() == "MATERIAL") ++materials_;
    if (word() != "OBJECT") throw NotUnderstood();
    Ac3dObject world = object(0);
    while (next_line()) {
      if (!line_.empty()) throw NotUnderstood();
    }
    return world;
  }
  /// Returns whether the file ends before the last kid, as tracks of TORCS do. It is not known which group has fewer.
  [[nodiscard]] bool is_short() const { return is_short_; }
  [[nodiscard]] std::uint64_t hidden() const { return hidden_; }  ///< objects that AC3D itself does not show
  [[nodiscard]] std::uint64_t materials() const { return std::max<std::uint64_t>(materials_, 1); }

 private:
  static constexpr int kMostNested = 1000;

  bool next_line() {
    line_ = {};
    if (at_ >= text_.size()) return false;
    end_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line_ = text_.substr(at_, end_ - at_);
    at_ = std::min(text_.find_first_not_of("\r\n", end_), text_.size());
    line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
    return true;
  }
  [[nodiscard]] std::string_view word() const { return line_.substr(0, line_.find_first_of(" \t")); }
  [[nodiscard]] std::string_view rest() const {
    return word().size() == line_.size() ? std::string_view() : line_.substr(word().size() + 1);
  }
  /// Returns the numbers of a line that holds `n` and nothing else.
  [[nodiscard]] std::vector<double> numbers(std::size_t n) const {
    std::optional<std::vector<double>> found = only_numbers_in(rest());
    if (!found || found->size() != n) throw NotUnderstood();
    return *std::move(found);
  }
  /// Reads the number of entries that follow, each on a line of at least two characters.
  [[nodiscard]] std::uint64_t count() const {
    const std::uint64_t n = only_integer();
    if (n > text_.size()) throw NotUnderstood();
    return n;
  }
  /// Returns the integer of a line that holds one and nothing else.
  [[nodiscard]] std::uint64_t only_integer(int base = 10) const {
    std::string_view from = rest().substr(0, rest().find_last_not_of(" \t") + 1);
    if (base == 16) {
      if (!from.starts_with("0x") && !from.starts_with("0X")) throw NotUnderstood();
      from.remove_prefix(2);
    }
    return integer(from, base);
  }
  [[nodiscard]] static std::uint64_t integer(std::string_view from, int base = 10) {
    std::uint64_t value = 0;
    const char* const end = from.data() + from.size();
    const auto [next, fault] = std::from_chars(from.data(), end, value, base);
    if (fault != std::errc() || next != end) throw NotUnderstood();
    return value;
  }

  Ac3dObject object(int depth);
  void read_line();
  void pass_over_text();
  void add_kids(Ac3dObject& object, int depth);
  void add_vertices(Ac3dObject& object);
  void add_surfaces(Ac3dObject& object);

  std::string_view text_, line_;
  std::size_t at_ = 0, end_ = 0;  // of the next line, and where this one ends
  std::uint64_t materials_ = 0, hidden_ = 0;
  bool is_short_ = false;
};

void Ac3dText::add_vertices(Ac3dObject& object) {
  for (std::uint64_t n = count(); n > 0; --n) {
    if (!next_line()) throw NotUnderstood();
    const std::optional<std::vector<double>> p = only_numbers_in(line_);
    if (!p || p->size() < 3) throw NotUnderstood();
    object.vertices.push_back({p->at(0), p->at(1), p->at(2)});
    // A line that begins with neither a digit nor a sign, such as ".5 0 0", ends the list for Assimp.
    if (std::string_view("0123456789+-").find(line_[0]) == std::string_view::npos) throw NotUnderstood();
  }
}

void Ac3dText::add_surfaces(Ac3dObject& object) {
  for (std::uint64_t n = count(); n > 0; --n) {
    if (!next_line() || word() != "SURF") throw NotUnderstood();
    Surface& surface = object.surfaces.emplace_back();
    surface.type = only_integer(16) & 0xF;
    if (surface.type > kOpenLine && surface.type != kStrip) throw NotUnderstood();
    if (next_line() && word() == "mat") {
      surface.material = only_integer();
      next_line();
    }
    if (word() != "refs" || surface.material >= materials()) throw NotUnderstood();
    for (std::uint64_t k = count(); k > 0; --k) {
      if (!next_line()) throw NotUnderstood();
      const std::uint64_t corner = integer(word());
      if (corner >= object.vertices.size()) throw NotUnderstood();  // Assimp takes the first vertex
      surface.corners.push_back(corner);
    }
  }
}

/// Passes over the text of `data`, which Assimp takes for lines of the object.
void Ac3dText::pass_over_text() {
  constexpr std::array<std::string_view, 12> kTaken{"kids",   "name", "texture", "texrep",  "texoff",  "rot",
                                                    "subdiv", "loc",  "crease",  "numvert", "numsurf", "OBJECT"};
  const std::size_t begin = text_.substr(end_).starts_with("\r\n") ? end_ + 2 : end_ + 1, n = count();
  at_ = std::min(begin, text_.size());
  while (at_ < begin + n) {
    if (!next_line() || line_.empty() || std::find(kTaken.begin(), kTaken.end(), word()) != kTaken.end())
      throw NotUnderstood();
  }
  if (n > 0 && end_ != begin + n) throw NotUnderstood();
}

/// Reads a line that may stand in an object more than once, or says nothing about its surfaces.
void Ac3dText::read_line() {
  constexpr std::array<std::string_view, 9> kLooks{"name",   "texture", "texrep", "texoff", "crease",
                                                   "hidden", "locked",  "folded", "url"};
  hidden_ += word() == "hidden" ? 1 : 0;
  const bool ends = std::count(line_.begin(), line_.end(), '"') % 2 == 0;  // a name may go on in the next line
  if (word() == "data")
    pass_over_text();
  else if (!ends || std::find(kLooks.begin(), kLooks.end(), word()) == kLooks.end())
    throw NotUnderstood();
}

void Ac3dText::add_kids(Ac3dObject& object, int depth) {
  for (std::uint64_t n = count(); n > 0; --n) {
    is_short_ = is_short_ || at_ >= text_.size();
    if (is_short_) return;
    if (!next_line() || word() != "OBJECT") throw NotUnderstood();
    object.kids.push_back(this->object(depth + 1));
  }
}

Ac3dObject Ac3dText::object(int depth) {
  constexpr std::array<std::string_view, 4> kKinds{"world", "poly", "group", "light"};
  const std::string_view kind = rest().substr(0, rest().find_last_not_of(" \t") + 1);
  if (depth == kMostNested || std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) throw NotUnderstood();
  Ac3dObject object;
  object.is_group = kind == "group";
  std::set<std::string, std::less<>> met;
  while (next_line()) {
    constexpr std::array<std::string_view, 6> kOnce{"loc", "rot", "subdiv", "numvert", "numsurf", "kids"};
    const std::string_view what = word();
    if (std::find(kOnce.begin(), kOnce.end(), what) == kOnce.end()) {
      read_line();
    } else if (!met.emplace(what).second) {
      throw NotUnderstood();
    } else if (what == "loc") {
      const std::vector<double> p = numbers(3);
      object.loc = {p[0], p[1], p[2]};
    } else if (what == "rot") {
      const std::vector<double> rot = numbers(9);
      object.is_turned = rot != object.rot;
      object.rot = rot;
    } else if (what == "subdiv") {
      if (only_integer() > 0) throw NotUnderstood();  // Assimp computes vertices
    } else if (what == "numvert") {
      add_vertices(object);
    } else if (what == "numsurf") {
      add_surfaces(object);
    } else {
      add_kids(object, depth);
      return object;
    }
  }
  throw NotUnderstood();
}

/// The corners of one object in the order of Assimp's meshes: those of polygons, of each triangle of strips, of lines.
class Ac3dMeshes {
 public:
  Ac3dMeshes(ExactScene& scene, const Ac3dText& text)
      : scene_(scene), materials_(text.materials()), is_short_(text.is_short()) {}

  ExactNode add(const Ac3dObject& object) {
    const bool has_corners = std::any_of(object.surfaces.begin(), object.surfaces.end(),
                                         [](const Surface& s) { return !s.corners.empty(); });
    ExactNode node;
    if (is_doubtful(object, has_corners)) ++scene_.unfollowed.transforms;
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
  /// Returns whether programs place an object or its kids in different ways. They differ on which side of a vertex
  /// `rot` stands, and Assimp moves surfaces before it turns them. It adds `loc` of a group twice to surfaces of its
  /// own, and not at all to kids of a poly that has some.
  [[nodiscard]] bool is_doubtful(const Ac3dObject& object, bool has_corners) const {
    const bool has_both = has_corners && (object.is_group || !object.kids.empty());
    return object.is_turned || (object.loc != Vec3d{} && (has_both || (is_short_ && !object.kids.empty())));
  }
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
  const bool is_short_;
};

}  // namespace

ExactScene exact_ac3d(const std::string& text) {
  try {
    Ac3dText reader(text);
    const Ac3dObject world = reader.world();
    ExactScene scene;
    scene.is_known = true;
    scene.unfollowed.hidden = reader.hidden();
    scene.root = Ac3dMeshes(scene, reader).add(world);
    return scene;
  } catch (const NotUnderstood&) {  // it is not known how Assimp reads it
    ExactScene nothing;
    nothing.unfollowed.vertices = 1;
    return nothing;
  }
}

}  // namespace bp
