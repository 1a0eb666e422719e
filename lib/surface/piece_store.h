#pragma once
#include <functional>
#include <mutex>
#include <string>

#include "lib/core/memory_share.h"
#include "lib/store/scratch.h"
#include "lib/surface/piece.h"

/// Where the pieces of a surface wait until the cell around them is made.
namespace bp {

/// What simplifying a surface takes.
struct SurfaceWork {
  std::uint64_t whole_bytes = 0;  ///< in all
  std::uint64_t cell_bytes = 0;   ///< of these in hand, while pieces wait
  std::uint64_t flat_faces = 0;   ///< triangles, with flat regions merged
};

/// What a surface that is simplified by cells may take of memory.
struct PieceMemory {
  std::uint64_t waiting_bytes = UINT64_MAX / 2;  ///< pieces that wait as they are
  std::uint64_t work_bytes = UINT64_MAX / 2;     ///< those in hand, and all that simplification needs beside them
  ScratchFactory make_scratch;                   ///< for further ones that wait; without it, all wait as they are
  [[nodiscard]] std::uint64_t bytes() const { return waiting_bytes + work_bytes; }  ///< for the whole, at the end
  MemoryLimit limit{};                                                              ///< that both are shares of
  double waiting_share = 0, work_share = 0;
  std::uint64_t held_bytes = 0;  ///< that something else takes of both: without()
  /// Told what simplifying a surface will take, before it takes it; throws, so that nothing is simplified. Empty: the
  /// work is done.
  std::function<void(const SurfaceWork&)> count;

  /// Returns the limit at which all that a surface takes is there. 0: not known.
  [[nodiscard]] std::uint64_t limit_for(std::uint64_t whole_bytes, std::uint64_t cell_bytes = 0) const;
  /// What is left beside something else that takes so much: it comes off what may wait first.
  [[nodiscard]] PieceMemory without(std::uint64_t bytes) const;
  /// For one of n at work.
  [[nodiscard]] PieceMemory split(std::uint64_t n) const;
};

/// A piece that waits. Movable; to be taken exactly once.
class WaitingPiece {
 public:
  [[nodiscard]] std::uint64_t face_count() const { return faces_; }

 private:
  friend class PieceStore;
  Piece piece_;                            // as it is, or empty
  std::vector<Scratch::Handle> in_store_;  // the same in chunks
  std::uint64_t faces_ = 0, bytes_ = 0;
};

/// Thread-safe for distinct pieces. What comes out is what went in, bit for bit.
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
