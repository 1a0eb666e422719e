// Loads models as MuJoCo reads them, MJCF or URDF, makes ten steps, and prints what they hold.
//   bp_load_models MODEL...
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    char error[1000] = "";
    mjModel* const model = mj_loadXML(argv[i], nullptr, error, sizeof error);
    if (model == nullptr) {
      std::printf("%s: %s\n", argv[i], error);
      return 1;
    }
    int corners = 0;
    for (int m = 0; m < model->nmesh; ++m) {  // of the hull that MuJoCo makes of the mesh
      if (model->mesh_graphadr[m] >= 0) corners = std::max(corners, model->mesh_graph[model->mesh_graphadr[m]]);
    }
    mjData* const data = mj_makeData(model);
    for (int step = 0; step < 10; ++step) mj_step(model, data);
    std::printf("%s: meshes %d geoms %d corners %d\n", argv[i], model->nmesh, model->ngeom, corners);
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  return 0;
}
