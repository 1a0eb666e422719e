#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/files/made_folders.h"
#include "io/mesh/contract.h"
#include "lib/levels/whole_levels.h"
#include "tools/lod/build.h"

/// Writes the files of a chain of levels into one folder, for all profiles but tiles.
namespace bp {

/// A set of files that appear together. All are opened before the work, so that a name that cannot be written fails at
/// once. All are committed after it, in the order in which they were opened; files that name others come last. If one
/// of them cannot get its name, no new file stays.
class OutputFolder {
 public:
  /// Makes the folder if it does not exist. Without commit() neither files nor new folders stay. Throws bad_argument if
  /// a file exists and `overwrite` is false. `open`: null is open_output(), which gives each name once in a process.
  using Open = std::function<std::unique_ptr<OutputFile>(const std::string& path, bool overwrite)>;
  OutputFolder(std::string path, const std::vector<std::string>& names, bool overwrite, Open open = nullptr);
  /// Files that lie in no folder: `open` gets their names.
  OutputFolder(const std::vector<std::string>& names, Open open);
  [[nodiscard]] OutputFile& file(const std::string& name);
  /// Opens one more file, which is committed before `next`. Throws as the constructor.
  OutputFile& add(const std::string& name, const std::string& next);
  /// Leaves out a file that nothing was written to. With --overwrite, commit() removes a file of that name that an
  /// earlier run left.
  void leave_out(const std::string& name);
  /// Makes commit() remove a file of an earlier run that was not opened, if --overwrite is given.
  void take_away(const std::string& name) { left_out_.push_back(name); }
  void commit();
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] std::uint64_t bytes(const std::string& name) const;

 private:
  [[nodiscard]] std::string path_of(const std::string& name) const;
  std::string path_;  ///< empty: there is no folder
  bool overwrite_;
  Open open_;
  std::optional<MadeFolder> made_;
  std::vector<std::string> names_, left_out_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

/// Returns what levels promise (docs/contracts.md). Only the mode decides it.
[[nodiscard]] Contract contract_of_levels(const BuildOptions& options);
/// Returns what each content of a tileset promises.
[[nodiscard]] Contract contract_of_tiles(const BuildOptions& options);
/// Returns "NAME_LOD0", by a convention of Unity and others.
[[nodiscard]] std::string level_name(const std::string& name, std::size_t level);
/// Returns the files of a profile, in the order of their commit.
[[nodiscard]] std::vector<std::string> profile_files(LodProfile profile, const std::string& name, std::size_t levels);
/// A file that was written.
struct WrittenFile {
  std::string name;
  std::size_t level = 0;
  std::uint64_t faces = 0;
  bool is_level = true;  ///< the file holds the level itself, and not convex hulls around it
  std::uint64_t hulls = 0;
  double hull_volume = 0;                ///< volume of all hulls over the level's volume
  std::string note = "";                 ///< a note for the user
  std::vector<std::string> beside = {};  ///< further files of the level: materials and images of OBJ, files of hulls
};
/// Writes them; returns those that hold one level. Levels: finest first; errors must not fall towards coarser ones;
/// collision: collision/collision_files.h. diameter: of the scene; origin: subtracted from all vertices; scene units.
/// looks: images of levels that are triangles of the scene. The options that decide are profile, name and mode.
std::vector<WrittenFile> write_profile(const BuildOptions& options, const CompleteLevels& made, double diameter,
                                       const Vec3d& origin, const LeafLooks& looks, OutputFolder& out);

/// Encodes the levels of a tileset that are one mesh each. `first`: the number of the first one.
[[nodiscard]] WholeLevels encoded(const BuildOptions& options, const CompleteLevels& made, std::size_t first);

/// Makes --overwrite remove the levels of an earlier, longer list of this name: files that bplod made, whose numbers
/// follow on `levels`.
void take_away_longer_list(const BuildOptions& options, std::size_t levels, OutputFolder& out);

/// Returns the files that levels as OBJ (BuildOptions::obj) may have: each level has a material and images. An image is
/// JPEG, or PNG if it has holes.
[[nodiscard]] std::vector<std::string> obj_files(const BuildOptions& options, std::size_t levels);
/// Writes the levels like write_profile(), and leaves out the files of obj_files() that are not needed.
std::vector<WrittenFile> write_obj_levels(const BuildOptions& options, const std::vector<LodLevel>& levels,
                                          const Vec3d& origin, OutputFolder& out);

}  // namespace bp
