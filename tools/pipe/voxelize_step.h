#pragma once
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tools/cli/common_options.h"
#include "tools/cli/options/voxel.h"
#include "tools/cli/report.h"
#include "tools/notes/scene_notes.h"
#include "tools/run/memory_shares.h"
#include "tools/run/provenance.h"

/// The first step of the pipe, as bpvox and libbp do it.
namespace bp {

/// Returns the options for the provenance of the voxels. `told`: whether the user or the scene named the up axis. For
/// an axis other than y that is clear anyway.
[[nodiscard]] OptionText voxelize_text(const VoxelOptions& voxels, UpAxis up, bool told);

/// Returns the options of the pass: voxel size, filling, memory and scratch. The result keeps a reference to `voxels`.
[[nodiscard]] VoxelizeOptions voxelize_options(const VoxelOptions& voxels, const CommonOptions& common,
                                               const VoxelizeBudget& budget);

/// Returns the files for later tools; none if part of the scene came from a pipe, which cannot be read again.
[[nodiscard]] SceneFiles scene_files(const VoxelOptions& voxels, const VoxelizeCounts& counts);

/// Adds to the report what the user should know of the voxels: a rounded voxel size, what scene_notes() finds, and
/// columns that cross an open surface.
void note_voxels(Report& report, const CommonOptions& common, const StreamHeader& header, const VoxelizeCounts& counts,
                 const SceneAgain& scene);

}  // namespace bp
