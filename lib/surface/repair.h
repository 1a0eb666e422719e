#pragma once
#include <array>
#include <cstdint>

#include "lib/grid/stream.h"

/// Voxels that touch only along an edge or at a corner make the boundary of their union non-manifold. Repair adds the
/// fewest local voxels that undo it, so the solid only grows and still encloses what it enclosed (docs/bounding.md,
/// "Surface").
namespace bp {

/// A 2x2x2 block of voxels as a byte: bit dx + 2 dy + 4 dz.
using Corner = std::uint8_t;

/// True if the boundary of the occupied voxels is a disc around the block's centre (or the block is all empty or all
/// full): the occupied ones and the empty ones are both connected through faces.
[[nodiscard]] bool corner_is_manifold(Corner block);

/// The voxels to add to a block, as a byte; 0 for manifold blocks:
///   a 2x2 square with two diagonal voxels: the other two;
///   two voxels on a space diagonal: the path x, then y, from the lower one in z to the other;
///   two empty voxels on a space diagonal: both.
/// Applied to any block once, it leaves that block manifold (tests/unit/surface/test_repair.cpp proves it on all 256).
[[nodiscard]] Corner corner_repair(Corner block);

/// Repairs all bricks of a shelf: rounds in which each block adds its voxels at once, until none adds any. Rounds are
/// global, so the result depends neither on bricks nor on threads. Ends: additions stay inside the bounding box of the
/// solid. Returns the number of voxels added.
std::uint64_t repair_contacts(BrickShelf& shelf);

}  // namespace bp
