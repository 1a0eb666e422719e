#include "tools/check/claim.h"

#include <fmt/format.h>

#include <set>

#include "io/tiles/tileset_level.h"
#include "lib/core/error.h"
#include "tools/check/hints.h"
#include "tools/cli/length.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

/// Returns the distance from the scene that the file's last step says it keeps.
Length told_margin(const std::string& file) {
  static const std::string key = " margin=";
  const MeshExtras extras = extras_of(file);
  const std::string line = extras.provenance.empty() ? "" : extras.provenance.back();
  const std::size_t at = line.find(key);
  if (at == std::string::npos)
    fail(ErrorCode::bad_argument, "{}: claims a margin and does not tell it; ask with --margin", file_name(file));
  const std::size_t begin = at + key.size();
  return parse_length(line.substr(begin, line.find(' ', begin) - begin));
}

}  // namespace

std::optional<Contract> told_contract(const std::string& file) {
  return contract_named(extras_of(file).contract);
}

std::optional<Contract> told_contract(const Tileset& tileset, const std::string& file) {
  std::optional<Contract> claim;
  std::set<std::string> asked;  // a branch that ends early has its tile in several levels
  const std::size_t levels = tileset_level(tileset, file, 0).levels;
  for (std::size_t i = 0; i < levels; ++i) {
    for (const PlacedContent& content : tileset_level(tileset, file, i).contents) {
      if (!asked.insert(content.path).second) continue;
      const std::optional<Contract> told = told_contract(content.path);
      if ((told != Contract::tile && told != Contract::fit) || (claim && claim != told)) return {};
      claim = told;
    }
  }
  return claim;
}

CheckRun asking_for(Contract contract, CheckRun run) {
  const std::string& proxy = run.files.back();
  if (contract == Contract::tile || contract == Contract::leaf)
    fail(ErrorCode::bad_argument, "{}: is the content of a tile; check its tileset.json with the scene",
         file_name(proxy));
  if (contract == Contract::fit || contract == Contract::convex_part) {
    run.files = {proxy};
    run.convex = contract == Contract::convex_part;
    return run;
  }
  if (run.files.size() < 2)
    fail(ErrorCode::bad_argument, "{}: claims that {}; name the scene before it", file_name(proxy), claim_of(contract));
  run.inside = contract == Contract::inside;
  run.convex = contract == Contract::convex_parts;
  if (contract == Contract::margin) run.margin = told_margin(proxy);
  return run;
}

std::string claim_line(Contract contract) {
  return fmt::format("claims ({}): {}\n", name_of(contract), claim_of(contract));
}

std::string unclaimed_line(Contract contract) {
  const std::string text = not_claimed_by(contract);
  return text.empty() ? "" : fmt::format("does not claim: {}\n", text);
}

std::string no_claim_line(const std::string& file) {
  return fmt::format("{}: not decided: the file claims nothing (docs/contracts.md)\n", file_name(file));
}

}  // namespace bp
