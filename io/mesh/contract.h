#pragma once
#include <optional>
#include <string>

/// What a file that the suite wrote claims of itself: a row of docs/contracts.md. Files carry its name; bpcheck reads
/// it.
namespace bp {

enum class Contract {
  encloses,      ///< one sound surface, strictly around the scene
  margin,        ///< the same, and at least the margin of its provenance away from the scene
  convex_parts,  ///< parts, each sound and convex, that may overlap; each point of the scene lies strictly in one
  convex_part,   ///< one sound and convex surface; says nothing of where the scene lies
  inside,        ///< one sound surface, strictly inside the scene, or hidden by it to a voxel
  fit,           ///< one sound surface near the scene; says nothing of where the scene lies
  tile,          ///< encloses what the scene has in the cell of its tile; a tileset tells cell and place
  leaf,          ///< triangles of the scene itself in the cell of its tile
};

/// The name in files: "convex parts".
[[nodiscard]] const char* name_of(Contract contract);
/// None: no contract has this name.
[[nodiscard]] std::optional<Contract> contract_named(const std::string& name);
/// A sentence without its subject: "claims that ...".
[[nodiscard]] const char* claim_of(Contract contract);
/// What a user might expect of such a file though it does not claim it; empty: nothing.
[[nodiscard]] const char* not_claimed_by(Contract contract);

}  // namespace bp
