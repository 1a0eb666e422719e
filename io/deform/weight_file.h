#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "lib/core/indexed_mesh.h"
#include "lib/deform/weight_block.h"
#include "lib/store/result_store.h"

/// The file of weights that binds a scene to a cage: docs/weight-file.md.
namespace bp {

struct WeightHeader {
  std::string scene;              ///< name of its file; a relative one counts from the folder of the weights
  std::uint64_t scene_bytes = 0;  ///< of that file
  IndexedMesh cage;               ///< at rest: vertices and triangles
  CoordinateKind kind = CoordinateKind::mean_value;
};

struct WeightTotals {
  std::uint64_t points = 0, outside = 0;  ///< outside: of the points, those that the cage does not hold
  ResultKey hash{};                       ///< XXH3-128 of the coordinates of all points in their order
};

/// Points of a block at most: so many that a block has 2^20 weights, from 16 to 4096.
[[nodiscard]] std::size_t points_of_block(std::size_t columns);

/// A block on its way to a file or from it.
struct PackedWeights {
  std::uint64_t offset = 0;  ///< of its head in the file
  std::uint32_t points = 0;
  std::vector<std::byte> bytes;
};
/// Thread-safe.
void pack_weights(const WeightBlock& block, PackedWeights& out);
/// What is wrong with the block; null: nothing. Thread-safe.
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

/// Whether a file that can be read again begins as files of weights do.
[[nodiscard]] bool begins_as_weights(const InputFile& file);

/// Where the scene of the weights in the file `path` lies: a relative name counts from their folder, or else from the
/// working folder. Empty: in neither.
[[nodiscard]] std::string find_scene(const WeightHeader& header, const std::string& path);

/// Throws bad_input, with the offset, if the file is truncated, damaged or something else: here, or while reading.
class WeightReader {
 public:
  explicit WeightReader(const std::string& path);
  ~WeightReader();
  [[nodiscard]] const WeightHeader& header() const;
  /// What the end of the file says, which is not checked yet; 0: nothing.
  [[nodiscard]] std::uint64_t points_declared() const;
  /// False at the end; totals() are known then.
  bool next(PackedWeights& out);
  [[nodiscard]] const WeightTotals& totals() const;
  /// Thread-safe.
  void unpack(const PackedWeights& packed, WeightBlock& out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
