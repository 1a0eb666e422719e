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

/// Returns what a file says beside its triangles. If the file cannot be read again, it is empty: a hint is no reason to
/// fail, or to wait for a pipe.
[[nodiscard]] MeshExtras extras_of(const std::string& path);
[[nodiscard]] bool is_gltf(const std::string& path);  ///< by its name

/// Returns the point that --origin subtracted from the vertices of `proxy`, as its file says. It must be added back
/// before the proxy is compared with `scenes`. Returns nothing if nothing was subtracted, if there is no scene, or if a
/// scene's file names the same point.
[[nodiscard]] std::optional<Vec3d> told_origin(const std::vector<std::string>& scenes, const std::string& proxy);

/// Returns a hint for a proxy that fails: its file says that it was made from other triangles than those of `scenes`.
/// Reads the scenes once more. Empty: it was made from them, or from the scene that one of them was made from; or its
/// file does not say; or the scenes cannot be read again.
[[nodiscard]] std::string other_scene_hint(const std::vector<std::string>& scenes, const std::string& proxy,
                                           const SceneOptions& options);
/// Returns one sentence about why the file `proxy` may fail to enclose the file `scene` (with `inside`: to lie within
/// it), from what the files say about how they were made. Empty: they say nothing about it.
[[nodiscard]] std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside);
/// Returns a hint for a proxy that is refuted as one surface: --convex checks its parts. It is given if the names of
/// its nodes call them hulls, or if there are several parts (`convex_parts`) and each is convex. Empty: neither.
[[nodiscard]] std::string convex_hint(const std::string& proxy, bool convex_parts);
/// Returns the command that draws the first bad place. Empty if there is none, or if a file came from a pipe. `origin`
/// was added to the proxy; with it, the command is not given.
[[nodiscard]] std::string look_hint(const std::vector<std::string>& files, const std::string& format,
                                    const Vec3d& origin, const std::vector<CheckReport>& verdicts);
/// Returns how much memory would do if the voxels that hide do not fit `memory`. Empty: they fit, or were not asked
/// for.
[[nodiscard]] std::string memory_hint(const std::vector<CheckReport>& verdicts, const MemoryShare& memory);
/// Returns a hint as enclosure_hint() does, for a content of a tileset.
[[nodiscard]] std::string fit_hint(const std::string& content);

/// Returns what helps if a question is open because coordinates were rounded when they were read, or because the scene
/// has features that no reader follows; else empty.
[[nodiscard]] std::string rounding_hint(const std::string& scene, const std::string& proxy,
                                        const std::vector<CheckReport>& verdicts);
/// Returns the same for a scene of which coordinates were rounded.
[[nodiscard]] std::string rounded_hint(const std::string& scene);

}  // namespace bp
