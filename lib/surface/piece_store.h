#pragma once
#include <functional>
#include <mutex>
#include <string>

#include "lib/core/memory_share.h"
#include "lib/store/scratch.h"
#include "lib/surface/piece.h"

/// A store for the pieces of a surface that wait until the cell around them is made.
namespace bp {

/// Bytes of each triangle while a surface is simplified: the piece, its half-edges, quadrics, boxes and their tree.
constexpr std::uint64_t kWorkPerFace = 256;

/// Memory that simplifying a surface takes.
struct SurfaceWork {
  std::uint64_t whole_bytes = 0;  ///< bytes that the whole surface takes
  std::uint64_t cell_bytes = 0;   ///< bytes of the cells at work, while pieces wait
  std::uint64_t flat_faces = 0;   ///< triangles that are left when flat regions are merged
};

/// Memory that a surface which is simplified by cells may take.
struct PieceMemory {
  std::uint64_t waiting_bytes = UINT64_MAX / 2;  ///< pieces that wait as they are
  std::uint64_t work_bytes = UINT64_MAX / 2;  ///< pieces at work, and all that their simplification needs in addition
  ScratchFactory make_scratch;                ///< for pieces beyond waiting_bytes; without it they wait in memory
  /// The sum of both, which the whole surface may take at the end.
  [[nodiscard]] std::uint64_t bytes() const { return waiting_bytes + work_bytes; }
  MemoryLimit limit{};  ///< the limit (--memory) that both numbers are shares of
  double waiting_share = 0, work_share = 0;
  std::uint64_t held_bytes = 0;  ///< that something else takes of both: without()
  /// Told what simplifying a surface will take, before it takes it; throws, so that nothing is simplified. Empty: the
  /// work is done.
  std::function<void(const SurfaceWork&)> count;

  /// Returns the limit at which all that a surface takes is there. 0: not known.
  [[nodiscard]] std::uint64_t limit_for(std::uint64_t whole_bytes, std::uint64_t cell_bytes = 0) const;
  /// Returns the memory that is left when something else takes `bytes`: these come off what may wait first.
  [[nodiscard]] PieceMemory without(std::uint64_t bytes) const;
  /// Returns the share for each of n surfaces at work.
  [[nodiscard]] PieceMemory split(std::uint64_t n) const;
};

/// A piece that waits. Movable. It must be taken exactly once.
class WaitingPiece {
 public:
  [[nodiscard]] std::uint64_t face_count() const { return faces_; }

 private:
  friend class PieceStore;
  Piece piece_;                            // as it is, or empty
  std::vector<Scratch::Handle> in_store_;  // the same piece in the store, in chunks
  std::uint64_t faces_ = 0, bytes_ = 0;
};

/// Keeps pieces and returns them bit for bit. Thread-safe for distinct pieces.
class PieceStore {
 public:
  explicit PieceStore(const PieceMemory& memory) : memory_(memory) {}
  [[nodiscard]] WaitingPiece put(Piece&& piece);
  [[nodiscard]] Piece take(WaitingPiece&& waiting);

 private:
  [[nodiscard]] bool reserve(std::uint64_t bytes);
  [[nodiscard]] Scratch& store();

  const PieceMemory& memory_;
  std::mutex mutex_;
  std::uint64_t used_ = 0;
  std::unique_ptr<Scratch> store_;  // made when it is first needed
};

}  // namespace bp
