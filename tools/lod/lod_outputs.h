#pragma once
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "io/files/made_folders.h"
#include "io/mesh/contract.h"
#include "lib/levels/whole_levels.h"
#include "tools/lod/build.h"

/// What bplod writes of a chain: the files of a profile other than tiles, in one folder.
namespace bp {

/// Files that appear together: all are opened before the work, so that a name that cannot be written fails at once, and
/// committed after it, in the order in which they were opened; what names other files comes last. If one cannot have
/// its name, no new one stays.
class OutputFolder {
 public:
  /// Makes the folder if it is not there. Without commit() nothing stays behind, folders that were made included.
  /// Throws bad_argument if a file exists and `overwrite` is false.
  OutputFolder(std::string path, const std::vector<std::string>& names, bool overwrite);
  [[nodiscard]] OutputFile& file(const std::string& name);
  /// One more file, that is committed before `next`. Throws as the constructor.
  OutputFile& add(const std::string& name, const std::string& next);
  /// A file that nothing was written to. What --overwrite finds under its name, of an earlier set, goes with commit().
  void leave_out(const std::string& name);
  /// A file of an earlier set that was not opened goes with commit(), if --overwrite is given.
  void take_away(const std::string& name) { left_out_.push_back(name); }
  void commit();
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] std::uint64_t bytes(const std::string& name) const;

 private:
  std::string path_;
  bool overwrite_;
  MadeFolder made_;
  std::vector<std::string> names_, left_out_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

/// What levels claim (docs/contracts.md): a question of the mode alone.
[[nodiscard]] Contract contract_of_levels(const BuildOptions& options);
/// "NAME_LOD0": Unity's and others' convention.
[[nodiscard]] std::string level_name(const std::string& name, std::size_t level);
/// The files of a profile, in the order of their commit.
[[nodiscard]] std::vector<std::string> profile_files(LodProfile profile, const std::string& name, std::size_t levels);
/// A file that was written.
struct WrittenFile {
  std::string name;
  std::size_t level = 0;
  std::uint64_t faces = 0;
  bool is_level = true;  ///< the level itself; else convex hulls around it
  std::uint64_t hulls = 0;
  double hull_volume = 0;                ///< of all of them, over the level's own
  std::string note = "";                 ///< what a user should know of it
  std::vector<std::string> beside = {};  ///< further files of the level: material and images of OBJ
};
/// Writes them; returns those that hold one level. `levels`: finest first; errors must not fall towards coarser ones;
/// collision: collision/collision_files.h. diameter: of the scene; origin: subtracted from all vertices; scene units.
/// The options that decide are profile, name and mode.
std::vector<WrittenFile> write_profile(const BuildOptions& options, const std::vector<LodLevel>& levels,
                                       double diameter, const Vec3d& origin, OutputFolder& out);

/// The contents of a tileset's levels in one mesh; `first` is the number of the first.
[[nodiscard]] WholeLevels encoded(const BuildOptions& options, const CompleteLevels& made, std::size_t first);

/// Levels as OBJ (BuildOptions::obj), each with a material and images beside it. Files that there may be: an image is
/// JPEG, or PNG where it has holes.
[[nodiscard]] std::vector<std::string> obj_files(const BuildOptions& options, std::size_t levels);
/// As write_profile(); what is not needed of obj_files() is left out.
std::vector<WrittenFile> write_obj_levels(const BuildOptions& options, const std::vector<LodLevel>& levels,
                                          const Vec3d& origin, OutputFolder& out);

}  // namespace bp
