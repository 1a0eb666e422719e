#include <bp/bp_experimental.h>

#include <bp/bp.hpp>
#include <iostream>

/// Makes and checks a proxy of a tetrahedron.
int main() {
  const bp::Scene scene({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  bp_voxelize_options voxels = bp::voxelize_options();
  voxels.resolution = 32;
  const bp::Grid grid = bp::Grid(scene, voxels).close("2%");
  const bp::Mesh proxy = grid.mesh({50, 20});
  const bp::Verdict verdict(proxy, 1, scene);
  std::cout << bp_version() << ": " << proxy.triangles().size() / 3 << " triangles\n" << verdict.text();
  const bool told = grid.info().has_closing != 0 && proxy.info().volume > 0;
  proxy.save("consumer.ply", true);
  const bool read = bp::Verdict(bp::Mesh::load("consumer.ply"), scene).holds();
  bool refused = false;
  try {
    (void)bp::length("long");
  } catch (const bp::ApiError& e) {
    refused = e.status() == BP_BAD_ARGUMENT;
  }
  return verdict.holds() && refused && told && read ? 0 : 1;
}
