#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

/// A second reader of the brick stream, written from docs/brick-stream.md alone: the whole file in memory, one byte
/// after the other, no shared code. Throws std::runtime_error on anything that the document forbids.
namespace reference {

using Key = std::tuple<int, int, int, int>;  ///< layer, x, y, z
using Voxels = std::vector<bool>;            ///< 64^3, x fastest

struct StreamFile {
  int fill = 0, element = 0, slab_axis = 0, up = 0;
  bool has_closing = false;
  double voxel = 0;
  std::array<std::int64_t, 3> origin{};
  std::array<double, 6> bounds{};
  std::array<std::int32_t, 6> box{};
  std::string scale, provenance, scene;
  std::map<Key, Voxels> bricks;
  std::string checksum;
};

StreamFile read_stream(const std::vector<unsigned char>& file);

}  // namespace reference
