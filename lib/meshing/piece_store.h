#pragma once
#include <mutex>

#include "lib/core/chunk_store.h"
#include "lib/meshing/piece.h"

/// Where the pieces of a surface wait until the cell around them is made.
namespace bp {

/// What a surface that is simplified by cells may take of memory.
struct PieceMemory {
  /// Half for pieces that wait as they are, half for those in hand and all that simplification needs beside them; at
  /// the end all of it for the whole.
  std::uint64_t bytes = UINT64_MAX;
  ChunkStoreFactory make_store;  ///< for pieces that wait beyond that; without one, they all wait as they are
};

/// A piece that waits. Movable; to be taken exactly once.
class WaitingPiece {
 public:
  [[nodiscard]] std::uint64_t face_count() const { return faces_; }

 private:
  friend class PieceStore;
  Piece piece_;                               // as it is, or empty
  std::vector<ChunkStore::Handle> in_store_;  // the same in chunks
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
  [[nodiscard]] ChunkStore& store();

  const PieceMemory& memory_;
  std::mutex mutex_;
  std::uint64_t used_ = 0;
  std::unique_ptr<ChunkStore> store_;  // made when it is first needed
};

}  // namespace bp
