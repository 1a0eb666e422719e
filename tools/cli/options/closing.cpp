#include "tools/cli/options/closing.h"

namespace bp {

void ClosingOptions::add_to(Args& args, const std::string& scale_of, const std::string& scale_default) {
  args.group("Closing");
  args.option("-s,--scale", "LENGTH", scale,
              "closing radius" + scale_of +
                  ": in scene units, as a percentage of the scene's diagonal (2%), or in voxels "
                  "(20vx); narrower gaps and holes are filled" +
                  scale_default);
}

void ClosingOptions::add_element(Args& args) {
  args.option("--element",
              {{"cube", StructuringElement::cube, "keeps large faces along the axes flat"},
               {"ball", StructuringElement::ball, "treats all directions alike; best for --mode fit"}},
              element, "shape that closes");
}

}  // namespace bp
