#pragma once
#include "lib/device/backend.h"
#include "tools/cli/report.h"

namespace bp {

/// One backend per computing thread on the CPU, a few per GPU. The only place where a tool chooses between them.
///   --device auto      one GPU, the first that works, where this build can use it and the work is worth its start.
///                      Without one, or once it fails, the CPU: a note of `report` says so.
///   --device cuda      every GPU; cuda:0,1 those named. Throws out_of_resource if one cannot be used.
/// BP_BACKEND=auto|cpu|cuda|cuda:0,1 in the environment decides what auto means.
///   core_seconds  what the work that a GPU could take over would take on one core, about
///   report        outlives the backends; may be null where core_seconds is 0: auto is the CPU then
[[nodiscard]] Backends make_backends(const CommonOptions& common, double core_seconds, Report* report = nullptr);

/// Returns the names of the devices at work, each once.
[[nodiscard]] std::vector<std::string> names_of(const Backends& backends);
/// Returns the page-locked memory that the backends hold, bytes. It must be subtracted from --memory.
[[nodiscard]] std::uint64_t pinned_bytes(const Backends& backends);

}  // namespace bp
