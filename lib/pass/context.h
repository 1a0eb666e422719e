#pragma once
#include <atomic>

#include "lib/core/memory_share.h"
#include "lib/core/parallel.h"
#include "lib/grid/stream.h"
#include "lib/pass/pass_progress.h"
#include "lib/store/result_store.h"
#include "lib/store/scratch.h"
#include "lib/surface/piece_store.h"

namespace bp {

/// The resources that a tool gives to every pass: memory, shelves and scratch, and a receiver of the progress. They
/// change no result.
struct PassContext {
  MemoryShare memory;              ///< for the work itself; the content of shelves and stores comes on top
  PieceMemory pieces;              ///< the same, for surfaces
  ShelfFactory make_shelf;         ///< for bricks that wait
  ScratchFactory make_scratch;     ///< for triangles, crossings and colours that wait
  ResultStore* results = nullptr;  ///< results of jobs are looked up there, and put; null: all are made
  std::uint64_t turn = 0;  ///< the turn of a job that shares work with others through `results` (lib/pass/turn.h)
  PassProgress progress;   ///< called now and then; may be empty
  /// Once it is true, the pass throws Cancelled the next time that it would report; null: it is never stopped.
  const std::atomic<bool>* stop = nullptr;

  /// Throws Cancelled if the pass is to stop.
  void check() const {
    stop_if_asked();
    if (stop != nullptr && *stop) throw Cancelled{};
  }
  void report(const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) const {
    check();
    if (progress) progress(pass, unit, done, total);
  }
};

}  // namespace bp
