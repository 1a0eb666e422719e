#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/check/check_report.h"
#include "lib/core/coords.h"
#include "lib/core/memory_share.h"
#include "tools/run/mesh_extras.h"

namespace bp {

/// Nothing where the file cannot be read again: a hint is no reason to fail, or to wait for a pipe.
[[nodiscard]] MeshExtras extras_of(const std::string& path);

/// What `proxy` says that --origin subtracted from its vertices, to be added back before it is compared with `scenes`.
/// Empty: nothing, there is no scene, or a scene says the same of itself.
[[nodiscard]] std::optional<Vec3d> told_origin(const std::vector<std::string>& scenes, const std::string& proxy);

/// Of a proxy that fails: that it was made from other triangles than those of `scenes`, by what its file says. Reads
/// the scenes once more. Empty: it was made from them, or from the scene that one of them was made from, or
/// its file does not say, or they cannot be read again.
[[nodiscard]] std::string other_scene_hint(const std::vector<std::string>& scenes, const std::string& proxy,
                                           const SceneOptions& options);
/// What may be behind the failure of the file `proxy` to enclose the file `scene` (or with `inside` to lie within it):
/// one sentence from what the files say of their making. Empty: they say nothing of it.
[[nodiscard]] std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside);
/// Where a proxy is refuted as one surface: that --convex asks of its parts, if they are hulls by the names of their
/// nodes, or if there are several (`convex_parts`) and each is convex. Empty: neither.
[[nodiscard]] std::string convex_hint(const std::string& proxy, bool convex_parts);
/// The command that draws the first bad place; empty if there is none, or if a file came from a pipe. origin: what was
/// added to the proxy, which is not drawn then.
[[nodiscard]] std::string look_hint(const std::vector<std::string>& files, const std::string& format,
                                    const Vec3d& origin, const std::vector<CheckReport>& verdicts);
/// Where the voxels that hide do not fit `memory`: how much would do. Empty: they do, or were not asked for.
[[nodiscard]] std::string memory_hint(const std::vector<CheckReport>& verdicts, const MemoryShare& memory);
/// The same as enclosure_hint() of a content of a tileset.
[[nodiscard]] std::string fit_hint(const std::string& content);

/// What helps where a question is open because coordinates were rounded when they were read, or because the scene says
/// what is not followed; else empty.
[[nodiscard]] std::string rounding_hint(const std::string& scene, const std::string& proxy,
                                        const std::vector<CheckReport>& verdicts);

}  // namespace bp
