#pragma once
#include <cstdint>

#include "samples/plant/sink.h"

/// Builds the modules of a site. A plot is 60 x 60 m: a module on 60 x 50 m, and a pipe rack on the rest.
namespace plant {

constexpr double kPlot = 60, kModuleDepth = 50;

enum class Kind { process, tanks, cooling, spheres, hall, silos, exchangers, rack, fence, ground, yard };
constexpr int kModuleKinds = 7;  ///< the first ones stand on plots; the others have places of their own

/// A pure function of its arguments: the same parts in the same order. `items` is the number of drums in a yard.
void build(Kind kind, std::uint64_t seed, double detail, std::uint64_t items, Sink& sink);

}  // namespace plant
