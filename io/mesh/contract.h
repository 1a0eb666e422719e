#pragma once
#include <optional>
#include <string>

/// The contracts that files of the suite claim: a row of docs/contracts.md each. Files carry the contract's name;
/// bpcheck reads it.
namespace bp {

enum class Contract {
  encloses,      ///< one sound surface, strictly around the scene
  margin,        ///< as encloses, and at least the margin of its provenance away from the scene
  convex_parts,  ///< sound convex parts that may overlap; each point of the scene lies strictly in one
  convex_part,   ///< one sound and convex surface; claims nothing about the scene
  inside,        ///< one sound surface, strictly inside the scene, or hidden by it to a voxel
  fit,           ///< one sound surface near the scene; claims nothing about where the scene lies
  tile,          ///< encloses the part of the scene in the cell of its tile; the tileset tells cell and place
  leaf,          ///< triangles of the scene itself in the cell of its tile
};

/// Returns the name in files: "convex parts".
[[nodiscard]] const char* name_of(Contract contract);
/// Returns the contract of this name; none if there is no such.
[[nodiscard]] std::optional<Contract> contract_named(const std::string& name);
/// Returns a clause without its subject: "claims that ...".
[[nodiscard]] const char* claim_of(Contract contract);
/// Returns what a user might expect of such a file although it does not claim it; empty: nothing.
[[nodiscard]] const char* not_claimed_by(Contract contract);

}  // namespace bp
