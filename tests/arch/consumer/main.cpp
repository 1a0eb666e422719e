#include <bp/bp_experimental.h>

#include <bp/bp.hpp>
#include <iostream>

/// Makes and checks a proxy of a tetrahedron.
int main() {
  const bp::Scene scene({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  bp_voxelize_options voxels = bp::voxelize_options();
  voxels.resolution = 32;
  const bp::Mesh proxy = bp::Grid(scene, voxels).close("2%").mesh(50);
  const bp::Verdict verdict(proxy, 0, scene);
  std::cout << bp_version() << ": " << proxy.triangles().size() / 3 << " triangles\n" << verdict.text();
  bool refused = false;
  try {
    (void)bp::length("long");
  } catch (const bp::ApiError& e) {
    refused = e.status() == BP_BAD_ARGUMENT;
  }
  return verdict.holds() && refused ? 0 : 1;
}
