#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/contract.h"
#include "tools/check/check_run.h"

/// What a proxy's file claims of itself, as a question of bpcheck (docs/contracts.md).
namespace bp {

/// The contract that the file names. None: it names none, or one that this version does not know.
[[nodiscard]] std::optional<Contract> told_contract(const std::string& file);

/// The command line with the question that proves the claim. A claim that says nothing of the scene leaves the scenes
/// out. Throws bad_argument if the claim needs a scene and none is named, if its file tells no margin, or if it can be
/// proven with its tileset only.
[[nodiscard]] CheckRun asking_for(Contract contract, CheckRun run);

/// The lines before and after the verdict: what is claimed, and what is not.
[[nodiscard]] std::string claim_line(Contract contract);
[[nodiscard]] std::string unclaimed_line(Contract contract);
/// The answer for a file that claims nothing.
[[nodiscard]] std::string no_claim_line(const std::string& file);

}  // namespace bp
