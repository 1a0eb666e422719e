#include "tests/bench/bench_scenes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/volume/outside.h"
#include "lib/voxel/voxelize.h"

namespace bp {

namespace {

/// Triangles of an OBJ file; faces as fans. Enough for the benchmark's models.
std::vector<TriangleD> read_obj(const std::string& path) {
  std::ifstream in(path);
  if (!in) fail(ErrorCode::bad_input, "{}: cannot read", path);
  std::vector<Vec3d> vertices;
  std::vector<TriangleD> triangles;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3d p{};
      words >> p[0] >> p[1] >> p[2];
      vertices.push_back(p);
    } else if (kind == "f") {
      std::vector<std::size_t> face;
      for (std::string corner; words >> corner;) {
        const long i = std::stol(corner);
        face.push_back(i > 0 ? std::size_t(i - 1) : std::size_t(long(vertices.size()) + i));
      }
      for (std::size_t i = 2; i < face.size(); ++i)
        triangles.push_back({vertices.at(face[0]), vertices.at(face[i - 1]), vertices.at(face[i])});
    }
  }
  return triangles;
}

void fill_inside(BitBox& bits) {
  const VoxelBox box = bits.box();
  OutsideFlood flood(box,
                     {(box.size().x + 63) / 64 * 64, (box.size().y + 63) / 64 * 64, (box.size().z + 63) / 64 * 64});
  flood.join(OutsideFlood::label(bits, box));
  flood.resolve();
  flood.fill_enclosed(box, bits);
}

struct Placed {
  std::vector<TriangleD> triangles;
  GridFrame frame;
  VoxelBox box;
};
Placed place(const std::string& path, int resolution) {
  Placed p{read_obj(path), {}, {}};
  Bounds3d bounds;
  for (const TriangleD& t : p.triangles) {
    for (const Vec3d& v : t) bounds.add(v);
  }
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, bounds.max[i] - bounds.min[i]);
  p.frame = make_frame(bounds, longest / resolution);
  p.box = voxel_bounds(p.frame, bounds);
  return p;
}

BenchSolid from_obj(const std::string& path, int resolution) {
  const Placed p = place(path, resolution);
  BenchSolid s;
  s.tight = p.box;
  s.bits.reset(s.tight.grown(1));
  std::vector<FixedTriangle> fixed;
  for (const TriangleD& t : p.triangles) fixed.push_back(to_fixed(p.frame, t));
  voxelize_surface(fixed, s.bits);
  fill_inside(s.bits);
  s.name = path.substr(path.find_last_of('/') + 1);
  return s;
}

BenchSolid from_stream(const std::string& path) {
  BrickReader source(path);
  BenchSolid s;
  s.name = path.substr(path.find_last_of('/') + 1);
  s.tight = voxels_of(source.header().bricks);
  s.orientation = source.header().orientation;
  s.bits.reset(s.tight);
  for (Brick brick; source.read(brick);) {
    const VoxelCoord first = first_voxel(brick.coord);
    for (std::int32_t i = 0; i < std::int32_t(kBrickWords); ++i)
      s.bits.row(first.y + i % kBrickEdge, first.z + i / kBrickEdge)[(first.x - s.tight.min.x) / 64] =
          brick.bits[std::size_t(i)];
  }
  return s;
}

/// Sets the voxels of `box` where inside(p), p in [0,1]^3 of the longest side.
template <class Inside>
void set_where(BitBox& bits, double n, const Vec3d& low, const Vec3d& high, const Inside& inside) {
  VoxelBox box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::max(bits.box().min[i], std::int32_t(std::floor(low[std::size_t(i)] * n)));
    box.max[i] = std::min(bits.box().max[i], std::int32_t(std::ceil(high[std::size_t(i)] * n)) + 1);
  }
  for (std::int32_t z = box.min.z; z < box.max.z; ++z) {
    for (std::int32_t y = box.min.y; y < box.max.y; ++y) {
      for (std::int32_t x = box.min.x; x < box.max.x; ++x) {
        if (inside(Vec3d{(x + 0.5) / n, (y + 0.5) / n, (z + 0.5) / n})) bits.set({x, y, z});
      }
    }
  }
}

BenchSolid plant(int resolution) {
  const double n = resolution;
  BenchSolid s;
  s.name = "plant";
  s.tight = {{0, 0, 0}, {resolution, resolution * 5 / 8, resolution * 6 / 8}};
  s.bits.reset(s.tight);
  std::mt19937 engine(7);
  const auto random = [&](double a, double b) { return a + (b - a) * double(engine() % 65536) / 65536; };
  for (int i = 0; i < 24; ++i) {  // tanks
    const Vec3d c{random(0.1, 0.9), random(0.1, 0.5), random(0.1, 0.65)};
    const double r = random(0.02, 0.08);
    set_where(s.bits, n, {c[0] - r, c[1] - r, c[2] - r}, {c[0] + r, c[1] + r, c[2] + r}, [&](const Vec3d& p) {
      return (p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1]) + (p[2] - c[2]) * (p[2] - c[2]) < r * r;
    });
  }
  for (int i = 0; i < 160; ++i) {  // pipes, each along an axis
    const std::size_t axis = std::size_t(i % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double r = random(0.002, 0.008);
    Vec3d a{random(0.05, 0.9), random(0.05, 0.55), random(0.05, 0.7)}, b = a;
    b[axis] += random(0.1, 0.5);
    Vec3d low = a, high = b;
    for (const std::size_t k : {u, v}) low[k] -= r, high[k] += r;
    set_where(s.bits, n, low, high, [&](const Vec3d& p) {
      return p[axis] >= a[axis] && p[axis] <= b[axis] &&
             (p[u] - a[u]) * (p[u] - a[u]) + (p[v] - a[v]) * (p[v] - a[v]) < r * r;
    });
  }
  for (int i = 0; i < 20; ++i) {  // slanted plates
    const Vec3d c{random(0.1, 0.9), random(0.1, 0.5), random(0.1, 0.65)},
        d{random(-1, 1), random(-1, 1), random(-1, 1)};
    const double r = random(0.03, 0.1), length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    set_where(s.bits, n, {c[0] - r, c[1] - r, c[2] - r}, {c[0] + r, c[1] + r, c[2] + r}, [&](const Vec3d& p) {
      const double across = ((p[0] - c[0]) * d[0] + (p[1] - c[1]) * d[1] + (p[2] - c[2]) * d[2]) / length;
      return std::abs(across) * n < 1.5;
    });
  }
  return s;
}

/// A wave of integers between 0 and 256, of this period.
std::int32_t wave(std::int32_t i, std::int32_t period) {
  const std::int32_t t = ((i % period) + period) % period;
  const std::int32_t up = 512 * t / period;  // 0 .. 511
  const std::int32_t triangle = up < 256 ? up : 512 - up;
  return triangle * triangle * (768 - 2 * triangle) / 65536;  // smoothed
}

}  // namespace

BenchSolid load_bench_solid(const std::string& what, int resolution) {
  if (what.ends_with(".bpv")) return from_stream(what);
  return what == "plant" ? plant(resolution) : from_obj(what, resolution);
}

std::vector<FixedTriangle> load_bench_triangles(const std::string& path, int resolution, int pieces, VoxelBox& box) {
  const Placed p = place(path, resolution);
  box = p.box;
  std::vector<FixedTriangle> out;
  out.reserve(p.triangles.size() * std::size_t(pieces) * std::size_t(pieces));
  for (const TriangleD& t : p.triangles) {
    const auto at = [&](int i, int j) {  // barycentric lattice
      Vec3d v{};
      for (std::size_t k = 0; k < 3; ++k)
        v[k] = t[0][k] + (t[1][k] - t[0][k]) * i / pieces + (t[2][k] - t[0][k]) * j / pieces;
      return v;
    };
    for (int i = 0; i < pieces; ++i) {
      for (int j = 0; i + j < pieces; ++j) {
        out.push_back(to_fixed(p.frame, {at(i, j), at(i + 1, j), at(i, j + 1)}));
        if (i + j + 1 < pieces) out.push_back(to_fixed(p.frame, {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}));
      }
    }
  }
  return out;
}

ScaleLattice bench_scale(const VoxelBox& box, Scale least, Scale most) {
  ScaleLattice s;
  for (int axis = 0; axis < 3; ++axis) {
    s.origin[axis] = floor_div(box.min[axis], kScaleStep);
    s.size[axis] = floor_div(box.max[axis], kScaleStep) + 2 - s.origin[axis];
  }
  for (std::int32_t z = 0; z < s.size.z; ++z) {
    for (std::int32_t y = 0; y < s.size.y; ++y) {
      for (std::int32_t x = 0; x < s.size.x; ++x) {
        const std::int32_t bump = (wave(x + s.origin.x, 38) + wave(y + s.origin.y, 30) + wave(z + s.origin.z, 26)) / 3;
        s.samples.push_back(Scale(least + (most - least) * bump / 256));
      }
    }
  }
  s.min = *std::min_element(s.samples.begin(), s.samples.end());
  s.max = *std::max_element(s.samples.begin(), s.samples.end());
  return s;
}

OrientationField bench_orientation(const std::string& name) {
  const double angle = (name == "turned" ? 30 : 35) * M_PI / 360, length = std::sqrt(14.0);
  const Vec3d axis = name == "turned" ? Vec3d{0, 0, 1} : Vec3d{1 / length, 2 / length, 3 / length};
  const auto part = [](double v) { return std::int16_t(std::lround(v * (1 << kRotationBits))); };
  const FixedQuaternion q{part(std::cos(angle)), part(axis[0] * std::sin(angle)), part(axis[1] * std::sin(angle)),
                          part(axis[2] * std::sin(angle))};
  return {64, {}, {1, 1, 1}, {q}, {0}};
}

std::uint64_t bits_hash(const BitBox& bits) {
  std::uint64_t h = 1469598103934665603u;
  for (std::int64_t i = 0; i < bits.word_count(); ++i) h = (h ^ bits.data()[i]) * 1099511628211u;
  return h;
}

}  // namespace bp
