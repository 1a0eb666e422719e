#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "samples/plant/modules.h"

/// The plan of a site: which shape stands where. Shapes are few and used many times; a placement is a quarter turn or a
/// mirror image with a shift, so that it is exact.
namespace plant {

struct Shape {
  Kind kind;
  std::uint64_t seed;
  std::uint64_t items;
  Counts counts;
};

struct Placement {
  std::size_t shape;
  double xx, xz, zx, zz;  ///< x' = xx x + xz z + dx,  z' = zx x + zz z + dz; each 0, 1 or -1
  double dx, dz;
  [[nodiscard]] bool mirrored() const { return xx * zz - xz * zx < 0; }
  [[nodiscard]] Vec apply(Vec p) const { return {xx * p.x + xz * p.z + dx, p.y, zx * p.x + zz * p.z + dz}; }
};

class Site {
 public:
  /// About `triangles` triangles, within 1 %. Throws bp::Error (bad_argument) below 10,000.
  Site(std::uint64_t triangles, std::uint64_t seed);

  [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }  ///< of the whole site, every instance counted
  [[nodiscard]] double detail() const { return detail_; }

  void build_shape(std::size_t shape, Sink& sink) const;
  /// Every placement, plot by plot along a serpentine, so that neighbours in the file are neighbours on the site.
  void for_each(const std::function<void(const Placement&)>& visit) const;

 private:
  [[nodiscard]] std::size_t module_of(std::uint64_t plot) const;
  [[nodiscard]] std::uint64_t surroundings(std::uint64_t plots) const;
  std::size_t add_shape(Kind kind, std::uint64_t seed, std::uint64_t items);

  std::uint64_t seed_;
  double detail_;
  std::vector<Shape> shapes_;
  std::size_t rack_ = 0, fence_ = 0, ground_ = 0, yard_ = 0;
  std::uint64_t plots_ = 0;          ///< with a module; the yard is one more
  std::vector<std::size_t> extras_;  ///< shapes of the last plots, chosen to fill up
  Counts counts_;
};

}  // namespace plant
