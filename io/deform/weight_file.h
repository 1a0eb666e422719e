#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "lib/core/indexed_mesh.h"
#include "lib/deform/weight_block.h"
#include "lib/store/result_store.h"

/// The file of weights that binds a scene to a cage (docs/weight-file.md).
namespace bp {

struct WeightHeader {
  std::string scene;              ///< name of the scene's file; a relative name counts from the folder of the weights
  std::uint64_t scene_bytes = 0;  ///< size of the scene's file
  IndexedMesh cage;               ///< the cage at rest: vertices and triangles
  CoordinateKind kind = CoordinateKind::mean_value;
};

struct WeightTotals {
  std::uint64_t points = 0, outside = 0;  ///< outside: the points that the cage does not hold
  ResultKey hash{};                       ///< XXH3-128 of the coordinates of all points in their order
};

/// Returns the largest number of points of a block, from 16 to 4096: a block has about 2^20 weights.
[[nodiscard]] std::size_t points_of_block(std::size_t columns);

/// A compressed block, on its way to a file or from it.
struct PackedWeights {
  std::uint64_t offset = 0;  ///< offset of its head in the file
  std::uint32_t points = 0;
  std::vector<std::byte> bytes;
};
/// Compresses a block. Thread-safe.
void pack_weights(const WeightBlock& block, PackedWeights& out);
/// Decompresses a block; returns a fault, or null if there is none. Thread-safe.
[[nodiscard]] const char* unpack_weights(const PackedWeights& packed, std::size_t columns, WeightBlock& out);

class WeightWriter {
 public:
  /// Keeps a reference to `out`.
  WeightWriter(OutputFile& out, const WeightHeader& header);
  ~WeightWriter();
  void write(const PackedWeights& block);
  void finish(const WeightTotals& totals);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns whether a file begins as files of weights do. The file must be seekable.
[[nodiscard]] bool begins_as_weights(const InputFile& file);

/// Returns the path of the scene that the weights in the file `path` name. A relative name counts from the folder of
/// the weights, or else from the working folder. Empty if the file is in neither.
[[nodiscard]] std::string find_scene(const WeightHeader& header, const std::string& path);

/// Reads a file of weights. The constructor and the functions throw bad_input, with the offset, if the file is
/// truncated, damaged or of another kind.
class WeightReader {
 public:
  explicit WeightReader(const std::string& path);
  ~WeightReader();
  [[nodiscard]] const WeightHeader& header() const;
  /// Returns the number of points that the end of the file declares, unchecked; 0 if it is not known.
  [[nodiscard]] std::uint64_t points_declared() const;
  /// Reads the next block; returns false at the end, where totals() become known.
  bool next(PackedWeights& out);
  [[nodiscard]] const WeightTotals& totals() const;
  /// Decompresses a block. Thread-safe.
  void unpack(const PackedWeights& packed, WeightBlock& out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
