#include "io/mesh/contract.h"

#include <array>

namespace bp {

namespace {

struct Row {
  Contract contract;
  const char* name;
  const char* claim;
  const char* not_claimed;
};

constexpr std::array kRows{
    Row{Contract::encloses, "encloses", "one sound surface strictly encloses the scene", ""},
    Row{Contract::margin, "encloses with a margin",
        "one sound surface strictly encloses the scene, and keeps a margin from it", ""},
    Row{Contract::convex_parts, "convex parts", "convex parts together strictly enclose the scene",
        "that the parts are one surface: they may overlap"},
    Row{Contract::convex_part, "convex part", "one sound and convex surface",
        "that it encloses the scene by itself: all hulls together do"},
    Row{Contract::inside, "inside", "one sound surface lies strictly inside the scene, or is hidden by it",
        "that it encloses the scene"},
    Row{Contract::fit, "fit", "one sound surface", "that it encloses the scene, or lies inside it"},
    Row{Contract::tile, "tile", "one sound surface encloses what the scene has in a cell of a tileset",
        "that it encloses the whole scene: check the tileset"},
    Row{Contract::leaf, "leaf", "triangles of the scene in a cell of a tileset",
        "that they are closed, or enclose anything: check the tileset"},
};

const Row& row_of(Contract contract) {
  return kRows[std::size_t(contract)];
}

}  // namespace

const char* name_of(Contract contract) {
  return row_of(contract).name;
}

std::optional<Contract> contract_named(const std::string& name) {
  for (const Row& row : kRows)
    if (name == row.name) return row.contract;
  return {};
}

const char* claim_of(Contract contract) {
  return row_of(contract).claim;
}

const char* not_claimed_by(Contract contract) {
  return row_of(contract).not_claimed;
}

}  // namespace bp
