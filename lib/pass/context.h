#pragma once
#include <atomic>

#include "lib/core/memory_share.h"
#include "lib/grid/stream.h"
#include "lib/pass/pass_progress.h"
#include "lib/store/result_store.h"
#include "lib/store/scratch.h"
#include "lib/surface/piece_store.h"

namespace bp {

/// Thrown by a pass that was told to stop. What it has written until then is incomplete.
struct Cancelled {};

/// What a tool gives to every pass: memory, places for what waits, and who is told of the progress. None of it changes
/// a result.
struct PassContext {
  MemoryShare memory;              ///< for what is at work; what the shelves and stores hold comes on top
  PieceMemory pieces;              ///< the same, for surfaces
  ShelfFactory make_shelf;         ///< for bricks that wait
  ScratchFactory make_scratch;     ///< for triangles, crossings and colours that wait
  ResultStore* results = nullptr;  ///< results of jobs are looked up there, and put; null: all are made
  std::uint64_t turn = 0;          ///< of a job that shares work with others through `results` (lib/pass/turn.h)
  PassProgress progress;           ///< called now and then; may be empty
  /// Once it is true, the pass throws Cancelled the next time that it would report; null: it is never stopped.
  const std::atomic<bool>* stop = nullptr;

  /// Throws Cancelled if the pass is to stop.
  void check() const {
    if (stop != nullptr && *stop) throw Cancelled{};
  }
  void report(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) const {
    check();
    if (progress) progress(pass, unit, done, total);
  }
};

}  // namespace bp
