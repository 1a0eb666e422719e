#include "tools/cli/options/closing.h"

namespace bp {

void ClosingOptions::add_to(Args& args, const std::string& scale_of, const std::string& scale_more) {
  args.group("Closing");
  args.option("-s,--scale", "LENGTH", scale,
              "closing radius" + scale_of +
                  ", as 0.5, 2% or 20vx: scene units, a share of the scene's diagonal, or voxels; gaps and holes "
                  "narrower than about twice the radius are filled" +
                  scale_more);
}

void ClosingOptions::add_element(Args& args) {
  args.option("--element",
              {{"cube", StructuringElement::cube, "keeps large faces along the axes flat"},
               {"ball", StructuringElement::ball, "treats all directions alike; best for --mode fit"}},
              element, "shape that closes");
}

}  // namespace bp
