#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/contract.h"
#include "lib/tileset/tileset.h"
#include "tools/check/check_run.h"

/// The claim that a proxy's file makes about itself, turned into a question for bpcheck (docs/contracts.md).
namespace bp {

/// Returns the contract that the file names. Empty: it names none, or one that this version does not know.
[[nodiscard]] std::optional<Contract> told_contract(const std::string& file);

/// Returns the contract that all contents of a tileset but its leaves name: that of tiles or that of fits. Empty: they
/// name another one, or differ. Reads the head of each.
[[nodiscard]] std::optional<Contract> told_contract(const Tileset& tileset, const std::string& file);

/// Returns the command line with the question that proves the claim. If the claim says nothing about the scene, the
/// scenes are left out. Throws bad_argument if the claim needs a scene and none is named, if the file tells no margin,
/// or if the claim can be proven only with its tileset.
[[nodiscard]] CheckRun asking_for(Contract contract, CheckRun run);

/// Returns the lines before and after the verdict: what is claimed, and what is not.
[[nodiscard]] std::string claim_line(Contract contract);
[[nodiscard]] std::string unclaimed_line(Contract contract);
/// Returns the answer for a file that claims nothing.
[[nodiscard]] std::string no_claim_line(const std::string& file);

}  // namespace bp
