#include "tools/pipe/field_step.h"

#include "tools/run/provenance.h"
#include "tools/run/scale_rules.h"

namespace bp {

StreamHeader field_header(const StreamHeader& in, const ScalePlan& plan, const OrientationField& orientation) {
  StreamHeader header = in;
  header.has_field = true;
  header.scale = plan.field;
  header.orientation = orientation;
  OptionText text;
  text.add("field", provenance_text(plan));
  text.add("orientation", provenance_text(plan.orientation, "places"));
  header.provenance.push_back(make_provenance("bpscale", text));
  return header;
}

}  // namespace bp
