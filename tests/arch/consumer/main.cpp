#include "io/files/file.h"
#include "lib/check/check_proxy.h"
#include "lib/core/error.h"
#include "lib/core/grid_frame.h"
#include "lib/core/parallel.h"
#include "lib/levels/level_chain.h"
#include "lib/pass/mesh/mesh_pass.h"

int main() {
  bp::Bounds3d bounds;
  bounds.add({0, 0, 0});
  bounds.add({1, 2, 3});
  const bp::GridFrame frame = bp::make_frame(bounds, 0.25);
  int missing = 0;
  bp::parallel_for(1, [&](std::int64_t) {
    try {
      bp::InputFile file("no such file");
    } catch (const bp::Error&) {
      missing = 1;
    }
  });
  return frame.voxel >= 0.25 && missing == 1 ? 0 : 1;
}
