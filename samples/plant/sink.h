#pragma once
#include <cmath>
#include <cstdint>

/// Receives the generated geometry. A scene is generated several times (to count, for its vertices, for its faces),
/// each time the same, so that it never has to be in memory.
namespace plant {

struct Vec {
  double x = 0, y = 0, z = 0;
};
inline Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(Vec a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec unit(Vec a) {
  return a * (1 / std::sqrt(dot(a, a)));
}

class Sink {
 public:
  enum Wants : unsigned { nothing = 0, vertices = 1, faces = 2 };
  virtual ~Sink() = default;
  /// Announces a connected component with these numbers of vertices and triangles. Returns which of the two to send.
  virtual Wants part(std::uint32_t vertex_count, std::uint32_t triangle_count) = 0;
  virtual void vertex(Vec) {}
  virtual void face(std::uint32_t, std::uint32_t, std::uint32_t) {}  ///< numbers count from the start of the part
};

struct Counts {
  std::uint64_t parts = 0, vertices = 0, triangles = 0;
  void add(const Counts& c) { parts += c.parts, vertices += c.vertices, triangles += c.triangles; }
};

class CountSink : public Sink {
 public:
  Wants part(std::uint32_t vertex_count, std::uint32_t triangle_count) override {
    counts.add({1, vertex_count, triangle_count});
    return nothing;
  }
  Counts counts;
};

/// Small deterministic generator of random numbers (a 64-bit counter, mixed): the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform(double lo, double hi) { return lo + (hi - lo) * (double(next() >> 11) * 0x1p-53); }
  int integer(int lo, int hi) { return lo + int(next() % std::uint64_t(hi - lo + 1)); }  ///< both ends included
  bool chance(double p) { return uniform(0, 1) < p; }

 private:
  std::uint64_t state_;
};

}  // namespace plant
